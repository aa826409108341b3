// Parallel loops over a range cut into chunks whose borders depend on its length alone: whatever is reduced
// chunk by chunk, in order, is the same for any number of threads.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

namespace whittle {

inline constexpr std::size_t kChunkSize = 8192;

inline std::size_t chunkCount(std::size_t n) { return (n + kChunkSize - 1) / kChunkSize; }

/// Calls body(chunk, begin, end) for every chunk of 0..n.
template <typename Body>
void forEachChunk(std::size_t n, const Body& body) {
  tbb::parallel_for(std::size_t{0}, chunkCount(n), [&](std::size_t chunk) {
    const std::size_t begin = chunk * kChunkSize;
    body(chunk, begin, std::min(begin + kChunkSize, n));
  });
}

}  // namespace whittle
