// See ceilings.h.
#include "measure/ceilings.h"

#include <algorithm>
#include <barrier>
#include <chrono>
#include <cstdint>
#include <functional>
#include <numeric>
#include <thread>
#include <vector>

namespace whittle {
namespace {

using Clock = std::chrono::steady_clock;
using Lanes = float __attribute__((vector_size(64)));  // the compiler splits it where registers are narrower
/// Does a slice of work of some 0.1 ms and returns how much: operations or bytes.
using Slice = std::function<double()>;

/// Keeps the compiler from dropping a result or from computing it ahead of time.
template <typename T>
void touch(T& value) {
  asm volatile("" : "+m"(value)::"memory");
}

Slice arithmetic() {
  return [state = std::uint64_t{88172645463325252}]() mutable {
    constexpr int kSteps = 50000;
    std::uint64_t x = state;
    for (int i = 0; i < kSteps;
         ++i) {  // Marsaglia's xorshift64: six operations, each waits for the one before
      x ^= x << 13;
      x ^= x >> 7;
      x ^= x << 17;
    }
    state = x;
    touch(state);
    return 6.0 * kSteps;
  };
}

#if defined(__x86_64__) && defined(__GNUC__)
/// For the widest vectors of the processor, which is what drivers compile kernels for.
#define WIDEST __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define WIDEST
#endif

/// Eight chains, which hide the latency of each other.
WIDEST void multiplyAddChains(Lanes (&sums)[8], int steps) {
  Lanes s[8], factor = sums[0] * 0.0F + 0.999F, term = sums[0] * 0.0F + 0.001F;
  touch(factor);
  for (int k = 0; k < 8; ++k) s[k] = sums[k];
  for (int i = 0; i < steps; ++i)
    for (auto& sum : s) sum = sum * factor + term;
  for (int k = 0; k < 8; ++k) sums[k] = s[k];
  touch(sums[0]);
}

Slice multiplyAdds() {
  struct Chains {
    Lanes sums[8] = {};
  };
  return [chains = Chains{}]() mutable {
    constexpr int kSteps = 20000;
    multiplyAddChains(chains.sums, kSteps);
    return 2.0 * 8 * 16 * kSteps;
  };
}

/// One thread's share of the arrays; the first touch, here, places its pages.
Slice triad(std::size_t elements) {
  struct Arrays {
    std::vector<double> a, b, c;
    std::size_t next = 0;
  };
  Arrays arrays{std::vector<double>(elements), std::vector<double>(elements, 1.0),
                std::vector<double>(elements, 2.0)};
  return [x = std::move(arrays)]() mutable {
    constexpr std::size_t kBlock = 16384;
    const std::size_t begin = x.next, end = std::min(begin + kBlock, x.a.size());
    double* __restrict a = x.a.data();
    const double* __restrict b = x.b.data(), * __restrict c = x.c.data();
    for (std::size_t i = begin; i < end; ++i) a[i] = b[i] + 3.0 * c[i];
    touch(x.a[begin]);
    x.next = end == x.a.size() ? 0 : end;
    return 24.0 * static_cast<double>(end - begin);
  };
}

/// Work done by all threads together for each second: all start at one moment, and what is finished `seconds`
/// later counts.
double rate(int threads, double seconds, const std::function<Slice()>& make) {
  Clock::time_point deadline;
  std::barrier start(threads, [&]() noexcept {
    deadline =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  });
  std::vector<double> work(static_cast<std::size_t>(threads));
  std::vector<std::thread> crew;
  crew.reserve(work.size());
  for (int t = 0; t < threads; ++t)
    crew.emplace_back([&, t] {
      const Slice slice = make();
      slice();
      start.arrive_and_wait();
      for (double done = slice(); Clock::now() < deadline; done += slice())
        work[static_cast<std::size_t>(t)] = done;
    });
  for (auto& thread : crew) thread.join();
  return std::accumulate(work.begin(), work.end(), 0.0) / seconds;
}

}  // namespace

Ceilings measureCeilings(int threads, double seconds, double bytes) {
  const auto share = static_cast<std::size_t>(bytes / sizeof(double) / threads);
  return {threads, rate(threads, seconds, arithmetic), rate(threads, seconds, multiplyAdds),
          rate(threads, seconds, [share] { return triad(share); })};
}

}  // namespace whittle
