# Programs that need the C library alone, in the version of Debian 11: included by the preset `portable`.
#
# gcc stays the machine's own, and so do all objects. Only the last step differs: programs are linked against the files of
# Debian 11's C library in GNOMON_PORTABLE_LIBC (packaging/portable/libc.sh fetches them). A function that glibc 2.31 lacks
# is an undefined reference there, so none gets in unseen.
if(NOT EXISTS ${GNOMON_PORTABLE_LIBC}/usr/lib/x86_64-linux-gnu/crt1.o)
  message(FATAL_ERROR "GNOMON_PORTABLE_LIBC: ${GNOMON_PORTABLE_LIBC} has no C library: packaging/portable/libc.sh fetches it")
endif()
enable_language(C)
add_link_options(--sysroot=${GNOMON_PORTABLE_LIBC} -B${GNOMON_PORTABLE_LIBC}/usr/lib/x86_64-linux-gnu
  # gcc 12's own libgcc_eh.a calls _dl_find_object of glibc 2.35; that of gcc 10 has the same interface.
  -L${GNOMON_PORTABLE_LIBC}/usr/lib/gcc/x86_64-linux-gnu/10/eh
  -L${GNOMON_PORTABLE_LIBC}/usr/lib/x86_64-linux-gnu -L${GNOMON_PORTABLE_LIBC}/lib/x86_64-linux-gnu
  -static-libstdc++ -static-libgcc -s
  LINKER:-u,arc4random,-u,__libc_single_threaded)
add_library(gnomon_newer_libc STATIC ${PROJECT_SOURCE_DIR}/packaging/portable/newer_libc.c)

# Debian has these two as shared libraries only. find_package takes a target that exists already.
add_library(gnomon_fmt STATIC ${PROJECT_SOURCE_DIR}/packaging/portable/fmt.cpp)
target_compile_features(gnomon_fmt PRIVATE cxx_std_20)
target_compile_definitions(gnomon_fmt PUBLIC FMT_SHARED)
add_library(fmt::fmt ALIAS gnomon_fmt)
add_library(fmt::fmt-header-only ALIAS gnomon_fmt)
add_library(gnomon_tinygltf STATIC ${PROJECT_SOURCE_DIR}/packaging/portable/tinygltf.cpp)
target_compile_features(gnomon_tinygltf PRIVATE cxx_std_20)
target_compile_definitions(gnomon_tinygltf PUBLIC TINYGLTF_NO_STB_IMAGE TINYGLTF_NO_STB_IMAGE_WRITE)
add_library(TinyGLTF::TinyGLTF ALIAS gnomon_tinygltf)

link_libraries(gnomon_newer_libc -lpthread)
