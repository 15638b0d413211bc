# What `cmake --install` puts where: each library is an install component of its name, with its own export file,
# so that an engine can install and find the core alone (`--component core`, find_package(gnomon COMPONENTS core)).
include(CMakePackageConfigHelpers)
set(gnomon_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/gnomon)
get_property(gnomon_libraries GLOBAL PROPERTY GNOMON_LIBRARIES)
list(REMOVE_DUPLICATES gnomon_libraries)
set(gnomon_share_dir ${CMAKE_INSTALL_DATADIR}/gnomon)

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

# gnomon_install_headers(COMPONENT HEADER...): by their paths below include/.
function(gnomon_install_headers component)
  foreach(header ${ARGN})
    get_filename_component(folder ${header} DIRECTORY)
    install(FILES ${PROJECT_SOURCE_DIR}/include/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${folder}
      COMPONENT ${component})
  endforeach()
endfunction()

# gnomon_install_pkgconfig(COMPONENT INSTALL_WITH NEEDED...): gnomon-COMPONENT.pc. A shared library brings what it links; for a static
# one, whoever links it does: at once where there is nothing but the static one, else with `pkg-config --static`.
function(gnomon_install_pkgconfig component install_with)
  get_target_property(requires gnomon_${component} GNOMON_PC_REQUIRES)
  get_target_property(libs gnomon_${component} GNOMON_PC_LIBS)
  foreach(list requires libs)
    if(NOT ${list})
      set(${list} "")
    endif()
  endforeach()
  set(pc_requires)
  if(component STREQUAL "core")
    set(pc_requires glm)
  endif()
  list(TRANSFORM ARGN REPLACE "(.+)" "gnomon-\\1 = ${PROJECT_VERSION}" OUTPUT_VARIABLE needed)
  list(APPEND pc_requires ${needed})
  set(pc_requires_private ${requires})
  list(JOIN libs " " pc_libs_private)
  set(pc_libs "-L\${libdir} -lgnomon_${component}")
  gnomon_is_shared(shared ${component})
  if(NOT shared)
    list(APPEND pc_requires ${requires})
    string(APPEND pc_libs " ${pc_libs_private}")
    set(pc_requires_private "")
    set(pc_libs_private "")
  endif()
  list(JOIN pc_requires ", " pc_requires)
  list(JOIN pc_requires_private ", " pc_requires_private)
  set(dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
  file(RELATIVE_PATH pc_prefix /prefix/${dir} /prefix)
  set(file ${PROJECT_BINARY_DIR}/gnomon-${component}.pc)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/gnomon.pc.in ${file} @ONLY)
  install(FILES ${file} DESTINATION ${dir} COMPONENT ${install_with})
endfunction()

# Filled into gnomonConfig.cmake: the components, each after those it needs (targets link only what stands before).
set(gnomon_components)
set(gnomon_needs)
foreach(library ${gnomon_libraries})
  string(REGEX REPLACE "^gnomon_" "" component ${library})
  # A helper that no user names comes along with the library it serves.
  get_target_property(install_with ${library} GNOMON_INSTALL_WITH)
  if(NOT install_with)
    set(install_with ${component})
  endif()
  list(APPEND gnomon_components ${component})
  gnomon_needed_components(needed ${library})
  string(APPEND gnomon_needs "set(gnomon_${component}_needs ${needed})\n")
  install(TARGETS ${library} EXPORT gnomon_${component} COMPONENT ${install_with}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT gnomon_${component} FILE gnomon_${component}.cmake NAMESPACE gnomon::
    DESTINATION ${gnomon_package_dir} COMPONENT ${install_with})
  if(TARGET ${library}_shared)
    # A distribution's package of the run-time library has nothing but its file.
    set(runtime ${install_with})
    if(GNOMON_PACKAGES)
      set(runtime ${install_with}_runtime)
    endif()
    install(TARGETS ${library}_shared EXPORT gnomon_${component}_shared
      LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${runtime} NAMELINK_COMPONENT ${install_with})
    install(EXPORT gnomon_${component}_shared FILE gnomon_${component}_shared.cmake NAMESPACE gnomon::
      DESTINATION ${gnomon_package_dir} COMPONENT ${install_with})
  endif()
  gnomon_public_headers(headers ${component})
  get_target_property(more_headers ${library} GNOMON_HEADERS)
  if(more_headers)
    list(APPEND headers ${more_headers})
  endif()
  file(GLOB tables RELATIVE ${PROJECT_SOURCE_DIR}/include CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/include/gnomon/${component}/*.def)
  gnomon_install_headers(${component} ${headers} ${tables})
  gnomon_install_pkgconfig(${component} ${install_with} ${needed})
endforeach()
file(GLOB tables RELATIVE ${PROJECT_SOURCE_DIR}/include CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/include/gnomon/*.def)
gnomon_install_headers(core ${tables})

# The C interface: one header and two libraries that need no other component.
if(TARGET gnomon_c)
  list(APPEND gnomon_components c)
  string(APPEND gnomon_needs "set(gnomon_c_needs)\n")
  foreach(kind "" _shared)
    install(TARGETS gnomon_c${kind} EXPORT gnomon_c${kind} COMPONENT c ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
      LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
    install(EXPORT gnomon_c${kind} FILE gnomon_c${kind}.cmake NAMESPACE gnomon:: DESTINATION ${gnomon_package_dir} COMPONENT c)
  endforeach()
  gnomon_install_headers(c gnomon/c/gnomon.h)
  set(dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
  file(RELATIVE_PATH pc_prefix /prefix/${dir} /prefix)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/gnomon-c.pc.in ${PROJECT_BINARY_DIR}/gnomon-c.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/gnomon-c.pc DESTINATION ${dir} COMPONENT c)
endif()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/gnomonConfig.cmake.in ${PROJECT_BINARY_DIR}/gnomonConfig.cmake
  INSTALL_DESTINATION ${gnomon_package_dir})
# 0.x: a minor version may change the API.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/gnomonConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/gnomonConfig.cmake ${PROJECT_BINARY_DIR}/gnomonConfigVersion.cmake
  DESTINATION ${gnomon_package_dir} COMPONENT core)
if(TARGET gnomon_c)
  install(FILES ${PROJECT_BINARY_DIR}/gnomonConfig.cmake ${PROJECT_BINARY_DIR}/gnomonConfigVersion.cmake
    DESTINATION ${gnomon_package_dir} COMPONENT c)
endif()

# Shaders that other engines include; the renderer's own passes are inside of its library.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/shaders/library ${PROJECT_SOURCE_DIR}/shaders/filter
  ${gnomon_generated_shaders}/filter
  DESTINATION ${gnomon_share_dir}/shaders COMPONENT shaders FILES_MATCHING PATTERN "*.glsl")
install(FILES ${PROJECT_SOURCE_DIR}/shaders/README.md ${PROJECT_SOURCE_DIR}/samples/engine_setup/shadow.frag
  DESTINATION ${gnomon_share_dir}/shaders COMPONENT shaders)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT core)
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_SOURCE_DIR}/CONTRIBUTING.md
  ${PROJECT_SOURCE_DIR}/SECURITY.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT docs)
if(IS_DIRECTORY ${PROJECT_SOURCE_DIR}/docs)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT docs
    PATTERN Doxyfile EXCLUDE)
endif()

# What gnomon judge is tried on first.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/samples/capture DESTINATION ${CMAKE_INSTALL_DOCDIR}/samples COMPONENT programs
  FILES_MATCHING PATTERN "*.json" PATTERN filament EXCLUDE PATTERN ogre EXCLUDE)
foreach(program gnomon_program flythrough)
  if(TARGET ${program})
    install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT programs)
  endif()
endforeach()
