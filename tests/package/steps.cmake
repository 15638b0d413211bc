# What the scripts of these tests share: a step is a command that must end as expected, else the test fails with its text.
function(step what)
  step_ends_with(0 "${what}" ${ARGN})
  set(step_output "${step_output}" PARENT_SCOPE)
endfunction()

# step_ends_with(CODE|"failure" WHAT COMMAND...): its text is left in step_output.
function(step_ends_with expected what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE out)
  set(step_output "${out}" PARENT_SCOPE)
  if(expected STREQUAL "failure")
    if(code EQUAL 0)
      message(FATAL_ERROR "${what} succeeded, and must not:\n${out}")
    endif()
  elseif(NOT code EQUAL expected)
    message(FATAL_ERROR "${what} ended with ${code}, not ${expected}:\n${out}")
  endif()
endfunction()

# expect_text(TEXT): stands somewhere in what the last step printed.
function(expect_text part)
  string(FIND "${step_output}" "${part}" found)
  if(found EQUAL -1)
    message(FATAL_ERROR "nothing says '${part}':\n${step_output}")
  endif()
endfunction()
