# gnomon_optional(NAME FOUND WHAT): decides whether an optional package is used, by GNOMON_WITH_<NAME>. Sets
# GNOMON_HAS_<NAME> for everyone; stops where it was asked for and is not there; says what is done without.
function(gnomon_optional name found what)
  # Anything else would pass for AUTO, and who wrote "Off" or "of" would get what they meant to leave out.
  if(NOT GNOMON_WITH_${name} MATCHES "^(AUTO|ON|OFF)$")
    message(FATAL_ERROR "GNOMON_WITH_${name} is '${GNOMON_WITH_${name}}': wants AUTO, ON or OFF")
  endif()
  set(has FALSE)
  if(GNOMON_WITH_${name} STREQUAL "OFF")
    message(STATUS "Built without ${name}, as asked for: ${what}")
  elseif(${found})
    set(has TRUE)
  elseif(GNOMON_WITH_${name} STREQUAL "ON")
    message(FATAL_ERROR "GNOMON_WITH_${name} is ON, and it was not found: ${what}")
  else()
    message(STATUS "Built without ${name}, which was not found: ${what}")
  endif()
  set(GNOMON_HAS_${name} ${has} CACHE INTERNAL "")
endfunction()
