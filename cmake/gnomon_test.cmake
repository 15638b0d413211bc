# How a test program is built and run: one ctest entry per program (a process per case would pay for start-up).
#
# gnomon_test(NAME SOURCES file... [LIBS target...] [TIMEOUT seconds] [LABELS label...])
#   LIBS come on top of GoogleTest with its main, RapidCheck and its GoogleTest bridge. TIMEOUT is 300 s unless
#   said otherwise. The program sees GNOMON_SOURCE_DIR and GNOMON_TEST_DATA as string literals.
#
# GNOMON_TEST_ENVIRONMENT: what every test runs under; for tests that are added by plain add_test as well.
#   LP_NUM_THREADS=1 because ctest already runs one test per core, and llvmpipe would take all cores for each.
#   intercept_tls_get_addr=0 because the leak check otherwise guesses where a library that was opened at run time
#   (OSMesa, EGL drivers) keeps its thread-local data, reads there, and crashes where the guess is wrong. Leaks in
#   our own libraries are still found.
set(GNOMON_TEST_ENVIRONMENT
  "LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/lsan.supp:print_suppressions=0"
  "ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1:intercept_tls_get_addr=0"
  "UBSAN_OPTIONS=print_stacktrace=1"
  "LP_NUM_THREADS=1")

function(gnomon_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "TIMEOUT" "SOURCES;LIBS;LABELS")
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  add_executable(${name} ${arg_SOURCES} ${arg_UNPARSED_ARGUMENTS})
  gnomon_target(${name})
  target_link_libraries(${name} PRIVATE ${arg_LIBS} GTest::gmock GTest::gtest_main rapidcheck rapidcheck_gtest)
  target_compile_definitions(${name} PRIVATE
    GNOMON_SOURCE_DIR="${PROJECT_SOURCE_DIR}" GNOMON_TEST_DATA="${PROJECT_SOURCE_DIR}/tests/data")
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin/tests)
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES TIMEOUT ${arg_TIMEOUT} ENVIRONMENT "${GNOMON_TEST_ENVIRONMENT}")
  if(arg_LABELS)
    set_tests_properties(${name} PROPERTIES LABELS "${arg_LABELS}")
  endif()
endfunction()
