# gnomon_target(NAME): the settings that every target of this project shares.
# -ffp-contract=off keeps results bit-equal over compilers: no multiply-add is fused behind our back.
function(gnomon_target name)
  target_compile_features(${name} PUBLIC cxx_std_20)
  # What belongs to no library alone lies in src itself: headers without a source.
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_compile_options(${name} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow -ffp-contract=off)
  # gcc 12 takes "literal" + std::string&& for overlapping memory.
  target_compile_options(${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
  if(GNOMON_WERROR)
    target_compile_options(${name} PRIVATE -Werror)
  endif()
endfunction()

# gnomon_library(NAME SOURCES...): the library gnomon_NAME with its alias gnomon::NAME, installed with the package.
function(gnomon_library name)
  add_library(gnomon_${name} STATIC ${ARGN})
  add_library(gnomon::${name} ALIAS gnomon_${name})
  gnomon_target(gnomon_${name})
  set_target_properties(gnomon_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(gnomon_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  set_property(GLOBAL APPEND PROPERTY GNOMON_LIBRARIES gnomon_${name})
endfunction()

# gnomon_registry(OUT DEF MACRO DIR SUFFIX): the files DIR/<name>SUFFIX of a registry's entries MACRO(name, ...).
# Stops and names the file where an entry has none.
function(gnomon_registry out def macro dir suffix)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${def})
  file(STRINGS ${def} lines REGEX "^${macro}\\(")
  set(files)
  foreach(line ${lines})
    string(REGEX REPLACE "^${macro}\\(([a-z0-9_]+).*" "\\1" entry "${line}")
    if(NOT EXISTS ${dir}/${entry}${suffix})
      message(FATAL_ERROR "${def} lists '${entry}', but ${dir}/${entry}${suffix} is missing")
    endif()
    list(APPEND files ${dir}/${entry}${suffix})
  endforeach()
  set(${out} ${files} PARENT_SCOPE)
endfunction()
