// The `gnomon` program.
#include "program.hpp"

int main(int argc, char** argv) {
  return gnomon::tool::run_gnomon(argc, argv);
}
