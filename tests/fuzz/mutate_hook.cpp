// Lends libFuzzer the changes that know formats: a quarter of what it tries.
#include <algorithm>
#include <cstring>

#include "fuzz.hpp"
#include "mutate.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  if (seed % 4 != 0) return LLVMFuzzerMutate(data, size, max_size);
  const std::string changed = gnomon::fuzz::mutated(gnomon::fuzz::as_text(data, size), seed / 4);
  const std::size_t length = std::min(changed.size(), max_size);
  std::memcpy(data, changed.data(), length);
  return length;
}
