# Can an engine take gnomon's tree into its own? SHARED says which kind of library its build makes, CXX which compiler.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)
file(REMOVE_RECURSE ${WORK_DIR})
set(packages TinyGLTF OpenImageIO glfw3 OpenGL embree nlohmann_json fmt CLI11 PkgConfig Threads GTest)
list(TRANSFORM packages REPLACE "(.+)" "-DCMAKE_DISABLE_FIND_PACKAGE_\\1=ON" OUTPUT_VARIABLE disabled)
step("configuring" ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/subproject -B ${WORK_DIR}/build -G Ninja
  -DGNOMON_SOURCE=${SOURCE_DIR} -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}
  "-DCMAKE_CXX_FLAGS=-O0 -Wall -Wextra -Werror" -DBUILD_SHARED_LIBS=${SHARED} -DCMAKE_EXPORT_COMPILE_COMMANDS=ON
  -DCMAKE_INSTALL_PREFIX=${WORK_DIR}/prefix ${disabled})
# Warnings are the engine's business.
file(READ ${WORK_DIR}/build/compile_commands.json commands)
foreach(flag -Wconversion -Wshadow -Wpedantic)
  string(FIND "${commands}" "${flag}" found)
  if(NOT found EQUAL -1)
    message(FATAL_ERROR "gnomon's own ${flag} is among the commands")
  endif()
endforeach()
step("building" ${CMAKE_COMMAND} --build ${WORK_DIR}/build)
step("running" ${WORK_DIR}/build/engine)
expect_text("engine: ")
step("installing" ${CMAKE_COMMAND} --install ${WORK_DIR}/build)
file(GLOB_RECURSE installed RELATIVE ${WORK_DIR}/prefix ${WORK_DIR}/prefix/*)
if(NOT installed STREQUAL "bin/engine")
  message(FATAL_ERROR "gnomon installs files without being asked: ${installed}")
endif()
