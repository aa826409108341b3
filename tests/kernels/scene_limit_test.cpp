// A scene with a buffer larger than the device allows in one allocation is refused with one line that names
// the buffer and both numbers. The limit is a made-up one: the device as it is, told to be small.
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
  EXPECT_NE(array.find(fmt::format("'triangles' needs {} ({} bytes)", formatBytes(3201 * 48), 3201 * 48)),
            std::string::npos)
      << array;
}

}  // namespace
}  // namespace whittle
