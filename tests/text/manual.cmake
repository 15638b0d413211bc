# Does Doxygen find a public name without documentation? And does it find one that is planted?
file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${WORK_DIR})

# manual(OUT INPUT...): Doxygen's warnings about these files.
function(manual out)
  list(JOIN ARGN "\" \"" input)
  file(WRITE ${WORK_DIR}/Doxyfile "@INCLUDE = ${SOURCE_DIR}/docs/Doxyfile
OUTPUT_DIRECTORY = \"${WORK_DIR}\"
WARN_LOGFILE = \"${WORK_DIR}/warnings.txt\"
INPUT = \"${input}\"
GENERATE_HTML = NO
GENERATE_XML = NO
")
  execute_process(COMMAND ${DOXYGEN} ${WORK_DIR}/Doxyfile WORKING_DIRECTORY ${SOURCE_DIR} RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "doxygen ended with ${code}")
  endif()
  file(READ ${WORK_DIR}/warnings.txt warnings)
  set(${out} "${warnings}" PARENT_SCOPE)
endfunction()

file(WRITE ${WORK_DIR}/planted.hpp "// Planted.
#pragma once
/// A pair.
struct Pair {
  int known = 0, known_as_well = 0;  ///< documented
  int unknown = 0;
};
")
manual(planted ${WORK_DIR}/planted.hpp)
if(NOT planted MATCHES "unknown" OR planted MATCHES "known_as_well")
  message(FATAL_ERROR "the planted name alone should be undocumented:\n${planted}")
endif()
manual(warnings include/gnomon)
if(NOT warnings STREQUAL "")
  message(FATAL_ERROR "${warnings}")
endif()
