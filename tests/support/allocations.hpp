#pragma once

// Counts every way to the heap: include it in one file of a program, which then has it everywhere.

#include <cstdlib>
#include <new>

#if defined(__SANITIZE_ADDRESS__)
#define ADIT_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer)
#define ADIT_SANITIZED 1
#endif
#endif

#if defined(__GLIBC__) && !defined(ADIT_SANITIZED)
#define ADIT_COUNTS_MALLOC 1
#endif

namespace adit::test {

inline long allocation_count = 0;  // no thread but the test's

/// Allocations since the program began.
inline long allocations() { return allocation_count; }

/// Whether Eigen's memory is counted, which it has from malloc: a sanitizer has a malloc of its
/// own.
#ifdef ADIT_COUNTS_MALLOC
constexpr bool kCountsMalloc = true;
#else
constexpr bool kCountsMalloc = false;
#endif

}  // namespace adit::test

#ifdef ADIT_COUNTS_MALLOC
// operator new ends here as well.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  ++adit::test::allocation_count;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++adit::test::allocation_count;
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
  ++adit::test::allocation_count;
  return __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++adit::test::allocation_count;
  return __libc_memalign(alignment, size);
}
}
#else
// Not inlined: GCC takes a free() beside a new for a mistake.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++adit::test::allocation_count;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
#endif
