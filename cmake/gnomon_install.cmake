# What `cmake --install` puts where: each library is an install component of its name, with its own export file,
# so that an engine can install and find the core alone (`--component core`, find_package(gnomon COMPONENTS core)).
include(CMakePackageConfigHelpers)
set(gnomon_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/gnomon)

# gnomon_installed_helpers(OUT TARGET): libraries of this build that TARGET links and that no gnomon_library made
# (a generated GL loader, say): a static library is useless without them.
function(gnomon_installed_helpers out target)
  get_property(registered GLOBAL PROPERTY GNOMON_LIBRARIES)
  get_target_property(linked ${target} LINK_LIBRARIES)
  set(helpers)
  foreach(item ${linked})
    if(TARGET ${item})
      get_target_property(aliased ${item} ALIASED_TARGET)
      if(aliased)
        set(item ${aliased})
      endif()
      get_target_property(imported ${item} IMPORTED)
      if(NOT imported AND NOT item IN_LIST registered)
        list(APPEND helpers ${item})
      endif()
    endif()
  endforeach()
  set(${out} ${helpers} PARENT_SCOPE)
endfunction()

get_property(gnomon_libraries GLOBAL PROPERTY GNOMON_LIBRARIES)
set(gnomon_components)
set(gnomon_helpers_done)
foreach(library ${gnomon_libraries})
  string(REGEX REPLACE "^gnomon_" "" component ${library})
  list(APPEND gnomon_components ${component})
  gnomon_installed_helpers(helpers ${library})
  list(REMOVE_ITEM helpers ${gnomon_helpers_done})
  list(APPEND gnomon_helpers_done ${helpers})
  install(TARGETS ${library} ${helpers} EXPORT gnomon_${component} COMPONENT ${component}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT gnomon_${component} FILE gnomon_${component}.cmake NAMESPACE gnomon::
    DESTINATION ${gnomon_package_dir} COMPONENT ${component})
  if(component STREQUAL "core")
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/gnomon DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
      COMPONENT core FILES_MATCHING PATTERN "*.hpp" PATTERN "*.def"
      PATTERN "casefile" EXCLUDE PATTERN "scene" EXCLUDE PATTERN "render" EXCLUDE PATTERN "trace" EXCLUDE
      PATTERN "report" EXCLUDE)
  elseif(EXISTS ${PROJECT_SOURCE_DIR}/include/gnomon/${component})
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/gnomon/${component}
      DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gnomon COMPONENT ${component}
      FILES_MATCHING PATTERN "*.hpp" PATTERN "*.def")
  endif()
endforeach()

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
