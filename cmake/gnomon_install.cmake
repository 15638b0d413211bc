# What `cmake --install` puts where: each library is an install component of its name, with its own export file,
# so that an engine can install and find the core alone (`--component core`, find_package(gnomon COMPONENTS core)).
include(CMakePackageConfigHelpers)
set(gnomon_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/gnomon)
get_property(gnomon_libraries GLOBAL PROPERTY GNOMON_LIBRARIES)
list(REMOVE_DUPLICATES gnomon_libraries)

# gnomon_needed_components(OUT LIBRARY): the components of this package that LIBRARY links.
function(gnomon_needed_components out library)
  get_target_property(linked ${library} LINK_LIBRARIES)
  set(components)
  foreach(item ${linked})
    string(REGEX REPLACE "^gnomon(::|_)" "" component "${item}")
    if("gnomon_${component}" IN_LIST gnomon_libraries)
      list(APPEND components ${component})
    endif()
  endforeach()
  set(${out} ${components} PARENT_SCOPE)
endfunction()

# Filled into gnomonConfig.cmake: the components, each after those it needs (targets link only what stands before).
set(gnomon_components)
set(gnomon_needs)
foreach(library ${gnomon_libraries})
  string(REGEX REPLACE "^gnomon_" "" component ${library})
  list(APPEND gnomon_components ${component})
  gnomon_needed_components(needed ${library})
  string(APPEND gnomon_needs "set(gnomon_${component}_needs ${needed})\n")
  install(TARGETS ${library} EXPORT gnomon_${component} COMPONENT ${component}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT gnomon_${component} FILE gnomon_${component}.cmake NAMESPACE gnomon::
    DESTINATION ${gnomon_package_dir} COMPONENT ${component})
  if(IS_DIRECTORY ${PROJECT_SOURCE_DIR}/include/gnomon/${component})
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/gnomon/${component}
      DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gnomon COMPONENT ${component}
      FILES_MATCHING PATTERN "*.hpp" PATTERN "*.def")
  endif()
endforeach()

# The core's headers are those that lie in no folder of another library.
file(GLOB gnomon_core_headers CONFIGURE_DEPENDS
  ${PROJECT_SOURCE_DIR}/include/gnomon/*.hpp ${PROJECT_SOURCE_DIR}/include/gnomon/*.def)
install(FILES ${gnomon_core_headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gnomon COMPONENT core)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/gnomonConfig.cmake.in ${PROJECT_BINARY_DIR}/gnomonConfig.cmake
  INSTALL_DESTINATION ${gnomon_package_dir})
# 0.x: a minor version may change the API.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/gnomonConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/gnomonConfig.cmake ${PROJECT_BINARY_DIR}/gnomonConfigVersion.cmake
  DESTINATION ${gnomon_package_dir} COMPONENT core)

foreach(program gnomon_program flythrough)
  if(TARGET ${program})
    install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT programs)
  endif()
endforeach()
