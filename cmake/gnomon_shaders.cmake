# The names of the filters' options in GLSL, for the renderer and for engines: gnomon_option_files in gnomon_option_dir.
set(gnomon_generated_shaders ${PROJECT_BINARY_DIR}/shaders)
gnomon_registry(gnomon_option_sources ${PROJECT_SOURCE_DIR}/include/gnomon/render/filters.def GNOMON_FILTER
  ${PROJECT_SOURCE_DIR}/src/render/filter .cpp)
set(gnomon_option_files)
foreach(source ${gnomon_option_sources})
  get_filename_component(filter ${source} NAME_WE)
  list(APPEND gnomon_option_files ${gnomon_generated_shaders}/filter/option/${filter}.glsl)
endforeach()
list(JOIN gnomon_option_sources "," sources)
add_custom_command(
  OUTPUT ${gnomon_option_files}
  COMMAND ${CMAKE_COMMAND} -DSOURCES=${sources} -DOUT=${gnomon_generated_shaders}/filter/option
          -P ${CMAKE_CURRENT_LIST_DIR}/option_names.cmake
  DEPENDS ${gnomon_option_sources} ${CMAKE_CURRENT_LIST_DIR}/option_names.cmake
  COMMENT "Naming the filters' options in GLSL")
add_custom_target(gnomon_option_names ALL DEPENDS ${gnomon_option_files})
