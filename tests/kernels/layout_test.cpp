// The structs and feature bits that host and device both read: the device is asked where it puts each field.
#include "kernels/shared/layout.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <regex>
#include <set>

#include "kernels/shared/features.h"
#include "support/kernel_bench.h"

namespace whittle {
namespace {

struct Field {
  std::string structure, name;
  std::size_t size, offset;  // of the struct; of the field in it; bytes
};

#define FIELD(Structure, field) \
  { #Structure, #field, sizeof(device::Structure), offsetof(device::Structure, field) }

std::vector<Field> hostFields() {
  return {
      FIELD(Node, lo),
      FIELD(Node, hi),
      FIELD(Node, child),
      FIELD(Node, pad),
      FIELD(DeviceTriangle, v),
      FIELD(DeviceTriangle, primitive),
      FIELD(DeviceTriangle, flags),
      FIELD(DeviceTriangle, material),
      FIELD(DeviceMaterial, baseColor),
      FIELD(DeviceMaterial, emission),
      FIELD(DeviceMaterial, metallic),
      FIELD(DeviceMaterial, sigma_a),
      FIELD(DeviceMaterial, roughness),
      FIELD(DeviceMaterial, specularColor),
      FIELD(DeviceMaterial, specular),
      FIELD(DeviceMaterial, transmission),
      FIELD(DeviceMaterial, ior),
      FIELD(DeviceMaterial, alphaCutoff),
      FIELD(DeviceMaterial, normalScale),
      FIELD(DeviceMaterial, flags),
      FIELD(DeviceMaterial, baseColorTexture),
      FIELD(DeviceMaterial, metallicRoughnessTexture),
      FIELD(DeviceMaterial, normalTexture),
      FIELD(DeviceMaterial, emissionTexture),
      FIELD(DeviceMaterial, specularTexture),
      FIELD(DeviceMaterial, specularColorTexture),
      FIELD(DeviceMaterial, transmissionTexture),
      FIELD(DeviceTexture, transform),
      FIELD(DeviceTexture, firstTexel),
      FIELD(DeviceTexture, width),
      FIELD(DeviceTexture, height),
      FIELD(DeviceTexture, wrapS),
      FIELD(DeviceTexture, wrapT),
      FIELD(DeviceTexture, nearest),
      FIELD(DeviceTexture, uvSet),
      FIELD(DeviceLight, intensity),
      FIELD(DeviceLight, kind),
      FIELD(DeviceLight, position),
      FIELD(DeviceLight, range),
      FIELD(DeviceLight, direction),
      FIELD(DeviceLight, castsShadows),
      FIELD(DeviceLight, versineOuter),
      FIELD(DeviceLight, versineInner),
      FIELD(DeviceLight, pad),
      FIELD(DeviceCamera, position),
      FIELD(DeviceCamera, forward),
      FIELD(DeviceCamera, stepX),
      FIELD(DeviceCamera, stepXLow),
      FIELD(DeviceCamera, stepY),
      FIELD(DeviceCamera, stepYLow),
      FIELD(DeviceCamera, orthographic),
      FIELD(DeviceCamera, seed),
      FIELD(DeviceCamera, width),
      FIELD(DeviceCamera, height),
      FIELD(DeviceCamera, raysPerPixel),
      FIELD(DeviceCamera, sampler),
      FIELD(DeviceCamera, pad),
      FIELD(RenderConstants, background),
      FIELD(RenderConstants, rayOffset),
      FIELD(RenderConstants, backgroundWidth),
      FIELD(RenderConstants, backgroundHeight),
      FIELD(RenderConstants, mirrorRoughness),
      FIELD(RenderConstants, seed),
      FIELD(RenderConstants, cutoff),
      FIELD(Batch, firstPixel),
      FIELD(Batch, pixels),
      FIELD(Batch, firstSample),
      FIELD(Batch, samples),
  };
}

/// Every "Structure.field" that layout.h declares, read from its text.
std::set<std::string> declaredFields() {
  const std::string& text = embeddedKernelFiles().at("shared/layout.h");
  std::set<std::string> found;
  const std::regex structure(R"(WHITTLE_STRUCT\((\w+)\) \{([^}]*)\})"),
      field(R"((?:float|u?int) (\w+)(?:\[\d+\])*;)");
  for (std::sregex_iterator s(text.begin(), text.end(), structure), end; s != end; ++s) {
    const std::string body = (*s)[2];
    for (std::sregex_iterator f(body.begin(), body.end(), field); f != end; ++f)
      found.insert((*s)[1].str() + "." + (*f)[1].str());
  }
  return found;
}

TEST(Layout, TheDevicePutsEveryFieldWhereTheHostDoes) {
  const auto fields = hostFields();
  std::set<std::string> named;
  std::string body;
  for (const Field& f : fields) {
    named.insert(f.structure + "." + f.name);
    body += fmt::format("  {{ {0} s; *out++ = sizeof({0}); *out++ = (uint)((char*)&s.{1} - (char*)&s); }}\n",
                        f.structure, f.name);
  }
  EXPECT_EQ(named, declaredFields()) << "this test must ask for every field of layout.h";
  test::KernelBench bench(
      {"lib/math.cl"},
      "__kernel void ask(uint n, __global uint* out) {\n  if (get_global_id(0)) return;\n" + body + "}\n");
  const auto answers = bench.map<std::uint32_t>("ask", 1, 2 * fields.size());
  for (std::size_t i = 0; i < fields.size(); ++i) {
    EXPECT_EQ(answers[2 * i], fields[i].size) << fields[i].structure;
    EXPECT_EQ(answers[2 * i + 1], fields[i].offset) << fields[i].structure << "." << fields[i].name;
  }
}

TEST(Layout, TheTwoListsOfFeatureBitsAgree) {
#define NAME_OF(name, bit, text) #name,
#define BIT_OF(name, bit, text) bit,
  const std::vector<std::string> names{WHITTLE_FEATURES(NAME_OF)};
  const std::vector<int> bits{WHITTLE_FEATURES(BIT_OF)};
#undef NAME_OF
#undef BIT_OF
  EXPECT_EQ(std::set<int>(bits.begin(), bits.end()).size(), bits.size()) << "a bit for each feature";
  // Every second feature on, so that HAS is seen to tell them apart, above bit 31 too.
  std::uint64_t half = 0;
  std::string body;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i % 2) half |= std::uint64_t{1} << bits[i];
    body += fmt::format("  *out++ = BIT_{0};\n#if HAS({0})\n  *out++ = 1;\n#else\n  *out++ = 0;\n#endif\n",
                        names[i]);
  }
  test::KernelBench bench(
      {"lib/math.cl"},
      "__kernel void ask(uint n, __global int* out) {\n  if (get_global_id(0)) return;\n" + body + "}\n",
      half);
  const auto answers = bench.map<std::int32_t>("ask", 1, 2 * names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(answers[2 * i], bits[i]) << names[i];
    EXPECT_EQ(answers[2 * i + 1], static_cast<int>(i % 2)) << names[i];
  }
  const std::regex define(R"(#define BIT_(\w+) \d+)");
  const std::string& text = embeddedKernelFiles().at("shared/features.h");
  EXPECT_EQ(static_cast<std::size_t>(std::distance(std::sregex_iterator(text.begin(), text.end(), define),
                                                   std::sregex_iterator())),
            names.size())
      << "no bit without a name in the list";
}

}  // namespace
}  // namespace whittle
