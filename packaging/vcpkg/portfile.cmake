# gnomon::core as an overlay port: vcpkg install gnomon --overlay-ports=packaging/vcpkg (from a checkout, which it builds as it is).
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../.." ABSOLUTE)

vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}" OPTIONS
  -DGNOMON_SCENE=OFF -DGNOMON_RENDER=OFF -DGNOMON_TRACE=OFF -DGNOMON_REPORT=OFF -DGNOMON_CASEFILE=OFF -DGNOMON_TOOL=OFF
  -DGNOMON_SAMPLES=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME gnomon CONFIG_PATH lib/cmake/gnomon)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
if(VCPKG_LIBRARY_LINKAGE STREQUAL "dynamic")
  # A build of shared libraries installs the static ones as well.
  file(REMOVE "${CURRENT_PACKAGES_DIR}/lib/libgnomon_core.a" "${CURRENT_PACKAGES_DIR}/debug/lib/libgnomon_core.a"
    "${CURRENT_PACKAGES_DIR}/share/gnomon/gnomon_core-release.cmake" "${CURRENT_PACKAGES_DIR}/share/gnomon/gnomon_core-debug.cmake")
endif()
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
