// Which of the vector units that clones are compiled for (lanes/wide.hpp) does the processor have, or an
// emulated one?
//   cpu_has          prints their names
//   cpu_has FEATURE  exits 0 where it has that one
#include <cstdio>
#include <cstring>

int main(int argc, char** argv) {
  const bool has[] = {__builtin_cpu_supports("sse2") != 0, __builtin_cpu_supports("avx2") != 0,
                      __builtin_cpu_supports("avx512f") != 0};
  const char* const name[] = {"sse2", "avx2", "avx512f"};
  for (int i = 0; i < 3; ++i) {
    if (argc == 2 && std::strcmp(argv[1], name[i]) == 0) return has[i] ? 0 : 1;
    if (argc == 1 && has[i]) std::printf("%s ", name[i]);
  }
  return argc == 1 ? 0 : 2;
}
