# Gives each thread its own table of OpenGL functions: cmake -DDIR=... -P thread_local_glad.cmake, on glad's output.
# A table per context (glad's --mx) would put a context into every call; a thread has one current context anyway.
set(header ${DIR}/include/glad/gl.h)
set(source ${DIR}/src/gl.c)
# __thread and not thread_local: C++ would call a function before each use of the latter.
file(READ ${header} text)
string(REGEX REPLACE "\nGLAD_API_CALL (PFNGL[A-Z0-9_]+PROC|int) (glad_gl|GLAD_GL_)" "\nextern __thread \\1 \\2" text "${text}")
file(WRITE ${header} "${text}")
file(READ ${source} text)
string(REGEX REPLACE "\n(PFNGL[A-Z0-9_]+PROC|int) ([A-Za-z0-9_]+ = (NULL|0);)" "\n__thread \\1 \\2" text "${text}")
file(WRITE ${source} "${text}")
# Another version of glad may write these lines otherwise: a table that threads share must not go unnoticed.
foreach(file ${header} ${source})
  file(STRINGS ${file} found REGEX "__thread PFNGLCLEARPROC glad_glClear|__thread int GLAD_GL_VERSION_4_5")
  list(LENGTH found count)
  if(NOT count EQUAL 2)
    message(FATAL_ERROR "${file}: this version of glad writes its table otherwise than expected")
  endif()
  file(STRINGS ${file} shared REGEX "^(GLAD_API_CALL )?(PFNGL[A-Z0-9_]+PROC|int) (glad_gl|GLAD_GL_)[A-Za-z0-9_]+( = |;)")
  if(shared)
    message(FATAL_ERROR "${file}: threads would share these: ${shared}")
  endif()
endforeach()
