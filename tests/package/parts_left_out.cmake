# Does the project configure with any one of its parts left out? What needs that part is left out along with it. And does
# the core alone ask for no package but GLM?
file(REMOVE_RECURSE ${WORK_DIR})
set(parts SCENE RENDER TRACE REPORT CASEFILE TOOL)
function(configure name)
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR}/${name} -G Ninja -DCMAKE_CXX_COMPILER=${CXX}
    ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGN} does not configure:\n${out}")
  endif()
endfunction()

foreach(part ${parts})
  configure(${part} -DGNOMON_${part}=OFF)
endforeach()
list(TRANSFORM parts REPLACE "(.+)" "-DGNOMON_\\1=OFF" OUTPUT_VARIABLE off)
set(packages TinyGLTF OpenImageIO glfw3 OpenGL embree nlohmann_json fmt CLI11 PkgConfig Threads)
list(TRANSFORM packages REPLACE "(.+)" "-DCMAKE_DISABLE_FIND_PACKAGE_\\1=ON" OUTPUT_VARIABLE disabled)
configure(core ${off} -DGNOMON_SAMPLES=OFF ${disabled})
# Without a build type it is an optimized build.
file(STRINGS ${WORK_DIR}/core/CMakeCache.txt type REGEX "^CMAKE_BUILD_TYPE:")
if(NOT type MATCHES "=Release$")
  message(FATAL_ERROR "a build without a type is '${type}', not Release")
endif()
