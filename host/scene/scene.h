// The scene as plain data: what the loader fills, the analysis reads, the device and the reference trace.
// World space throughout: metres, right-handed, +Y up, as in glTF 2.0. Instances are baked into world-space
// triangles. It knows neither glTF nor OpenCL nor image files.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/shared/scene_tables.h"
#include "scene/sky.h"

namespace whittle {

/// An image, row 0 at the top (glTF's v = 0). `texels` holds width·height·4 bytes RGBA, not premultiplied.
/// Whether the colour channels are sRGB-encoded is decided by the slot that uses it, not by the image.
struct Image {
  std::string name;
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> texels;
  /// The same texels in 16 bits each, 65535 for 1, where the file has them finer than 8 bits tell: what slots
  /// of linear values read. Else empty.
  std::vector<std::uint16_t> deepTexels = {};

  bool isDeep() const { return !deepTexels.empty(); }
};

enum class Wrap : std::uint8_t { Repeat, Clamp, Mirror };
enum class Filter : std::uint8_t { Nearest, Linear };

/// A texture slot of a material. The coordinate used is uv' = transform · (u, v, 1) of set `uvSet`.
struct TextureSlot {
  int image = -1;  ///< index into Scene::images; -1: the slot is empty and the factor stands alone
  int uvSet = 0;   ///< 0 or 1
  Wrap wrapS = Wrap::Repeat;
  Wrap wrapT = Wrap::Repeat;
  Filter filter = Filter::Linear;
  bool hasLevels = true;  ///< where it is seen small its mean is seen; false: the nearest texels, as they are
  /// Two rows of three: u' = t[0]·u + t[1]·v + t[2], v' = t[3]·u + t[4]·v + t[5] (KHR_texture_transform).
  std::array<float, 6> transform{1, 0, 0, 0, 1, 0};

  bool used() const { return image >= 0; }
};

/// Whether a slot reads the image's 16-bit texels. Colours are decoded from 8 bits: sRGB spends those where
/// the eye does.
inline bool readsDeepTexels(const Image& image, bool isLinear) { return isLinear && image.isDeep(); }

enum class AlphaMode : std::uint8_t { Opaque, Mask, Blend };

/// glTF 2.0 metallic-roughness material with the extensions Whittle reads. All colours linear.
struct Material {
  std::string name;
  glm::vec4 baseColor{1.0F};  ///< rgb reflectance / tint, a coverage; texture is sRGB, multiplied
  TextureSlot baseColorTexture;
  float metallic = 1.0F;   ///< texture: blue channel
  float roughness = 1.0F;  ///< perceptual; microfacet alpha = roughness²; texture: green channel
  TextureSlot metallicRoughnessTexture;
  float normalScale = 1.0F;
  TextureSlot normalTexture;
  /// Read and kept, not used: not even by --ambient.
  float occlusionStrength = 1.0F;
  TextureSlot occlusionTexture;
  glm::vec3 emission{0.0F};  ///< W/(m² sr): emissiveFactor · emissiveStrength; texture is sRGB, multiplied
  TextureSlot emissionTexture;
  /// Ratio of the indices inside over outside, across this interface; 0 means "Fresnel = 1".
  float ior = 1.5F;
  float specular = 1.0F;  ///< KHR_materials_specular; texture: alpha channel
  TextureSlot specularTexture;
  glm::vec3 specularColor{1.0F};  ///< texture is sRGB
  TextureSlot specularColorTexture;
  float transmission = 0.0F;  ///< texture: red channel
  TextureSlot transmissionTexture;
  bool volume = false;  ///< KHR_materials_volume with thickness > 0: the surface bounds a solid, rays refract
  /// Absorption coefficient in 1/m, -ln(attenuationColor)/attenuationDistance; 0 where nothing is absorbed.
  /// An attenuation colour of 0 gives infinity, which is legal: e^(-inf·d) = 0, and 1 for d = 0.
  glm::vec3 sigma_a{0.0F};
  /// KHR_materials_clearcoat: how much of the surface the coat covers; texture: red channel.
  float clearcoat = 0.0F;
  TextureSlot clearcoatTexture;
  float clearcoatRoughness = 0.0F;  ///< perceptual; texture: green channel
  TextureSlot clearcoatRoughnessTexture;
  float clearcoatNormalScale = 1.0F;
  TextureSlot clearcoatNormalTexture;
  glm::vec3 sheenColor{0.0F};  ///< KHR_materials_sheen, 0: none; texture is sRGB
  TextureSlot sheenColorTexture;
  float sheenRoughness = 0.0F;  ///< perceptual; texture: alpha channel
  TextureSlot sheenRoughnessTexture;
  float iridescence = 0.0F;  ///< KHR_materials_iridescence: the share that has a film; texture: red channel
  TextureSlot iridescenceTexture;
  float iridescenceIor = 1.3F;  ///< of the film
  /// Of the film in nm, where the texture's green channel is 0, and where it is 1 or there is none.
  float leastThickness = 100.0F, mostThickness = 400.0F;
  TextureSlot iridescenceThicknessTexture;
  float anisotropy = 0.0F;          ///< KHR_materials_anisotropy: strength; texture: blue channel
  float anisotropyRotation = 0.0F;  ///< radians, counter-clockwise from the tangent
  TextureSlot anisotropyTexture;    ///< red, green: direction in [-1, 1]²
  float dispersion = 0.0F;          ///< KHR_materials_dispersion: 20 over the Abbe number; 0: none
  /// KHR_materials_diffuse_transmission: the share of Lambert's part that leaves on the other side; texture:
  /// alpha channel.
  float diffuseTransmission = 0.0F;
  TextureSlot diffuseTransmissionTexture;
  glm::vec3 diffuseTransmissionColor{1.0F};  ///< of that share; texture is sRGB
  TextureSlot diffuseTransmissionColorTexture;
  bool unlit = false;
  AlphaMode alphaMode = AlphaMode::Opaque;
  float alphaCutoff = 0.5F;
  bool doubleSided = false;
  int index = -1;  ///< in the file; -1: it is not of the file
};

/// The texture slots that rendering reads, in the order of kernels/shared/scene_tables.h.
inline constexpr std::array kTextureSlots{
#define WHITTLE_SLOT(slot, FEATURE, encoding, factor, OTHERS) &Material::slot,
    WHITTLE_TEXTURE_SLOTS(WHITTLE_SLOT)
#undef WHITTLE_SLOT
};

/// Of the same slots: whether they hold linear values (true) or sRGB-encoded colours.
inline constexpr std::array kSlotIsLinear{
#define WHITTLE_LINEAR(slot, FEATURE, encoding, factor, OTHERS) std::string_view(#encoding) == "LINEAR",
    WHITTLE_TEXTURE_SLOTS(WHITTLE_LINEAR)
#undef WHITTLE_LINEAR
};

/// Corners by index into Scene's vertex arrays, counter-clockwise seen from the front (already flipped for
/// mirrored nodes).
struct Triangle {
  std::uint32_t v0 = 0, v1 = 0, v2 = 0;
  std::uint32_t material = 0;  ///< index into Scene::materials, always valid
};

/// Point, Directional, Spot: the light types of kernels/shared/scene_tables.h.
enum class LightKind : std::uint8_t {
#define WHITTLE_KIND(Kind, NAME, word, unit, isPlaced, isAimed, hasCone) Kind,
  WHITTLE_LIGHT_TYPES(WHITTLE_KIND)
#undef WHITTLE_KIND
};

struct LightType {
  LightKind kind;
  const char* word;  ///< in glTF and in reports
  const char* unit;  ///< of its intensity
  bool isPlaced;     ///< it has a position and a range, and falls off with the squared distance
  bool isAimed;      ///< it has a direction
  bool hasCone;
};

/// In the order of LightKind.
inline constexpr std::array kLightTypes{
#define WHITTLE_TYPE(Kind, NAME, word, unit, isPlaced, isAimed, hasCone) \
  LightType{LightKind::Kind, word, unit, isPlaced, isAimed, hasCone},
    WHITTLE_LIGHT_TYPES(WHITTLE_TYPE)
#undef WHITTLE_TYPE
};

constexpr const LightType& typeOf(LightKind kind) { return kLightTypes[static_cast<std::size_t>(kind)]; }

/// Not of a file: it stands for something else in the scene that shines, and has that one's size.
constexpr bool standsForOthers(LightKind kind) {
  return kind == LightKind::Surface || kind == LightKind::Sky;
}

/// KHR_lights_punctual. `intensity` is colour · intensity: W/sr for point and spot, W/m² for directional
/// (or the photometric cd and lux: the picture then is in nits).
struct Light {
  std::string name;
  LightKind kind = LightKind::Point;
  glm::vec3 intensity{1.0F};
  glm::vec3 position{0.0F};                              ///< world
  glm::vec3 direction{0, 0, -1};                         ///< world, unit: the way the light shines
  float range = std::numeric_limits<float>::infinity();  ///< metres
  float innerConeAngle = 0.0F;                           ///< radians, half angle; full intensity inside
  float outerConeAngle = 0.785398163F;                   ///< radians, half angle; dark outside
  bool castsShadows = true;
  int node = -1;  ///< of the file, that it hangs on; -1: it is not of the file
};

/// Looks along -Z of its node, +Y up. All three axes are world-space unit vectors.
struct Camera {
  std::string name;
  bool orthographic = false;
  glm::vec3 position{0.0F};
  glm::vec3 right{1, 0, 0};
  glm::vec3 up{0, 1, 0};
  glm::vec3 forward{0, 0, -1};
  float yfov = 0.9F;    ///< perspective: full vertical field of view in radians
  float ymag = 1.0F;    ///< orthographic: half the visible height in metres
  float aspect = 0.0F;  ///< width over height of the frame that it shows in any case; 0: it has none
  float znear = 0.0F;   ///< metres along `forward`: eye rays begin there
  float zfar = std::numeric_limits<float>::infinity();  ///< and end there, where that is asked for
  std::string node = {};                                ///< that it hangs on; a name as good as its own
};

/// Radiance seen by rays that leave the scene, W/(m² sr).
struct Background {
  glm::vec3 radiance{0.0F};  ///< constant; multiplies the map where there is one
  int width = 0, height = 0;
  /// Equirectangular map, linear RGB floats, width·height·3, row 0 at the top (+Y); empty: constant only.
  /// Direction to (u, v): u = 0.5 + atan2(d.x, -d.z)/(2π) + rotation/360, v = acos(d.y)/π. Bilinear, u wraps,
  /// v clamps.
  std::vector<float> map;
  /// Degrees about +Y, counter-clockwise seen from above: at 90 what the map has at +X is seen
  /// along -Z. Finite.
  double rotation = 0.0;
  glm::vec3 unscaled{0.0F};  ///< `radiance` before a strength was applied (turnAndScale)
  bool hasSun = false;       ///< a light of the scene is its sun: it does not turn without it
};

/// One of the animations of the scene's file.
struct AnimationFacts {
  std::string name;
  double seconds = 0.0;      ///< the time of its last keyframe, as the file says
  std::size_t pointers = 0;  ///< of its channels: by JSON pointer (KHR_animation_pointer)
};

/// Per-vertex arrays are either empty (no triangle of the scene needs them) or as long as `positions`.
struct Scene {
  std::string file;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;   ///< unit; (0,0,0): this vertex has none, use the geometric normal
  std::vector<glm::vec4> tangents;  ///< xyz unit, w = ±1; kept only when a material is laid along them
  std::vector<glm::vec2> uv0;       ///< kept only when a texture uses it
  std::vector<glm::vec2> uv1;
  std::vector<glm::vec4> colors;  ///< linear RGBA, multiplies baseColor; (1,1,1,1) where a mesh has none
  std::vector<Triangle> triangles;
  std::vector<Material> materials;
  std::vector<Image> images;
  std::vector<Light> lights;
  bool hasStudioLights = false;  ///< they are ours, since the file has none
  std::vector<Camera> cameras;   ///< never empty after loading
  bool hasOurCamera = false;     ///< it was set up around the scene, or by hand
  Background background;
  std::optional<Sky> sky;  ///< that `background` and one of the lights were made of
  /// Where the scene's coordinates begin, in those of the file, metres: 0 but for scenes far from there,
  /// which single precision would shake. Whoever shows coordinates adds it.
  glm::dvec3 origin{0.0};
  std::vector<AnimationFacts> animations = {};
  /// The animation that is played moves or bends meshes, not only cameras and lights.
  bool meshesMove = false;
  std::uint64_t droppedTriangles = 0;  ///< not finite, or |coordinate| > 1.8e18, or a repeated position
};

}  // namespace whittle
