# GLM's headers alone: their folder is that of this machine's C library, which a cross compiler must not read.
set(GLM_HEADERS "/usr/include/glm" CACHE PATH "the folder glm")
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/include)
file(CREATE_LINK ${GLM_HEADERS} ${CMAKE_BINARY_DIR}/include/glm SYMBOLIC)
add_library(glm::glm INTERFACE IMPORTED)
target_include_directories(glm::glm INTERFACE ${CMAKE_BINARY_DIR}/include)
