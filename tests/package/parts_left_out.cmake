# Does the project configure with any one of its parts left out? What needs that part is left out along with it.
file(REMOVE_RECURSE ${WORK_DIR})
foreach(part SCENE RENDER TRACE REPORT CASEFILE TOOL)
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR}/${part} -G Ninja -DCMAKE_CXX_COMPILER=${CXX}
    -DGNOMON_${part}=OFF RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "-DGNOMON_${part}=OFF does not configure:\n${out}")
  endif()
endforeach()
