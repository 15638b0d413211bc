# gnomon_target(NAME): the settings that every target of this project shares.
# -ffp-contract=off keeps results bit-equal over compilers: no multiply-add is fused behind our back.
function(gnomon_target name)
  target_compile_features(${name} PUBLIC cxx_std_20)
  set_target_properties(${name} PROPERTIES CXX_STANDARD 20 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF)
  # What belongs to no library alone lies in src itself: headers without a source.
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_compile_options(${name} PRIVATE -ffp-contract=off)
  if(GNOMON_WARNINGS)
    # gcc 12 takes "literal" + std::string&& for overlapping memory.
    target_compile_options(${name} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow
      $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
  endif()
  if(GNOMON_WERROR)
    target_compile_options(${name} PRIVATE -Werror)
  endif()
endfunction()

# In a folder whose sources the optimizer is not worth its time for: beside the libraries that they call, they take little
# of a run, and under the sanitizers they are compiled in two thirds of the time without it. Fuzzing runs them over and over.
macro(gnomon_unoptimized_under_sanitizers)
  if(GNOMON_SANITIZE AND NOT GNOMON_FUZZ)
    add_compile_options(-O0)
  endif()
endmacro()

# In a folder whose sources are mostly headers of others (JSON, command lines, formatted text): with GNOMON_QUICK_BUILD,
# eight sources are compiled as one, which reads these headers once. So within a target no two sources give a helper of
# their own the same name. `./dev check bits` compiles each source by itself.
macro(gnomon_join_sources)
  if(GNOMON_QUICK_BUILD)
    set(CMAKE_UNITY_BUILD ON)
    set(CMAKE_UNITY_BUILD_BATCH_SIZE 8)
  endif()
endmacro()

# gnomon_precompile(TARGET HEADER...): headers of other libraries that most sources of a target read, with GNOMON_QUICK_BUILD
# parsed once for all of them. None of this project: one that changes must not compile everything.
function(gnomon_precompile target)
  if(GNOMON_QUICK_BUILD)
    list(TRANSFORM ARGN REPLACE "(.+)" "<\\1>")
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

# gnomon_library(NAME SOURCES... [HEADERS header...] [VISIBLE header...]): the static library gnomon_NAME with its alias
# gnomon::NAME. Its public headers are those of include/gnomon/NAME (for the core, of include/gnomon itself).
#   HEADERS  public headers of other libraries that these include for plain types alone: installed with this one, too.
#   VISIBLE  private headers whose functions another library of this project calls: exported where libraries are shared.
# gnomon_shared.cmake makes the shared library of the same objects.
function(gnomon_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "HEADERS;VISIBLE")
  add_library(gnomon_${name} STATIC ${arg_UNPARSED_ARGUMENTS})
  gnomon_target(gnomon_${name})
  set_target_properties(gnomon_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON
    GNOMON_HEADERS "${arg_HEADERS}")
  # Calls inside of a library go straight to their function, in a shared library too.
  target_compile_options(gnomon_${name} PRIVATE $<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang>:-fno-semantic-interposition>)
  target_include_directories(gnomon_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  set_property(GLOBAL APPEND PROPERTY GNOMON_LIBRARIES gnomon_${name})
  gnomon_is_shared(shared ${name})
  if(shared)
    gnomon_hide_symbols(${name} "${arg_VISIBLE}")
    cmake_language(EVAL CODE "cmake_language(DEFER CALL gnomon_add_shared ${name})")
  endif()
  if(NOT shared OR PROJECT_IS_TOP_LEVEL)
    add_library(gnomon::${name} ALIAS gnomon_${name})
  endif()
endfunction()

# gnomon_pkgconfig(NAME [REQUIRES module...] [LIBS flag...]): what the static library links beyond this project, for its
# pkg-config file.
function(gnomon_pkgconfig name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "REQUIRES;LIBS")
  set_target_properties(gnomon_${name} PROPERTIES GNOMON_PC_REQUIRES "${arg_REQUIRES}" GNOMON_PC_LIBS "${arg_LIBS}")
endfunction()

# gnomon_is_shared(OUT NAME): whether library NAME is made shared.
function(gnomon_is_shared out name)
  set(${out} FALSE PARENT_SCOPE)
  if(BUILD_SHARED_LIBS AND (GNOMON_SHARED STREQUAL "all" OR name IN_LIST GNOMON_SHARED))
    set(${out} TRUE PARENT_SCOPE)
  endif()
endfunction()

# gnomon_public_headers(OUT NAME): the public headers of library NAME, relative to include/.
function(gnomon_public_headers out name)
  set(folder ${PROJECT_SOURCE_DIR}/include/gnomon)
  if(name STREQUAL "core")
    # The core's headers are those that lie in no folder of another library.
    file(GLOB headers RELATIVE ${PROJECT_SOURCE_DIR}/include CONFIGURE_DEPENDS ${folder}/*.hpp
      ${folder}/extend/*.hpp ${folder}/study/*.hpp)
  else()
    file(GLOB_RECURSE headers RELATIVE ${PROJECT_SOURCE_DIR}/include CONFIGURE_DEPENDS ${folder}/${name}/*.hpp)
  endif()
  set(${out} ${headers} PARENT_SCOPE)
endfunction()

# gnomon_hide_symbols(NAME VISIBLE): only what public headers (and those of VISIBLE) declare is exported. The compiler
# reads these headers before each source, under default visibility; everything else is hidden. So no declaration needs a
# macro, and what a header declares is exported without anyone's doing.
function(gnomon_hide_symbols name visible)
  gnomon_public_headers(headers ${name})
  list(APPEND headers ${visible})
  list(TRANSFORM headers REPLACE "(.+)" "#include \"\\1\"\n")
  list(JOIN headers "" includes)
  set(file ${CMAKE_CURRENT_BINARY_DIR}/gnomon_${name}_exports.hpp)
  file(CONFIGURE OUTPUT ${file} @ONLY CONTENT "// Generated by CMake: what the shared library gnomon_@name@ exports.
#pragma GCC visibility push(default)
@includes@#pragma GCC visibility pop
")
  set_target_properties(gnomon_${name} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_compile_options(gnomon_${name} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:SHELL:-include ${file}>)
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
