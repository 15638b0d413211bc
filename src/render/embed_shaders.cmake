#Writes OUT, a C++ source that holds every file under DIR as a string : cmake - DDIR = \
                 ... - DOUT = ... - P embed_shaders.cmake
file(GLOB_RECURSE files RELATIVE ${DIR} ${
  DIR}/*.glsl ${DIR}/*.vert ${DIR}/*.frag)
list(SORT files)
set(text "// Generated from shaders/. The shader sources, as they stand in the repository.\n#include \"shader_text.hpp\"\n\n")
string(APPEND text "namespace gnomon::render {\nnamespace {\nconstexpr ShaderFile kFiles[] = {\n")
foreach(file ${files})
  file(READ ${DIR}/${file} source)
  string(APPEND text "    {\"${file}\", R\"GLSL(${source})GLSL\"},\n")
endforeach()
string(APPEND text "};\n}  // namespace\n\nstd::span<const ShaderFile> shader_files() noexcept { return kFiles; }\n")
string(APPEND text "}  // namespace gnomon::render\n")
file(WRITE ${OUT} "${text}")
