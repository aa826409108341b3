// Embree, the opponent: the same rays, the same threads, its own tree (Wald et al. 2014; versions 3 and 4).
#pragma once

#include <memory>
#include <vector>

#include "bench/ray_sets.h"

namespace whittle {

/// One way of asking Embree. Its packets and its hints suit some rays and not others: the best of all counts.
struct EmbreeMode {
  bool robust;
  int width;  ///< 1: rtcIntersect1/rtcOccluded1; 8: rtcIntersect8/rtcOccluded8
  bool coherent;

  std::string name() const;  ///< "robust8 coherent"
};

/// All of them; robustOnly: those that promise no cracks.
std::vector<EmbreeMode> embreeModes(bool robustOnly);

/// False in a build without Embree; nothing else here may then be used.
bool haveEmbree();

/// A scene in Embree's medium build quality, for the robust or the fast modes.
class EmbreeBaseline {
 public:
  EmbreeBaseline(const Scene& scene, bool robust, int threads);
  ~EmbreeBaseline();
  EmbreeBaseline(const EmbreeBaseline&) = delete;
  EmbreeBaseline& operator=(const EmbreeBaseline&) = delete;

  double buildSeconds() const;
  /// Lays the rays out as Embree's structs; not timed.
  void load(const RaySet& rays);
  /// Seconds that a query of all rays takes on all threads.
  double nearest(const EmbreeMode& mode);
  double any(const EmbreeMode& mode);
  /// Results of the last nearest() (triangle and t) and any().
  const std::vector<QueryHit>& hits() const;
  const std::vector<std::uint8_t>& blocked() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace whittle
