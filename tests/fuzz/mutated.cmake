# The fuzz targets' readers, and the programs themselves, on files that are nearly right: a small batch, always the
# same, in each run of the tests. With --count 5000 and other seeds by hand, see SECURITY.md.
find_package(nlohmann_json REQUIRED)
set(fuzz ${CMAKE_CURRENT_LIST_DIR})
gnomon_test_label(unit)

# What all of them share.
add_library(gnomon_mutate OBJECT ${fuzz}/mutated_main.cpp ${fuzz}/mutate.cpp)
gnomon_test_options(gnomon_mutate)
target_link_libraries(gnomon_mutate PRIVATE nlohmann_json::nlohmann_json)
target_include_directories(gnomon_mutate PRIVATE ${fuzz})

# gnomon_mutated(NAME SEEDS file... LIBS target... [SOURCES file...]): the program mutated_NAME, from NAME_fuzz.cpp.
function(gnomon_mutated name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SEEDS;LIBS;SOURCES")
  add_executable(mutated_${name} $<TARGET_OBJECTS:gnomon_mutate> ${fuzz}/${name}_fuzz.cpp ${arg_SOURCES})
  gnomon_target(mutated_${name})
  target_link_libraries(mutated_${name} PRIVATE ${arg_LIBS} nlohmann_json::nlohmann_json)
  target_include_directories(mutated_${name} PRIVATE ${fuzz} ${PROJECT_SOURCE_DIR}/src/scene
    ${PROJECT_SOURCE_DIR}/src/report ${PROJECT_SOURCE_DIR}/src/report/page ${PROJECT_SOURCE_DIR}/src/core ${PROJECT_SOURCE_DIR}/tests/core)
  set_target_properties(mutated_${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin/tests)
  gnomon_mutated_test(mutated_${name} ${name} --count 150 ${arg_SEEDS})
endfunction()

# gnomon_mutated_test(TEST NAME argument...): one run of mutated_NAME.
function(gnomon_mutated_test test name)
  add_test(NAME ${test} COMMAND mutated_${name} --keep ${CMAKE_CURRENT_BINARY_DIR}/mutated ${ARGN})
  gnomon_set_test(${test})
  add_dependencies(tests_${gnomon_label} mutated_${name})
endfunction()

foreach(kind camera_path cost_model gltf image rows stability)
  file(GLOB seeds_${kind} CONFIGURE_DEPENDS ${fuzz}/seeds/${kind}/*)
endforeach()
file(GLOB seeds_case CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/data/cases/*.json)

if(TARGET gnomon_casefile)
  gnomon_mutated(case SEEDS ${seeds_case} LIBS gnomon::casefile SOURCES ${fuzz}/plan_promises.cpp)
endif()
file(GLOB seeds_capture CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/samples/capture/*.json)
if(TARGET gnomon_judge)
  gnomon_mutated(capture SEEDS ${seeds_capture} LIBS gnomon_judge)
endif()
if(TARGET gnomon_scene)
  gnomon_mutated(gltf SEEDS ${seeds_gltf} LIBS gnomon::scene)
  gnomon_mutated(camera_path SEEDS ${seeds_camera_path} LIBS gnomon::scene)
  if(GNOMON_HAS_OPENIMAGEIO)
    gnomon_mutated(image SEEDS ${seeds_image} LIBS gnomon::scene
      SOURCES ${PROJECT_SOURCE_DIR}/src/scene/png.cpp)
  endif()
endif()
if(TARGET gnomon_report)
  gnomon_mutated(rows SEEDS ${seeds_rows} LIBS gnomon::report)
  gnomon_mutated(stability SEEDS ${seeds_stability} LIBS gnomon::report)
  gnomon_mutated(cost_model SEEDS ${seeds_cost_model} LIBS gnomon::report)
endif()
gnomon_test_label(program)
if(TARGET gnomon_program AND TARGET mutated_case)
  add_dependencies(tests_program gnomon_program)
  gnomon_mutated_test(mutated_case_program case --count 15 ${seeds_case} -- $<TARGET_FILE:gnomon_program> plan {})
  if(TARGET mutated_rows)
    gnomon_mutated_test(mutated_rows_program rows --count 6 --name results.jsonl ${seeds_rows}
      -- $<TARGET_FILE:gnomon_program> report {in})
  endif()
endif()
if(TARGET flythrough)
  add_dependencies(tests_program flythrough)
  set(fly --frames 1 --size 32x18 --map-size 64 --context osmesa --out {out})
  gnomon_mutated_test(mutated_gltf_program gltf --count 7 ${seeds_gltf} -- $<TARGET_FILE:flythrough> {} ${fly})
  gnomon_mutated_test(mutated_camera_path_program camera_path --count 4 ${seeds_camera_path}
    -- $<TARGET_FILE:flythrough> builtin:fence --path {} ${fly})
  gnomon_mutated_test(mutated_cost_model_program cost_model --count 4 ${seeds_cost_model}
    -- $<TARGET_FILE:flythrough> builtin:fence --budget-ms 5 --cost-model {} ${fly})
endif()
