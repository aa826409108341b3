// Shares of a pixel's value that its rays bring, worked out by hand.
#include "view/ray_shares.h"

#include <gtest/gtest.h>

namespace whittle::test {
namespace {

/// An eye ray of 1 with two children of 2 and 3; the first of them has one of 4, the second one of 0.
RayTree family() {
  RayTree tree;
  const auto add = [&](int parent, double throughput, double radiance) {
    RayRecord ray;
    ray.parent = parent;
    ray.throughput = glm::dvec3(throughput), ray.radiance = glm::dvec3(radiance, 0, 0);
    tree.rays.push_back(ray);
  };
  add(-1, 1, 1);
  add(0, 0.5, 4);
  add(0, 1, 3);
  add(1, 0.25, 16);
  add(2, 0, 9);
  return tree;
}

TEST(RayShares, AreOfTheWholeSum) {
  const view::RayShares shares = view::sharesOf(family());
  const std::vector<double> own{0.1, 0.2, 0.3, 0.4, 0}, below{1, 0.6, 0.3, 0.4, 0};
  for (std::size_t i = 0; i < own.size(); ++i) {
    EXPECT_DOUBLE_EQ(shares.own[i], own[i]) << i;
    EXPECT_DOUBLE_EQ(shares.below[i], below[i]) << i;
  }
  EXPECT_EQ(shares.largestFirst, (std::vector<std::size_t>{3, 2, 1, 0, 4}));
  EXPECT_EQ(shares.leadsToLargest, (std::vector<bool>{true, true, false, true, false}));
}

TEST(RayShares, OfABlackPixelThereAreNone) {
  RayTree tree = family();
  for (RayRecord& ray : tree.rays) ray.radiance = glm::dvec3(0);
  const view::RayShares shares = view::sharesOf(tree);
  EXPECT_EQ(shares.own, std::vector<double>(5, 0.0));
  EXPECT_EQ(shares.largestFirst, (std::vector<std::size_t>{0, 1, 2, 3, 4})) << "in the order of the tree";
  EXPECT_TRUE(view::sharesOf({}).largestFirst.empty());
}

}  // namespace
}  // namespace whittle::test
