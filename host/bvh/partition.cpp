// In-place partition, serial and parallel. The parallel one partitions each chunk by itself and then
// exchanges the k-th triangle that lies too far left with the k-th that lies too far right.
#include "bvh/partition.h"

#include <algorithm>
#include <vector>

#include "bvh/chunks.h"

namespace whittle {

namespace {

Box4 centroidBounds(std::span<const PrimRef> refs) {
  // Two boxes in turn: a minimum waits for the one before it.
  Box4 even, odd;
  std::size_t i = 0;
  for (; i + 1 < refs.size(); i += 2) {
    even.grow(refs[i].centroid2());
    odd.grow(refs[i + 1].centroid2());
  }
  if (i < refs.size()) even.grow(refs[i].centroid2());
  even.grow(odd);
  return even;
}

}  // namespace

template <typename Test>
Partition partition(std::span<PrimRef> refs, const Test& sideTest) {
  const Test test = sideTest;  // a copy: the stores below cannot change it, so it stays in registers
  // Without unpredictable branches (Lomuto): which side comes next is a coin toss.
  std::size_t end = 0;
  for (std::size_t i = 0; i < refs.size(); ++i) {
    const PrimRef ref = refs[i];
    const bool first = test.first(ref);
    refs[i] = refs[end];
    refs[end] = ref;
    end += first ? 1 : 0;
  }
  Partition result;
  result.first = end;
  result.centroids[0] = centroidBounds(refs.first(end));
  result.centroids[1] = centroidBounds(refs.subspan(end));
  return result;
}

namespace {

/// Positions first..first+count-1 of the array hold triangles of the wrong side;
/// `before` others do, further left.
struct Misplaced {
  std::size_t first, count, before;
};

/// Appends what of [begin, end) lies in [from, to).
void clip(std::vector<Misplaced>& list, std::size_t begin, std::size_t end, std::size_t from,
          std::size_t to) {
  begin = std::max(begin, from);
  end = std::min(end, to);
  if (begin >= end) return;
  const std::size_t before = list.empty() ? 0 : list.back().before + list.back().count;
  list.push_back({begin, end - begin, before});
}

/// Exchanges the k-th entries of both lists, which are equally long in sum, for all k.
void exchange(std::span<PrimRef> refs, const std::vector<Misplaced>& a, const std::vector<Misplaced>& b) {
  tbb::parallel_for(std::size_t{0}, a.size(), [&](std::size_t i) {
    std::size_t done = 0;
    // The last run of b that begins at or before this one's first entry.
    auto run = std::prev(std::upper_bound(b.begin(), b.end(), a[i].before,
                                          [](std::size_t k, const Misplaced& m) { return k < m.before; }));
    while (done < a[i].count) {
      const std::size_t offset = a[i].before + done - run->before;
      const std::size_t n = std::min(a[i].count - done, run->count - offset);
      const auto from = refs.begin() + static_cast<std::ptrdiff_t>(a[i].first + done);
      std::swap_ranges(from, from + static_cast<std::ptrdiff_t>(n),
                       refs.begin() + static_cast<std::ptrdiff_t>(run->first + offset));
      done += n;
      ++run;
    }
  });
}

}  // namespace

template <typename Test>
Partition partitionParallel(std::span<PrimRef> refs, const Test& test) {
  std::vector<Partition> parts(chunkCount(refs.size()));
  forEachChunk(refs.size(), [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    parts[chunk] = partition(refs.subspan(begin, end - begin), test);
  });
  Partition result;
  for (const Partition& part : parts) {
    result.first += part.first;
    for (int side = 0; side < 2; ++side) result.centroids[side].grow(part.centroids[side]);
  }
  std::vector<Misplaced> tooFarLeft, tooFarRight;
  for (std::size_t chunk = 0; chunk < parts.size(); ++chunk) {
    const std::size_t begin = chunk * kChunkSize;
    const std::size_t end = std::min(begin + kChunkSize, refs.size());
    const std::size_t middle = begin + parts[chunk].first;
    clip(tooFarLeft, middle, end, 0, result.first);
    clip(tooFarRight, begin, middle, result.first, refs.size());
  }
  exchange(refs, tooFarLeft, tooFarRight);
  return result;
}

template Partition partition(std::span<PrimRef>, const SideTest&);
template Partition partition(std::span<PrimRef>, const SizeTest&);
template Partition partitionParallel(std::span<PrimRef>, const SideTest&);
template Partition partitionParallel(std::span<PrimRef>, const SizeTest&);

}  // namespace whittle
