// Where does the module's memory come from, and how is it copied? A list of free blocks in the order of their places; the first that is large enough
// serves. Few blocks live at a time, so that this is as fast as the allocator of the C library, in a fraction of its bytes.
#include <cstddef>
#include <cstdint>
#include <cstring>

extern "C" unsigned char __heap_base;

namespace {

struct alignas(16) Block {
  std::size_t bytes;  // with this header
  Block* next;
};
static_assert(sizeof(Block) == 16);

Block* first_free = nullptr;
constexpr std::size_t kPage = 65536;

unsigned char* end_of(Block* block) { return reinterpret_cast<unsigned char*>(block) + block->bytes; }

// Puts a block into the list, and unites it with the free ones beside it.
void put(Block* block) {
  Block* before = nullptr;
  Block* after = first_free;
  while (after != nullptr && after < block) {
    before = after;
    after = after->next;
  }
  block->next = after;
  if (after != nullptr && end_of(block) == reinterpret_cast<unsigned char*>(after)) {
    block->bytes += after->bytes;
    block->next = after->next;
  }
  if (before == nullptr) {
    first_free = block;
  } else if (end_of(before) == reinterpret_cast<unsigned char*>(block)) {
    before->bytes += block->bytes;
    before->next = block->next;
  } else {
    before->next = block;
  }
}

Block* take(std::size_t bytes) {
  for (Block** at = &first_free; *at != nullptr; at = &(*at)->next) {
    Block* block = *at;
    if (block->bytes < bytes) continue;
    if (block->bytes - bytes >= 2 * sizeof(Block)) {
      auto* rest = reinterpret_cast<Block*>(reinterpret_cast<unsigned char*>(block) + bytes);
      *rest = {block->bytes - bytes, block->next};
      *at = rest;
      block->bytes = bytes;
    } else {
      *at = block->next;
    }
    return block;
  }
  return nullptr;
}

// Gives the list at least `bytes` more; false where the memory cannot grow.
bool grow(std::size_t bytes) {
  static bool begun = false;
  const std::size_t pages = (bytes + kPage - 1) / kPage;
  auto begin = __builtin_wasm_memory_size(0) * kPage;
  if (__builtin_wasm_memory_grow(0, pages) == SIZE_MAX) return false;
  std::size_t size = pages * kPage;
  if (!begun) {
    // What the first page of the heap has left after the data and the stack.
    const std::size_t base = (reinterpret_cast<std::size_t>(&__heap_base) + 15) & ~std::size_t{15};
    size += begin - base;
    begin = base;
    begun = true;
  }
  auto* block = reinterpret_cast<Block*>(begin);
  *block = {size, nullptr};
  put(block);
  return true;
}

}  // namespace

extern "C" {

void* malloc(std::size_t bytes) {
  if (bytes > SIZE_MAX - 2 * kPage) return nullptr;
  const std::size_t needed = ((bytes + 15) & ~std::size_t{15}) + sizeof(Block);
  Block* block = take(needed);
  if (block == nullptr && grow(needed)) block = take(needed);
  return block == nullptr ? nullptr : block + 1;
}

void free(void* place) {
  if (place != nullptr) put(static_cast<Block*>(place) - 1);
}

// Every engine that has vectors has these as one instruction; the C library has loops.
#ifdef __wasm_simd128__
#define ONE_INSTRUCTION __attribute__((target("bulk-memory")))
ONE_INSTRUCTION void* memcpy(void* to, const void* from, std::size_t bytes) { return __builtin_memcpy(to, from, bytes); }
ONE_INSTRUCTION void* memmove(void* to, const void* from, std::size_t bytes) { return __builtin_memmove(to, from, bytes); }
ONE_INSTRUCTION void* memset(void* to, int value, std::size_t bytes) { return __builtin_memset(to, value, bytes); }
#endif

}  // extern "C"
