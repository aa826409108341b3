// Arrays whose elements are written by several threads right after they are made: a vector that does not fill
// them with zeros first, on one thread.
#pragma once

#if __has_include(<sys/mman.h>)
#include <sys/mman.h>
#endif

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace whittle {

/// Asks for large pages behind an array of which all will be written: far fewer page faults. A hint.
inline void adviseLargePages([[maybe_unused]] void* p, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  constexpr std::size_t kPage = std::size_t{1} << 12, kLarge = std::size_t{1} << 21;
  if (bytes < 2 * kLarge) return;
  const auto address = reinterpret_cast<std::uintptr_t>(p);
  const auto begin = (address + kPage - 1) & ~(kPage - 1);
  const auto end = (address + bytes) & ~(kPage - 1);
  madvise(static_cast<char*>(p) + (begin - address), end - begin, MADV_HUGEPAGE);
#endif
}

template <typename T>
struct UninitializedAllocator : std::allocator<T> {
  template <typename U>
  struct rebind {
    using other = UninitializedAllocator<U>;
  };

  T* allocate(std::size_t n) {
    T* p = std::allocator<T>::allocate(n);
    adviseLargePages(p, n * sizeof(T));
    return p;
  }
  template <typename U>
  void construct(U* p) {
    ::new (static_cast<void*>(p)) U;
  }
  template <typename U, typename... Args>
  void construct(U* p, Args&&... args) {
    ::new (static_cast<void*>(p)) U(std::forward<Args>(args)...);
  }
};

/// Elements added by resize() hold anything until they are written.
template <typename T>
using UninitializedVector = std::vector<T, UninitializedAllocator<T>>;

}  // namespace whittle
