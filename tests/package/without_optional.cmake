# Does the project configure and build without OpenImageIO, Draco, meshoptimizer, Embree, GLFW, Dear ImGui, and the
# pkg-config that OpenImageIO and Dear ImGui are found by? Without TARGETS, all that stands in for them is compiled;
# TARGETS=all (./dev check packages) builds everything and asks the programs for what is missing, which takes minutes.
file(REMOVE_RECURSE ${WORK_DIR})
set(parts OPENIMAGEIO DRACO MESHOPTIMIZER EMBREE GLFW IMGUI)
list(TRANSFORM parts REPLACE "(.+)" "-DGNOMON_WITH_\\1=OFF")

function(step what expected)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT code EQUAL expected)
    message(FATAL_ERROR "${what} ended with ${code}, not ${expected}:\n${out}")
  endif()
  set(step_output "${out}" PARENT_SCOPE)
endfunction()

function(expect_word part)
  string(FIND "${step_output}" "${part}" found)
  if(found EQUAL -1)
    message(FATAL_ERROR "nothing says '${part}':\n${step_output}")
  endif()
endfunction()

# Joined sources have no object file of their own that could be asked for.
set(joined OFF)
if(TARGETS STREQUAL "all")
  set(joined ON)
endif()
step("configuring" 0 ${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR} -G Ninja -DCMAKE_BUILD_TYPE=Release
  -DCMAKE_CXX_COMPILER=${CXX} -DGNOMON_WERROR=ON -DGNOMON_QUICK_BUILD=${joined} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}
  -DCMAKE_DISABLE_FIND_PACKAGE_PkgConfig=ON ${parts})
foreach(part OPENIMAGEIO DRACO MESHOPTIMIZER EMBREE GLFW IMGUI)
  expect_word("Built without ${part}, as asked for")
endforeach()
if(NOT TARGETS)
  set(TARGETS src/scene/CMakeFiles/gnomon_scene.dir/image_absent.cpp.o
    src/scene/CMakeFiles/gnomon_scene.dir/gltf_draco_absent.cpp.o
    src/scene/CMakeFiles/gnomon_scene.dir/gltf_meshopt_absent.cpp.o
    src/trace/CMakeFiles/gnomon_trace.dir/embree_absent.cpp.o
    src/render/CMakeFiles/gnomon_window.dir/context/glfw_absent.cpp.o
    src/tool/CMakeFiles/gnomon_view.dir/view/window_absent.cpp.o)
endif()
step("building" 0 ${CMAKE_COMMAND} --build ${WORK_DIR} --target ${TARGETS})
if(NOT TARGETS STREQUAL "all")
  return()
endif()
set(SCENE ${SOURCE_DIR}/tests/fuzz/seeds/gltf/triangle.gltf)
step("a window" 2 ${WORK_DIR}/bin/flythrough --context glfw ${SCENE})
expect_word("built without GLFW")
step("the viewer" 2 ${WORK_DIR}/bin/gnomon view ${SCENE})
expect_word("built without GLFW")
expect_word("Dear ImGui")
step("pictures" 0 ${WORK_DIR}/bin/flythrough --frames 1 --size 32x32 --map-size 32 --out ${WORK_DIR}/out ${SCENE})
step("a picture read again" 0 ${WORK_DIR}/bin/gnomon diff ${WORK_DIR}/out/contact_sheet.png ${WORK_DIR}/out/contact_sheet.png)
step("a plan" 0 ${WORK_DIR}/bin/gnomon plan ${SOURCE_DIR}/tests/data/cases/light45.json)
message(STATUS "built and run without OpenImageIO, Draco, meshoptimizer, Embree, GLFW and Dear ImGui")
