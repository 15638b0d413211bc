# How a test program is built and run: one ctest entry per program (a process per case would pay for start-up).
#
# gnomon_test(NAME SOURCES file... [LIBS target...] [TIMEOUT seconds] [LABELS label...] [SHARDS count] [OWN_OPTIONS])
#   LIBS come on top of GoogleTest with its main, RapidCheck and its GoogleTest bridge. TIMEOUT is 300 s unless
#   said otherwise. SHARDS: so many ctest entries share the program's cases, for those that would run on alone at the
#   end. OWN_OPTIONS: compiled without the precompiled headers, whose compiler options the test does not share.
#   The program sees GNOMON_SOURCE_DIR and GNOMON_TEST_DATA as string literals.
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
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  if(GNOMON_SANITIZE MATCHES "undefined")
    target_compile_options(${name} PRIVATE -O0 -fno-sanitize=null,alignment,object-size,vptr)
  endif()
endfunction()

function(gnomon_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "OWN_OPTIONS" "TIMEOUT;SHARDS" "SOURCES;LIBS;LABELS")
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  add_executable(${name} ${arg_SOURCES} ${arg_UNPARSED_ARGUMENTS})
  gnomon_test_options(${name})
  if(NOT arg_OWN_OPTIONS)
    target_precompile_headers(${name} REUSE_FROM gnomon_test_headers)
  endif()
  target_link_libraries(${name} PRIVATE ${arg_LIBS} GTest::gmock GTest::gtest_main rapidcheck rapidcheck_gtest)
  target_compile_definitions(${name} PRIVATE
    GNOMON_SOURCE_DIR="${PROJECT_SOURCE_DIR}" GNOMON_TEST_DATA="${PROJECT_SOURCE_DIR}/tests/data")
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin/tests)
  set(entries ${name})
  if(arg_SHARDS)
    set(entries)
    foreach(shard RANGE 1 ${arg_SHARDS})
      list(APPEND entries ${name}_${shard}_of_${arg_SHARDS})
    endforeach()
  endif()
  set(shard 0)
  foreach(entry ${entries})
    set(environment ${GNOMON_TEST_ENVIRONMENT})
    if(arg_SHARDS)
      list(APPEND environment GTEST_TOTAL_SHARDS=${arg_SHARDS} GTEST_SHARD_INDEX=${shard})
    endif()
    add_test(NAME ${entry} COMMAND ${name})
    set_tests_properties(${entry} PROPERTIES TIMEOUT ${arg_TIMEOUT} ENVIRONMENT "${environment}")
    if(arg_LABELS)
      set_tests_properties(${entry} PROPERTIES LABELS "${arg_LABELS}")
    endif()
    math(EXPR shard "${shard} + 1")
  endforeach()
endfunction()
