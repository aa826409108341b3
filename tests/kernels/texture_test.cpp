// Texture lookups against a twin written from host/reference/README.md, "Textures": wrap
// modes, filters, sRGB.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "kernels/shared/layout.h"
#include "support/lane_bench.h"
#include "support/random_scenes.h"

namespace whittle {
namespace {

/// `textures` holds the same one twice: every second work item looks it up under one number, the others under
/// both, which lanes read in another way. `turns`: entries look up two textures in turns.
constexpr const char* kTextureKernels = R"(
Rgba lookup(__global const DeviceTexture* textures, __global const uint* texels, __global const float* linearFromSrgb,
            __global const float* coordinates, Natural entry, Natural chosen, int srgb) {
  SceneView scene;
  scene.textures = textures;
  scene.texels = texels;
  scene.linearFromSrgb = linearFromSrgb;
  Uv uv;
  for (uint set = 0; set < 2; ++set) uv.uLow[set] = uv.vLow[set] = (Real)(0.0f);
  uv.u[0] = uv.v[0] = (Real)(0.3f);
  uv.u[1] = gather(coordinates, 2u * entry);
  uv.v[1] = gather(coordinates + 1, 2u * entry);
  return sampleTexture(&scene, chosen, &uv, srgb);
}

__kernel void lookups(uint n, int srgb, __global const DeviceTexture* textures, __global const uint* texels,
                      __global const float* linearFromSrgb, __global const float* coordinates, __global float* out) {
  FOR_ENTRIES(i, n)
  const Natural chosen = i % 2 ? (Natural)(0) : entry & 1u;
  const Rgba found = lookup(textures, texels, linearFromSrgb, coordinates, entry, chosen, srgb);
  for (uint c = 0; c < 4; ++c) put(out, 4u * entry + c, found.c[c]);
}

__kernel void turns(uint n, int srgb, __global const DeviceTexture* textures, __global const uint* texels,
                    __global const float* linearFromSrgb, __global const float* coordinates, __global float* out) {
  FOR_ENTRIES(i, n)
  const Rgba found = lookup(textures, texels, linearFromSrgb, coordinates, entry, entry & 1u, srgb);
  for (uint c = 0; c < 4; ++c) put(out, 4u * entry + c, found.c[c]);
}
)";

struct Picture {
  int width, height;
  std::vector<std::array<std::uint8_t, 4>> texels;
};

double linear(std::uint8_t value, bool srgb) {
  const double s = value / 255.0;
  if (!srgb) return s;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

/// Texel index for any integer, from the meaning of the wrap modes: repetition, mirror images,
/// the border texel.
int wrapped(long long i, int size, std::uint32_t mode) {
  if (mode == WRAP_CLAMP) return static_cast<int>(std::clamp(i, 0LL, static_cast<long long>(size) - 1));
  const long long period = mode == WRAP_REPEAT ? size : 2LL * size;
  long long m = i % period;
  if (m < 0) m += period;
  return static_cast<int>(m < size ? m : period - 1 - m);
}

glm::dvec4 texel(const Picture& p, long long x, long long y, const device::DeviceTexture& t, bool srgb) {
  const auto& c = p.texels[static_cast<std::size_t>(wrapped(y, p.height, t.wrapT) * p.width +
                                                    wrapped(x, p.width, t.wrapS))];
  return {linear(c[0], srgb), linear(c[1], srgb), linear(c[2], srgb), c[3] / 255.0};
}

glm::dvec4 twin(const Picture& p, double u, double v, const device::DeviceTexture& t, bool srgb) {
  const double x = u * p.width, y = v * p.height;
  if (t.flags & TEXTURE_NEAREST)
    return texel(p, std::llround(std::floor(x)), std::llround(std::floor(y)), t, srgb);
  const double fx = std::floor(x - 0.5), fy = std::floor(y - 0.5), wx = x - 0.5 - fx, wy = y - 0.5 - fy;
  const auto ix = static_cast<long long>(fx), iy = static_cast<long long>(fy);
  return (texel(p, ix, iy, t, srgb) * (1 - wx) + texel(p, ix + 1, iy, t, srgb) * wx) * (1 - wy) +
         (texel(p, ix, iy + 1, t, srgb) * (1 - wx) + texel(p, ix + 1, iy + 1, t, srgb) * wx) * wy;
}

class TextureBench {
 public:
  TextureBench() : bench({"lib/surface/texture.cl"}, kTextureKernels) {
    for (int i = 0; i < 256; ++i)
      table_.push_back(static_cast<float>(linear(static_cast<std::uint8_t>(i), true)));
  }
  std::vector<float> operator()(const device::DeviceTexture& t, const Picture& p, bool srgb,
                                const std::vector<float>& uv) {
    const std::vector<std::array<std::uint8_t, 4>> padding(t.firstTexel, {1, 2, 3, 4});
    auto all = padding;
    all.insert(all.end(), p.texels.begin(), p.texels.end());
    const int asSrgb = srgb;
    return bench.map<float>("lookups", static_cast<std::uint32_t>(uv.size() / 2), 4, asSrgb,
                            std::vector{t, t}, all, table_, uv);
  }
  std::vector<float> turns(const std::vector<device::DeviceTexture>& textures,
                           const std::vector<std::uint32_t>& texels, const std::vector<float>& uv) {
    const int asLinear = 0;
    return bench.map<float>("turns", static_cast<std::uint32_t>(uv.size() / 2), 4, asLinear, textures, texels,
                            table_, uv);
  }
  test::LaneBench bench;

 private:
  std::vector<float> table_;
};

Picture randomPicture(int width, int height, test::Rng& rng) {
  Picture p{width, height, {}};
  for (int i = 0; i < width * height; ++i) {
    const auto b = rng.bits();
    p.texels.push_back({static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(b >> 8),
                        static_cast<std::uint8_t>(b >> 16), static_cast<std::uint8_t>(b >> 24)});
  }
  return p;
}

TEST(Texture, WrapModesAndFiltersAgreeWithTheTwin) {
  TextureBench lookup;
  test::Rng rng(41);
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 3}, {5, 4}, {16, 1}}) {
    const Picture p = randomPicture(width, height, rng);
    for (std::uint32_t mode = 0; mode < 18; ++mode) {
      device::DeviceTexture t{{1, 0, 0, 0, 1, 0}, 7, width, height, mode % 3, mode / 3 % 3, mode / 9, 1, 1};
      const bool srgb = mode % 2;
      SCOPED_TRACE(fmt::format("{}×{} wrap {} {} nearest {}", width, height, t.wrapS, t.wrapT, t.flags));
      std::vector<float> uv;
      for (int i = 0; i < 400; ++i) {
        // Dyadic coordinates: products with the size are exact unless it is no power of two; borders and
        // centres included.
        const auto one = [&] { return static_cast<float>(static_cast<int>(rng.bits() % 257) - 128) / 32.0F; };
        const float u = one();
        uv.insert(uv.end(), {u, one()});
      }
      const auto out = lookup(t, p, srgb, uv);
      for (std::size_t i = 0; i < uv.size() / 2; ++i) {
        const double u = uv[2 * i], v = uv[2 * i + 1];
        if (t.flags && (t.wrapS == WRAP_MIRROR || t.wrapT == WRAP_MIRROR)) {
          // On the border between two texels a mirrored coordinate may take either: it is reduced before it
          // is floored.
          const double x = u * width, y = v * height;
          if (x == std::floor(x) || y == std::floor(y)) continue;
        }
        const glm::dvec4 expected = twin(p, u, v, t, srgb);
        for (int c = 0; c < 4;
             ++c)  // weights in [0,1] off by some roundings of a coordinate of at most 16 texels
          ASSERT_NEAR(static_cast<double>(out[4 * i + static_cast<std::size_t>(c)]), expected[c],
                      64 * 0x1p-24)
              << "u " << u << " v " << v << " channel " << c;
      }
    }
  }
}

TEST(Texture, OddCoordinatesReadTheFirstTexelOrTheBorderAndNothingElse) {
  TextureBench lookup;
  test::Rng rng(42);
  const Picture p = randomPicture(3, 2, rng);
  const float nan = std::nanf("");
  for (std::uint32_t mode = 0; mode < 6; ++mode) {
    device::DeviceTexture t{{1, 0, 0, 0, 1, 0}, 5, 3, 2, mode % 3, mode % 3, mode / 3, 1, 1};
    const auto out = lookup(t, p, false, {nan, 0.6F, 0.6F, nan, INFINITY, 0.6F, 0.6F, -INFINITY, nan, nan});
    for (std::size_t i = 0; i < out.size(); ++i)
      EXPECT_EQ(out[i], static_cast<float>(p.texels[0][i % 4]) / 255.0F)
          << "mode " << mode << " lookup " << i / 4;
    // Huge ones, and one just below 0 that rounds to 1 when repeated, stay inside the picture: a blend
    // of its texels.
    const auto huge =
        lookup(t, p, false, {1e30F, -1e30F, 3e38F, 0.5F, -1e-20F, -1e-20F, 16777217.0F, -16777217.0F});
    for (std::size_t i = 0; i < huge.size(); ++i) {
      float lo = 1, hi = 0;
      for (const auto& c : p.texels)
        lo = std::min(lo, static_cast<float>(c[i % 4]) / 255.0F),
        hi = std::max(hi, static_cast<float>(c[i % 4]) / 255.0F);
      EXPECT_GE(huge[i], lo * 0.999999F);
      EXPECT_LE(huge[i], hi * 1.000001F);
    }
  }
}

TEST(Texture, TransformAndUvSet) {
  TextureBench lookup;
  test::Rng rng(43);
  const Picture p = randomPicture(8, 8, rng);
  device::DeviceTexture t{{0, 2, 0.25F, -1, 0, 0.5F}, 0, 8, 8, WRAP_REPEAT, WRAP_REPEAT, 0, 1, 1};
  device::DeviceTexture plain{{1, 0, 0, 0, 1, 0}, 0, 8, 8, WRAP_REPEAT, WRAP_REPEAT, 0, 1, 1};
  const auto turned = lookup(t, p, false, {0.125F, 0.3125F}),
             direct = lookup(plain, p, false, {0.875F, 0.375F});
  EXPECT_EQ(turned, direct) << "u' = 2v + ¼, v' = ½ − u";
  plain.uvSet = 0;  // the test kernel's first set is (0.3, 0.3) everywhere
  const auto first = lookup(plain, p, false, {0.9F, 0.9F});
  plain.uvSet = 1;
  EXPECT_EQ(first, lookup(plain, p, false, {0.3F, 0.3F}));
}

/// Entries look up an image of 8 bits and one of 16 in turns, so that lanes of one vector differ.
TEST(Texture, SixteenBitsBesideEight) {
  TextureBench lookup;
  const std::vector<std::uint32_t> texels{0xff804020U, 0x01020304U,  // RGBA8, red lowest
                                          0x80018000U, 0xffff0001U,
                                          0x80038004U, 0x0000fffeU};  // two texels of 16 bits: RG, BA
  const device::DeviceTexture shallow{{1, 0, 0, 0, 1, 0}, 0, 2, 1, WRAP_CLAMP, WRAP_CLAMP, 0, 1, 1};
  device::DeviceTexture deep = shallow;
  deep.firstTexel = 2;
  deep.flags = TEXTURE_DEEP;
  // Both centres, and half way between them.
  const std::vector<float> uv{0.25F, 0.5F, 0.25F, 0.5F, 0.75F, 0.5F, 0.75F, 0.5F, 0.5F, 0.5F, 0.5F, 0.5F};
  const double first[2][4] = {{0x20, 0x40, 0x80, 0xff}, {0x8000, 0x8001, 0x0001, 0xffff}};
  const double second[2][4] = {{0x04, 0x03, 0x02, 0x01}, {0x8004, 0x8003, 0xfffe, 0}};
  const auto out = lookup.turns({shallow, deep}, texels, uv);
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t c = 0; c < 4; ++c) {
      const std::size_t which = i % 2;
      const double share = i / 2 == 0 ? 0 : i / 2 == 1 ? 1 : 0.5;
      const double expected =
          (first[which][c] * (1 - share) + second[which][c] * share) / (which ? 65535 : 255);
      EXPECT_NEAR(static_cast<double>(out[4 * i + c]), expected, 4 * 0x1p-24)
          << "entry " << i << " channel " << c;
    }
  EXPECT_EQ(out[4 + 3], 1.0F) << "opaque is opaque";
}

}  // namespace
}  // namespace whittle
