# `cpack -G DEB` in a build that was configured with the preset `packages`: libgnomon-core1, libgnomon-dev, gnomon-tools,
# gnomon-doc. The core is shared; the other libraries are static and come with the headers.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME gnomon)
set(CPACK_PACKAGE_VENDOR gnomon)
set(GNOMON_MAINTAINER "The gnomon authors <gnomon@example.org>" CACHE STRING
  "Who answers for the Debian packages: NAME <ADDRESS>. The default's address answers nobody: set it before you publish.")
set(CPACK_PACKAGE_CONTACT "${GNOMON_MAINTAINER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
# 0755 for folders, as policy has it.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

# gnomon_package(GROUP PACKAGE SECTION SUMMARY TEXT): one Debian package.
macro(gnomon_package group package section summary text)
  string(TOUPPER ${group} key)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${package})
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${key}_DESCRIPTION "${summary}\n${text}")
  set(CPACK_COMPONENT_GROUP_${key}_DESCRIPTION "${summary}\n${text}")
  # Policy wants a copyright file and a changelog in each package.
  install(FILES ${PROJECT_SOURCE_DIR}/packaging/debian/copyright ${PROJECT_BINARY_DIR}/packages/changelog.gz
    DESTINATION share/doc/${package} COMPONENT ${group}_doc)
endmacro()

set(about "gnomon turns a camera, a light and the bounds of a scene into the shadow\nmaps worth drawing, and reports their error in numbers.")
gnomon_package(runtime libgnomon-core${gnomon_abi_version} libs "shadow map planning for renderers (shared library)" "${about}")
gnomon_package(dev libgnomon-dev libdevel "shadow map planning for renderers (development files)" "${about}\n.\nHeaders, static libraries, shaders, CMake and pkg-config files.")
gnomon_package(tools gnomon-tools graphics "programs that plan, draw and compare shadow maps" "${about}\n.\nThe programs gnomon and flythrough.")
gnomon_package(doc gnomon-doc doc "shadow map planning for renderers (documentation)" "${about}")

string(TIMESTAMP gnomon_date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE ${PROJECT_BINARY_DIR}/packages/changelog "gnomon (${PROJECT_VERSION}) unstable; urgency=low

  * See /usr/share/doc/gnomon-doc/CHANGELOG.md.

 -- ${CPACK_PACKAGE_CONTACT}  ${gnomon_date}
")
execute_process(COMMAND gzip -9nf ${PROJECT_BINARY_DIR}/packages/changelog)

set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA
  "${PROJECT_BINARY_DIR}/packages/triggers;${PROJECT_BINARY_DIR}/packages/shlibs")
file(WRITE ${PROJECT_BINARY_DIR}/packages/triggers "activate-noawait ldconfig\n")
# What a program that links the core depends on.
file(WRITE ${PROJECT_BINARY_DIR}/packages/shlibs
  "libgnomon_core ${gnomon_abi_version} libgnomon-core${gnomon_abi_version} (>= ${PROJECT_VERSION})\n")
set(CPACK_DEBIAN_TOOLS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
  "libgnomon-core${gnomon_abi_version} (= ${PROJECT_VERSION}), libglm-dev")
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "gnomon-doc, libtinygltf-dev, libopenimageio-dev, libdraco-dev, libmeshoptimizer-dev, libembree-dev, libglfw3-dev")

include(CPackComponent)
include(CPack)
foreach(group runtime dev tools doc)
  cpack_add_component_group(${group})
  cpack_add_component(${group}_doc GROUP ${group})
endforeach()
cpack_add_component(core_runtime GROUP runtime)
cpack_add_component(programs GROUP tools)
cpack_add_component(docs GROUP doc)
get_property(gnomon_libraries GLOBAL PROPERTY GNOMON_LIBRARIES)
list(REMOVE_DUPLICATES gnomon_libraries)
foreach(library ${gnomon_libraries})
  string(REGEX REPLACE "^gnomon_" "" name ${library})
  if(NOT name STREQUAL "glad")
    cpack_add_component(${name} GROUP dev)
  endif()
endforeach()
cpack_add_component(shaders GROUP dev)
