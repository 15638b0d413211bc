# Writes OUT, a C++ source that holds style and script of the report: cmake -DDIR=... -DOUT=... -P embed_page.cmake
set(text "// Generated from src/report/page/.\n#include \"page_files.hpp\"\n\nnamespace gnomon::report {\n")
foreach(entry "page_style|style.css" "page_script|script.js")
  string(REPLACE "|" ";" pair ${entry})
  list(GET pair 0 name)
  list(GET pair 1 file)
  file(READ ${DIR}/${file} source)
  # A literal may hold some 64 KiB; these files are far shorter.
  string(APPEND text "std::string_view ${name}() noexcept { return R\"PAGE(\n${source})PAGE\"; }\n")
endforeach()
string(APPEND text "}  // namespace gnomon::report\n")
file(WRITE ${OUT} "${text}")
