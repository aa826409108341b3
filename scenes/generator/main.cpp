// make_scenes OUTDIR [--only NAME]: writes every small scene, or one, as OUTDIR/NAME.glb.
// make_scenes --heightfield N FILE: hills of N x N squares. make_scenes --NAME FILE: one of the large scenes.
#include <fmt/format.h>

#include <charconv>
#include <stdexcept>
#include <string_view>

#include "scenes.h"

namespace {

using generator::GltfBuilder;

constexpr int kMaxSquares = 4096;  // 33 million triangles; the file stays below GLB's 4 GiB

constexpr const char* kUsage =
    "usage: make_scenes OUTDIR [--only NAME] [--heightfield N FILE] [--LARGE FILE]\n"
    "  OUTDIR            writes every small scene there (- : none)\n"
    "  --only NAME       only this one\n"
    "  --heightfield N FILE   hills of N x N squares, N up to 4096\n"
    "  --frame FILE      the whole-frame benchmark, 627 200 triangles and mirror balls\n"
    "  --mixed FILE      millimetre triangles, slivers and triangles of 120 km, 202 810 in all\n"
    "  --watchmaker FILE a watchmaker's bench at dusk, the large composition\n"
    "  --breakfast FILE  a breakfast table by a window in the first sun\n"
    "  --diner FILE      a diner of chrome and neon after the rain\n"
    "  --valley FILE     eroded land with woods and meadows out of copies\n";

struct NamedScene {
  const char* name;
  void (*build)(GltfBuilder&);
};

constexpr int kDefaultSquares = 64;

constexpr NamedScene kScenes[] = {
    {"cornell_box", generator::buildCornellBox},
    {"mirror_box", generator::buildMirrorBox},
    {"spot_cone", generator::buildSpotCone},
    {"emission", generator::buildEmission},
    {"shadow", generator::buildShadow},
    {"mirror", generator::buildMirror},
    {"refraction", generator::buildRefraction},
    {"anti_aliasing", generator::buildAntiAliasing},
    {"white_furnace", generator::buildWhiteFurnace},
    {"nested_glass", generator::buildNestedGlass},
    {"textured", generator::buildTextured},
    {"height_field", [](GltfBuilder& scene) { generator::buildHeightField(scene, kDefaultSquares); }},
};

/// Too large to be kept: written when asked for, as --NAME FILE.
constexpr NamedScene kLargeScenes[] = {
    {"frame", generator::buildFrame},           {"mixed", generator::buildMixed},
    {"watchmaker", generator::buildWatchmaker}, {"breakfast", generator::buildBreakfast},
    {"diner", generator::buildDiner},           {"valley", generator::buildValley}};

/// The large scene that `option` asks for, or nullptr.
const NamedScene* largeScene(std::string_view option) {
  for (const NamedScene& scene : kLargeScenes)
    if (option.starts_with("--") && option.substr(2) == scene.name) return &scene;
  return nullptr;
}

/// A wrong command line; the usage goes with it.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

void writeScene(const NamedScene& scene, const std::filesystem::path& file) {
  GltfBuilder builder(scene.name);
  scene.build(builder);
  builder.write(file);
}

void writeScenes(const std::filesystem::path& folder, std::string_view only) {
  bool found = false;
  for (const NamedScene& scene : kScenes) {
    if (!only.empty() && only != scene.name) continue;
    found = true;
    writeScene(scene, folder / (std::string(scene.name) + ".glb"));
  }
  if (!found) throw UsageError(fmt::format("--only {}: there is no such scene", only));
}

void writeHeightField(std::string_view squares, const std::filesystem::path& file) {
  int n = 0;
  const auto [end, error] = std::from_chars(squares.data(), squares.data() + squares.size(), n);
  if (error != std::errc() || end != squares.data() + squares.size() || n < 1 || n > kMaxSquares) {
    throw UsageError(fmt::format("--heightfield {}: N must be a number from 1 to {}", squares, kMaxSquares));
  }
  GltfBuilder builder("height_field");
  generator::buildHeightField(builder, n);
  builder.write(file);
}

void run(int count, char** arguments) {
  std::string_view folder, only;
  bool wroteFile = false;
  int at = 1;
  const auto next = [&]() -> std::string_view {
    if (at >= count) throw UsageError(fmt::format("{}: a value is missing", arguments[count - 1]));
    return arguments[at++];
  };
  while (at < count) {
    const std::string_view argument = next();
    if (argument == "--only") {
      only = next();
    } else if (argument == "--heightfield") {
      const std::string_view squares = next();
      writeHeightField(squares, next());
      wroteFile = true;
    } else if (const NamedScene* const large = largeScene(argument)) {
      writeScene(*large, next());
      wroteFile = true;
    } else if (argument.starts_with("--") || !folder.empty()) {
      throw UsageError(fmt::format("{}: not understood", argument));
    } else {
      folder = argument;
    }
  }
  if (folder.empty() && !wroteFile) throw UsageError("OUTDIR is missing");
  if (!folder.empty() && folder != "-") writeScenes(folder, only);
}

}  // namespace

int main(int count, char** arguments) {
  try {
    run(count, arguments);
    return 0;
  } catch (const UsageError& error) {
    fmt::print(stderr, "make_scenes: {}\n{}", error.what(), kUsage);
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "make_scenes: {}\n", error.what());
    return 1;
  }
}
