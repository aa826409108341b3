// A scene with a buffer larger than the device allows in one allocation is refused with one line that names
// the buffer and both numbers. The limit is a made-up one: the device as it is, told to be small. And what a
// triangle takes.
#include <gtest/gtest.h>

#include "scene/byte_counts.h"
#include "support/search_bench.h"

namespace whittle {
namespace {

using test::SearchBench;
using test::SearchForm;
using test::searchForms;
using test::SearchLab;

std::string refusal(SearchLab& lab, const Scene& scene, const SearchForm& form) {
  try {
    SearchBench bench(lab, scene, form);
  } catch (const ClError& e) {
    return e.what();
  }
  return "not refused";
}

TEST(SceneLimit, EveryFormSaysWhichBufferAndBothNumbers) {
  const Scene scene = test::sceneOf(test::heightField(40, 71));  // 3200 triangles: every form needs 100 kB
  SearchLab lab;
  DeviceInfo small = lab.compute.device();
  small.largestBuffer = 65536;
  lab.compute = Compute(small);
  for (const SearchForm& form : searchForms()) {
    const std::string said = refusal(lab, scene, form);
    const auto has = [&](const std::string& part) { return said.find(part) != std::string::npos; };
    EXPECT_TRUE(has("buffer '") && has(" needs ") && has("65.5 kB (65536 bytes)") && has(small.name))
        << form.name << ": " << said;
    EXPECT_FALSE(has("\n")) << form.name << ": " << said;
  }
  const std::string array = refusal(lab, scene, searchForms()[0]);
  EXPECT_NE(array.find(fmt::format("'leaves' needs {} ({} bytes)", formatBytes(3201 * 36), 3201 * 36)),
            std::string::npos)
      << array;
}

/// Nine floats and three words for each triangle, once, whoever searches; with the nodes that packets read at
/// most 75 bytes. One more of each is there for what nothing hits.
TEST(SceneLimit, BytesOfATriangleWithoutAttributes) {
  const Scene scene = test::sceneOf(test::heightField(128, 72));
  const std::size_t triangles = scene.triangles.size();
  SearchLab lab;
  for (const SearchForm& form : searchForms()) {
    SCOPED_TRACE(form.name);
    const SearchBench bench(lab, scene, form);
    EXPECT_EQ(bench.deviceScene.leaves.bytes, 36 * (triangles + 1));
    EXPECT_EQ(bench.deviceScene.triangles.bytes, 12 * (triangles + 1));
    std::vector<BufferStats> buffers;
    bench.deviceScene.report(buffers);
    std::size_t bytes = 0;
    for (const BufferStats& b : buffers) bytes += b.bytes;
    if (form.lanes == Lanes::Sixteen) {
      EXPECT_LE(bytes, 75 * triangles);
    }
  }
}

}  // namespace
}  // namespace whittle
