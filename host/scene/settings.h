// Everything a user can choose about a render, once: the command line, the statistics file and the window
// show the same.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "scene/region.h"
#include "scene/sky.h"

namespace whittle {

enum class Search : std::uint8_t { Auto, Tree, Array };
enum class Sampler : std::uint8_t { Random, Stratified, Sobol };
enum class ImpulseMode : std::uint8_t { All, One };
enum class Lanes : std::uint8_t { Auto, One, Sixteen };
enum class ToneMap : std::uint8_t { Auto, None, Filmic };
enum class BackFaces : std::uint8_t { Cull, Show };
enum class TextureFilter : std::uint8_t { None, Mip, Anisotropic };

/// What a value is called on the command line and in the statistics.
template <typename T>
struct Word {
  const char* word;
  T value;
};
inline constexpr Word<Search> kSearchWords[]{
    {"auto", Search::Auto}, {"tree", Search::Tree}, {"array", Search::Array}};
inline constexpr Word<Sampler> kSamplerWords[]{
    {"random", Sampler::Random}, {"stratified", Sampler::Stratified}, {"sobol", Sampler::Sobol}};
inline constexpr Word<ImpulseMode> kImpulseWords[]{{"all", ImpulseMode::All}, {"one", ImpulseMode::One}};
inline constexpr Word<Lanes> kLanesWords[]{{"auto", Lanes::Auto}, {"1", Lanes::One}, {"16", Lanes::Sixteen}};
inline constexpr Word<ToneMap> kToneMapWords[]{
    {"auto", ToneMap::Auto}, {"none", ToneMap::None}, {"filmic", ToneMap::Filmic}};
constexpr const auto& wordsOf(ToneMap) { return kToneMapWords; }
inline constexpr Word<BackFaces> kBackFacesWords[]{{"cull", BackFaces::Cull}, {"show", BackFaces::Show}};
constexpr const auto& wordsOf(BackFaces) { return kBackFacesWords; }
inline constexpr Word<TextureFilter> kTextureFilterWords[]{
    {"none", TextureFilter::None}, {"mip", TextureFilter::Mip}, {"anisotropic", TextureFilter::Anisotropic}};
constexpr const auto& wordsOf(TextureFilter) { return kTextureFilterWords; }
constexpr const auto& wordsOf(Search) { return kSearchWords; }
constexpr const auto& wordsOf(Sampler) { return kSamplerWords; }
constexpr const auto& wordsOf(ImpulseMode) { return kImpulseWords; }
constexpr const auto& wordsOf(Lanes) { return kLanesWords; }

/// Glare of a bright light about itself, as lenses and eyes make it.
struct Bloom {
  float strength = 0.0F;  ///< share of the light that is scattered, [0, 1]; 0: none
  float radius = 0.1F;    ///< how far, as a share of the picture's height (image/bloom.h)
  bool operator==(const Bloom&) const = default;
};

struct Settings {
  int width = 640;                  ///< pixels
  int height = 360;                 ///< pixels
  std::optional<Region> crop;       ///< these pixels alone are traced; unset: all of them
  std::string camera = "0";         ///< name or index
  double backgroundRotation = 0.0;  ///< degrees about +Y, see Background; loading has put it into the scene
  float backgroundStrength = 1.0F;  ///< factor of the background's radiance; the same
  std::optional<SkyChoice> sky;     ///< unset: as the file says; loading has put it into the scene
  int bounces = 8;                  ///< backward tracing steps; 1 = direct light only
  int transparentBounces = 64;      ///< surfaces that a ray may pass straight on, besides its bounces
  /// What eye and impulse rays make of the backs of single-sided surfaces that light does not pass.
  BackFaces backFaces = BackFaces::Cull;
  bool alpha =
      false;  ///< the background is left out where the eye sees it straight on, and the rest has an alpha
  bool clipFar = false;  ///< eye rays end at the camera's zfar
  float cutoff = 0.0F;   ///< no impulse of at most this throughput in every channel is traced; 0: none is cut
  /// Radiance, W/(m² sr), that every lit surface receives from all sides, unshadowed: Whitted's ambient term.
  /// Unset: chosen for the scene (automaticAmbient) before it is rendered.
  std::optional<float> ambient = 0.0F;
  int raysPerPixel = 1;  ///< 1 = through the pixel's centre
  /// Over what part of a texture a ray takes its mean: none of it, a circle, or a strip of circles.
  TextureFilter textureFilter = TextureFilter::Anisotropic;
  bool areaLights = false;  ///< surfaces that glow light others; loading has added the light to the scene
  bool skyLight = false;    ///< the background lights surfaces; loading has added the light to the scene
  /// Where a smooth surface is made of coarse triangles, shadow rays start on the curved surface that its
  /// normals mean, so that shadows begin without facets.
  bool smoothTerminator = true;
  float lightRadius = 0.0F;  ///< metres, of every point and spot light: a sphere of the same intensity
  float sunAngle = 0.0F;     ///< degrees that every directional light fills; the sun: 0.53
  float aperture = 0.0F;     ///< metres, the diameter of the camera's thin lens; 0: a pinhole
  /// Metres along the camera's axis that it is focused on. Unset: what the middle of the picture shows,
  /// settled before it is rendered.
  std::optional<float> focusDistance;
  bool glossy = false;  ///< rough surfaces reflect and refract what is around them
  bool shadows = true;
  Search search = Search::Auto;
  Sampler sampler = Sampler::Random;
  std::uint32_t seed = 0;
  /// Rays for each work item of the searches; auto: sixteen where packets suit the device.
  Lanes lanes = Lanes::Auto;
  ImpulseMode impulses = ImpulseMode::All;
  std::string device;              ///< selector; empty: the first usable device, CPU first
  int threads = 0;                 ///< CPU devices; 0: all
  int wavefront = 1 << 18;         ///< rays in flight
  int workGroup = 0;               ///< work items; 0: chosen for the device
  std::optional<float> rayOffset;  ///< metres; unset: derived from the scene at each hit
  float mirrorRoughness = 0.2F;    ///< a surface smoother than this reflects and refracts as a mirror
  bool relaxedArithmetic = false;  ///< shading alone is compiled with -cl-fast-relaxed-math
  bool keepAllFeatures = false;
  std::uint64_t keepFeatures = 0;  ///< bits of kernels/shared/features.h that are kept, needed or not
  bool adaptive = false;           ///< more samples where the picture's error is; raysPerPixel on average
  double timeLimit = 0.0;          ///< seconds of rendering, but one ray for each pixel at least; 0: none
  double targetError = 0.0;  ///< W/(m² sr): stop once the picture's estimated RMSE is at most this; 0: never
  double targetErrorRelative =
      0.0;            ///< the same, as a share of the picture's mean radiance; goes before targetError
  bool aovs = false;  ///< keep depth, normal, albedo and primitive of each pixel's first sample
  /// The same of its rays: at which bounce its light came, and what the searches for their hits visited.
  bool bounceAov = false, costAov = false;
  bool errorAov = false;  ///< keep the standard error of each pixel
  /// Keep what a later render needs to go on from where this one ends (RenderHooks::checkpoint).
  bool resumable = false;
  std::optional<float> exposure;  ///< stops, for .png/.jpg only; unset: chosen where the picture does not fit
  ToneMap toneMap = ToneMap::Auto;  ///< for .png/.jpg only
  Bloom bloom;                      ///< for .png/.jpg only
  bool dither = false;              ///< for .png/.jpg only: codes are rounded up or down by a fine pattern
};

/// Calls visit("name", member) for every setting that the statistics carry, in their order. The option is
/// called the same with hyphens: raysPerPixel is --rays-per-pixel. Statistics are written from this list, and
/// the tests of the help and of the statistics ask for all of it.
template <typename Visit>
void eachSetting(const Settings& s, const Visit& visit) {
  visit("width", s.width);
  visit("height", s.height);
  visit("crop", s.crop);
  visit("camera", s.camera);
  visit("exposure", s.exposure);
  visit("toneMap", s.toneMap);
  visit("bloom", s.bloom);
  visit("dither", s.dither);
  visit("sky", s.sky);
  visit("backgroundRotation", s.backgroundRotation);
  visit("backgroundStrength", s.backgroundStrength);
  visit("bounces", s.bounces);
  visit("transparentBounces", s.transparentBounces);
  visit("backFaces", s.backFaces);
  visit("alpha", s.alpha);
  visit("clipFar", s.clipFar);
  visit("cutoff", s.cutoff);
  visit("ambient", s.ambient);
  visit("raysPerPixel", s.raysPerPixel);
  visit("textureFilter", s.textureFilter);
  visit("areaLights", s.areaLights);
  visit("skyLight", s.skyLight);
  visit("smoothTerminator", s.smoothTerminator);
  visit("lightRadius", s.lightRadius);
  visit("sunAngle", s.sunAngle);
  visit("aperture", s.aperture);
  visit("focusDistance", s.focusDistance);
  visit("glossy", s.glossy);
  visit("shadows", s.shadows);
  visit("search", s.search);
  visit("sampler", s.sampler);
  visit("seed", s.seed);
  visit("impulses", s.impulses);
  visit("device", s.device);
  visit("threads", s.threads);
  visit("lanes", s.lanes);
  visit("wavefront", s.wavefront);
  visit("workGroup", s.workGroup);
  visit("rayOffset", s.rayOffset);
  visit("bump", s.rayOffset);  // its name before 0.1.0
  visit("mirrorRoughness", s.mirrorRoughness);
  visit("relaxedArithmetic", s.relaxedArithmetic);
  visit("keepAllFeatures", s.keepAllFeatures);
  visit("keepFeatures", s.keepFeatures);
  visit("adaptive", s.adaptive);
  visit("targetError", s.targetError);
  visit("targetErrorRelative", s.targetErrorRelative);
  visit("timeLimit", s.timeLimit);
}

/// What is traced of the picture.
inline Region tracedRegion(const Settings& s) { return s.crop.value_or(Region{0, 0, s.width, s.height}); }

inline bool hasErrorTarget(const Settings& s) { return s.targetError > 0.0 || s.targetErrorRelative > 0.0; }

/// Above any that makes sense, and far from where single precision ends.
inline constexpr float kLargestAmbient = 1e12F;

/// Far above any throughput: everything is cut off.
inline constexpr float kLargestCutoff = 1000.0F;

}  // namespace whittle
