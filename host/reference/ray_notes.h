// Writes down what the recursion does with a ray, for whoever asks why a pixel is as it is. Where nobody asks
// (Sample::tree is null) each call is one comparison.
#pragma once

#include "reference/trace.h"

namespace whittle::reference {

/// Of one ray: what it is, then what it meets, then what is found there.
class RayNotes {
 public:
  RayNotes(RayTree* tree, const Ray& ray, const Step& step, const Vec3& throughput) : tree_(tree) {
    if (tree_) begin(ray, step, throughput);
  }

  /// `kept`: the share of what leaves the surface that the ray brings to its origin. All below is told of as
  /// it leaves the surface.
  void meets(const World& world, const Ray& ray, const Hit& hit, const Surfel& surfel, const Vec3& kept) {
    if (tree_) meet(world, ray, hit, surfel, kept);
  }
  /// Radiance that no shadow ray is sent for.
  void local(const Vec3& radiance) {
    if (tree_) add(radiance);
  }
  void shadowRay(std::size_t light, const Ray& ray, double length, const Vec3& unshadowed,
                 const Vec3& arrived) {
    if (tree_)
      add({static_cast<std::uint32_t>(light), ray.origin, ray.direction, length, unshadowed, arrived});
  }
  void ended(const Vec3& share, bool byCutoff) {
    if (tree_) record().ended.push_back({maxComponent(share), byCutoff});
  }

  /// In the tree; −1 where nobody asks.
  int index() const { return index_; }

 private:
  RayRecord& record() { return tree_->rays[static_cast<std::size_t>(index_)]; }
  void begin(const Ray& ray, const Step& step, const Vec3& throughput);
  void meet(const World& world, const Ray& ray, const Hit& hit, const Surfel& surfel, const Vec3& kept);
  void add(const Vec3& radiance);
  void add(ShadowRecord shadow);

  RayTree* tree_;
  int index_ = -1;
  Vec3 kept_{1};
};

}  // namespace whittle::reference
