// The structs and feature bits that host and device both read: the device is asked where it puts each field.
#include "kernels/shared/layout.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <regex>
#include <set>

#include "kernels/shared/features.h"
#include "support/kernel_bench.h"

namespace whittle {
namespace {

struct Field {
  std::string structure, name;
  std::size_t offset;  // in the struct, bytes
};

/// Bytes of each struct of layout.h on the host.
std::map<std::string, std::size_t> hostSizes() {
#define SIZE_OF(Structure) \
  { #Structure, sizeof(device::Structure) }
  return {SIZE_OF(Node),          SIZE_OF(DeviceTriangle),  SIZE_OF(DeviceMaterial),
          SIZE_OF(DeviceTexture), SIZE_OF(DeviceLight),     SIZE_OF(DeviceEmitter),
          SIZE_OF(DeviceCamera),  SIZE_OF(RenderConstants), SIZE_OF(Batch)};
#undef SIZE_OF
}

/// The text of layout.h with the tables of scene_tables.h written out.
std::string layoutText() {
#define VECTOR(name, size, ...) "float " #name "[" #size "];"
#define SCALAR(name, ...) "float " #name ";"
#define INDEX(slot, FEATURE, encoding, factor, OTHERS) "int " #slot ";"
  std::string text = embeddedKernelFiles().at("shared/layout.h");
  text = std::regex_replace(text, std::regex(R"(WHITTLE_MATERIAL_FACTORS\([^)]*\))"),
                            WHITTLE_MATERIAL_FACTORS(VECTOR, SCALAR));
  return std::regex_replace(text, std::regex(R"(WHITTLE_TEXTURE_SLOTS\(WHITTLE_INDEX\))"),
                            WHITTLE_TEXTURE_SLOTS(INDEX));
#undef VECTOR
#undef SCALAR
#undef INDEX
}

/// Every field that layout.h declares, read from its text, one behind the other: all are of four bytes or
/// arrays of such. Adds up the sizes of the structs.
std::vector<Field> declaredFields(std::map<std::string, std::size_t>& sizes) {
  const std::string text = layoutText();
  std::vector<Field> found;
  const std::regex structure(R"(WHITTLE_STRUCT\((\w+)\) \{([^}]*)\})"),
      field(R"((?:float|u?int) (\w+)((?:\[\d+\])*);)"), length(R"(\d+)");
  for (std::sregex_iterator s(text.begin(), text.end(), structure), end; s != end; ++s) {
    const std::string name = (*s)[1], body = (*s)[2];
    for (std::sregex_iterator f(body.begin(), body.end(), field); f != end; ++f) {
      found.push_back({name, (*f)[1], sizes[name]});
      std::size_t bytes = 4;
      const std::string lengths = (*f)[2];
      for (std::sregex_iterator n(lengths.begin(), lengths.end(), length); n != end; ++n)
        bytes *= std::stoul(n->str());
      sizes[name] += bytes;
    }
  }
  return found;
}

TEST(Layout, TheDevicePutsEveryFieldWhereTheHostDoes) {
  std::map<std::string, std::size_t> sizes;
  const std::vector<Field> fields = declaredFields(sizes);
  EXPECT_EQ(sizes, hostSizes()) << "the host has no gaps, and this test names every struct";
  std::string body;
  for (const Field& f : fields)
    body += fmt::format("  {{ {0} s; *out++ = sizeof({0}); *out++ = (uint)((char*)&s.{1} - (char*)&s); }}\n",
                        f.structure, f.name);
  test::KernelBench bench(
      {"lib/math.cl"},
      "__kernel void ask(uint n, __global uint* out) {\n  if (get_global_id(0)) return;\n" + body + "}\n");
  const auto answers = bench.map<std::uint32_t>("ask", 1, 2 * fields.size());
  for (std::size_t i = 0; i < fields.size(); ++i) {
    EXPECT_EQ(answers[2 * i], sizes[fields[i].structure]) << fields[i].structure;
    EXPECT_EQ(answers[2 * i + 1], fields[i].offset) << fields[i].structure << "." << fields[i].name;
  }
}

TEST(Layout, KernelsAndHostReadTheSameFeatureBits) {
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
}

}  // namespace
}  // namespace whittle
