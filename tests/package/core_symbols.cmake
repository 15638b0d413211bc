# Does the core link with nothing but the C++ standard library behind it? All of its objects go into one shared
# library that must leave nothing undefined.
file(MAKE_DIRECTORY ${WORK_DIR})
set(flags -shared -Wl,--no-undefined)
if(SANITIZE)
  list(APPEND flags -fsanitize=${SANITIZE})  # the runtime counts as the compiler's own
endif()
execute_process(COMMAND ${CXX} ${flags} -o ${WORK_DIR}/libcore_alone.so -Wl,--whole-archive ${ARCHIVE}
  -Wl,--no-whole-archive RESULT_VARIABLE code ERROR_VARIABLE error)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "the core needs more than the standard library:\n${error}")
endif()
