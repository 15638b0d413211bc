# How a test program is built and run: one ctest entry per program (a process per case would pay for start-up), or two.
#
# gnomon_test(NAME SOURCES file... [LIBS target...] [SLOW pattern] [SHARDS count] [SLOW_SHARDS count] [FEWER_DRAWS] [SMOKE]
#             [OWN_OPTIONS])
#   LIBS come on top of GoogleTest with its main, RapidCheck and its GoogleTest bridge.
#   SLOW: cases whose names match this pattern of GoogleTest run in an entry NAME_slow of their own. With "*" all do.
#   FEWER_DRAWS: NAME draws a quarter of each law's inputs, NAME_slow all of them.
#   SHARDS, SLOW_SHARDS: so many entries share the cases, for a program that would take over a minute.
#   SMOKE: `./dev check sanitizers` runs it, too. OWN_OPTIONS: compiled without the precompiled headers, whose compiler
#   options the test does not share.
#   The program sees GNOMON_SOURCE_DIR and GNOMON_TEST_DATA as string literals.
#
# Labels: the folder's (unit, laws, render, program, package or text, see gnomon_test_label) and `slow`. `./dev test` runs
# what is not slow; `./dev check` the rest.
#
# GNOMON_TEST_ENVIRONMENT: what every test runs under; for tests that are added by plain add_test as well.
#   LP_NUM_THREADS=1 because ctest already runs one test per core, and llvmpipe would take all cores for each.
#   intercept_tls_get_addr=0 because the leak check otherwise guesses where a library that was opened at run time
#   (OSMesa, EGL drivers) keeps its thread-local data, reads there, and crashes where the guess is wrong. Leaks in
#   our own libraries are still found.
set(GNOMON_TEST_ENVIRONMENT
  "LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/lsan.supp:print_suppressions=0"
  "ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1:intercept_tls_get_addr=0:malloc_context_size=12"
  "UBSAN_OPTIONS=print_stacktrace=1"
  "LP_NUM_THREADS=1")

# What nearly every test reads first, parsed once for all of them (a third of their compile time). Nothing of this project
# is among it: a header that changes must not compile every test anew.
function(gnomon_precompiled_test_headers)
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/test_headers.cpp CONTENT "// Generated: the target needs a source.\n")
  add_library(gnomon_test_headers OBJECT ${CMAKE_CURRENT_BINARY_DIR}/test_headers.cpp)
  gnomon_test_options(gnomon_test_headers)
  target_link_libraries(gnomon_test_headers PRIVATE GTest::gmock GTest::gtest_main rapidcheck rapidcheck_gtest)
  target_precompile_headers(gnomon_test_headers PRIVATE <gmock/gmock.h> <gtest/gtest.h> <rapidcheck.h>
    <rapidcheck/gtest.h> <algorithm> <array> <cmath> <filesystem> <fstream> <glm/glm.hpp> <random> <regex> <set> <sstream>)
endfunction()

# Optimizing tests costs more time to compile than it saves when they run: the work is in the libraries. Under the
# sanitizers, the tests' own code goes without the checks at every dereference, which doubled its compile time; the
# libraries have them all.
function(gnomon_test_options name)
  gnomon_target(${name})
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O0>)
  if(GNOMON_SANITIZE MATCHES "undefined")
    target_compile_options(${name} PRIVATE -O0 -fno-sanitize=null,alignment,object-size,vptr)
  endif()
endfunction()

# gnomon_test_label(LABEL): of all tests that this folder adds from here on.
macro(gnomon_test_label label)
  set(gnomon_label ${label})
  if(NOT TARGET tests_${label})
    add_custom_target(tests_${label})
  endif()
endmacro()
add_custom_target(tests_smoke)

# gnomon_set_test(TEST [SLOW] [SMOKE] [PROPERTY value...]): label, environment and time limit of an entry, and more. The
# limit is ten times what the slowest entry takes on an idle machine, a minute; under the sanitizers three times as much.
function(gnomon_set_test test)
  cmake_parse_arguments(PARSE_ARGV 1 arg "SLOW;SMOKE" "" "ENVIRONMENT")
  set(labels ${gnomon_label})
  if(arg_SLOW)
    list(APPEND labels slow)
  endif()
  if(arg_SMOKE)
    list(APPEND labels smoke)
  endif()
  set(limit 600)
  if(GNOMON_SANITIZE)
    set(limit 1800)
  endif()
  set_tests_properties(${test} PROPERTIES LABELS "${labels}" TIMEOUT ${limit}
    ENVIRONMENT "${GNOMON_TEST_ENVIRONMENT};${arg_ENVIRONMENT}" ${arg_UNPARSED_ARGUMENTS})
endfunction()

# gnomon_test_entries(NAME PROGRAM SHARDS ENVIRONMENT [SLOW] [SMOKE]): the ctest entries NAME, or NAME_1_of_N ...
function(gnomon_test_entries name program shards environment)
  foreach(shard RANGE 1 ${shards})
    set(entry ${name})
    set(shard_environment ${environment})
    if(shards GREATER 1)
      string(APPEND entry _${shard}_of_${shards})
      math(EXPR index "${shard} - 1")
      list(APPEND shard_environment GTEST_TOTAL_SHARDS=${shards} GTEST_SHARD_INDEX=${index})
    endif()
    add_test(NAME ${entry} COMMAND ${program})
    # A pattern that fits no case any more would pass by checking nothing.
    gnomon_set_test(${entry} ${ARGN} ENVIRONMENT ${shard_environment} FAIL_REGULAR_EXPRESSION "Running 0 tests")
  endforeach()
endfunction()

function(gnomon_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "OWN_OPTIONS;FEWER_DRAWS;SMOKE" "SLOW;SHARDS;SLOW_SHARDS" "SOURCES;LIBS")
  foreach(count SHARDS SLOW_SHARDS)
    if(NOT arg_${count})
      set(arg_${count} 1)
    endif()
  endforeach()
  add_executable(${name} ${arg_SOURCES} ${arg_UNPARSED_ARGUMENTS})
  gnomon_test_options(${name})
  if(NOT arg_OWN_OPTIONS AND GNOMON_QUICK_BUILD)
    target_precompile_headers(${name} REUSE_FROM gnomon_test_headers)
  endif()
  target_link_libraries(${name} PRIVATE ${arg_LIBS} GTest::gmock GTest::gtest_main rapidcheck rapidcheck_gtest)
  target_compile_definitions(${name} PRIVATE
    GNOMON_SOURCE_DIR="${PROJECT_SOURCE_DIR}" GNOMON_TEST_DATA="${PROJECT_SOURCE_DIR}/tests/data")
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin/tests)
  add_dependencies(tests_${gnomon_label} ${name})
  set(smoke)
  if(arg_SMOKE)
    set(smoke SMOKE)
    add_dependencies(tests_smoke ${name})
  endif()
  if(NOT arg_SLOW STREQUAL "*")
    set(environment)
    if(arg_SLOW)
      list(APPEND environment GTEST_FILTER=-${arg_SLOW})
    endif()
    if(arg_FEWER_DRAWS)
      list(APPEND environment GNOMON_DRAWS=4)
    endif()
    gnomon_test_entries(${name} ${name} ${arg_SHARDS} "${environment}" ${smoke})
  endif()
  if(arg_SLOW OR arg_FEWER_DRAWS)
    set(environment)
    if(arg_SLOW)
      list(APPEND environment GTEST_FILTER=${arg_SLOW})
    endif()
    gnomon_test_entries(${name}_slow ${name} ${arg_SLOW_SHARDS} "${environment}" SLOW)
  endif()
endfunction()
