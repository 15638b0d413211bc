# Writes OUT/NAME.glsl for each filter source in SOURCES, a list separated by commas: where ShadowOptions::value holds the
# filter's options. An entry of the source's kOptions is a line that begins with {"NAME", or option::NAME; one of kOwnOptions is
# "NAME". A test compares the files with the lists.
#   cmake -DSOURCES=a.cpp,b.cpp -DOUT=DIR -P option_names.cmake
function(option_list out text head entry)
  set(${out} "" PARENT_SCOPE)
  string(FIND "${text}" "${head}" begin)
  if(begin EQUAL -1)
    return()
  endif()
  string(SUBSTRING "${text}" ${begin} -1 text)
  string(FIND "${text}" "};" end)
  string(SUBSTRING "${text}" 0 ${end} text)
  # Only the matches become a list: a summary may hold brackets and semicolons.
  string(REGEX MATCHALL "${entry}[a-z][a-z0-9_]*" entries "${text}")
  list(TRANSFORM entries REPLACE "^.*[^a-z0-9_]([a-z0-9_]+)$" "\\1")
  set(${out} ${entries} PARENT_SCOPE)
endfunction()

string(REPLACE "," ";" sources "${SOURCES}")
foreach(source ${sources})
  file(READ ${source} text)
  get_filename_component(filter ${source} NAME_WE)
  option_list(options "${text}" "FilterOption kOptions[] = {" "(\n    {\"|option::)")
  option_list(own "${text}" "string_view kOwnOptions[] = {" "\"")
  set(glsl "// Where ShadowOptions::value holds the options of ${filter}. Generated from src/render/filter/${filter}.cpp.\n")
  set(place 0)
  foreach(option ${options} ${own})
    string(APPEND glsl "const int option_${option} = ${place};\n")
    math(EXPR place "${place} + 1")
  endforeach()
  file(WRITE ${OUT}/${filter}.glsl "${glsl}")
endforeach()
