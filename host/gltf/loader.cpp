// The order of the steps from a glTF file to a Scene; each step has a file of its own.
#include "gltf/loader.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <new>
#include <set>
#include <utility>

#include "gltf/animation.h"
#include "gltf/bake.h"
#include "gltf/document.h"
#include "gltf/geometry_sums.h"
#include "gltf/instances.h"
#include "gltf/lights.h"
#include "gltf/material.h"
#include "gltf/mesh.h"
#include "gltf/nodes.h"
#include "gltf/packed_meshes.h"
#include "gltf/variants.h"
#include "scene/machine_memory.h"

namespace whittle {

namespace gltf {

/// What another pose needs of the first one.
struct Loaded {
  Movement movement;
  GeometrySums sums;
  std::vector<int> materials;  ///< see readMaterials
};

namespace {

/// The materials of everything that will be drawn; -1 is the default one.
std::set<int> usedMaterials(const Document& document, const Hierarchy& hierarchy) {
  std::set<int> used;
  for (const int node : hierarchy.shown) {
    const int mesh = document.nodes[at(node)].mesh;
    if (mesh < 0) continue;
    for (const tinygltf::Primitive& p : document.model.meshes[at(mesh)].primitives) {
      if (isDrawable(p)) used.insert(p.material);
    }
  }
  return used;
}

/// Draws the meshes of a scene's nodes into its arrays.
class MeshLoader {
 public:
  MeshLoader(Document& document, const Hierarchy& hierarchy, const GeometrySums& sums,
             std::vector<int> materials, Scene& scene, Notices& notices)
      : document_(document),
        hierarchy_(hierarchy),
        materials_(std::move(materials)),
        scene_(scene),
        notices_(notices),
        baker_(document, sums, scene) {
    for (const int node : hierarchy.shown) {
      const int mesh = document.nodes[at(node)].mesh;
      if (mesh >= 0) ++uses_[mesh];
    }
  }

  void addAll() {
    for (const int node : hierarchy_.shown) {
      if (document_.nodes[at(node)].mesh >= 0) addNode(node);
    }
    baker_.finish(notices_);
    if (notDrawn_ > 0) {
      notices_.note(
          fmt::format("{} mesh primitives not drawn: points, lines, or without positions", notDrawn_));
    }
  }

 private:
  void addNode(int node) {
    const Node& n = document_.nodes[at(node)];
    const auto& primitives = document_.model.meshes[at(n.mesh)].primitives;
    const std::string label = nodeLabel(document_, node);
    const std::vector<glm::dmat4> joints =
        n.skin >= 0 ? jointTransforms(document_, n.skin, hierarchy_.toWorld) : std::vector<glm::dmat4>();
    const std::vector<glm::dmat4> instances =
        instanceTransforms(document_, node, hierarchy_.toWorld[at(node)]);
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      if (!isDrawable(primitives[p])) {
        ++notDrawn_;
        continue;
      }
      const auto material = static_cast<std::uint32_t>(materials_[at(primitives[p].material + 1)]);
      LocalMesh storage;
      const LocalMesh& mesh = localMesh(node, static_cast<int>(p), material, storage);
      if (n.skin >= 0 && mesh.influences > 0) {
        baker_.addSkinned(mesh, joints, material, label);
        continue;
      }
      if (n.skin >= 0) notices_.warn(fmt::format("{} has a skin, but its mesh has no joints", label));
      for (const glm::dmat4& toWorld : instances) {
        const bool isLast = &mesh == &storage && &toWorld == &instances.back();
        baker_.add(mesh, toWorld, material, label, isLast ? &storage : nullptr);
      }
    }
  }

  /// A mesh that several nodes show unchanged is read once and kept; others are read into `storage`.
  const LocalMesh& localMesh(int node, int primitive, std::uint32_t material, LocalMesh& storage) {
    const Node& n = document_.nodes[at(node)];
    const auto& weights = n.weights().empty() ? document_.model.meshes[at(n.mesh)].weights : n.weights();
    const bool isShared = uses_[n.mesh] > 1 && n.weights().empty();
    const auto key = std::make_tuple(n.mesh, primitive, n.skin >= 0);
    if (isShared) {
      if (const auto found = kept_.find(key); found != kept_.end()) return found->second;
    }
    storage = readPrimitive(document_, n.mesh, primitive, scene_.materials[material], weights, n.skin >= 0,
                            notices_);
    if (!isShared) return storage;
    return kept_.emplace(key, std::move(storage)).first->second;
  }

  Document& document_;
  const Hierarchy& hierarchy_;
  std::vector<int> materials_;  ///< scene material by glTF material plus one
  Scene& scene_;
  Notices& notices_;
  Baker baker_;
  std::map<int, int> uses_;  ///< nodes that show each mesh
  std::map<std::tuple<int, int, bool>, LocalMesh> kept_;
  std::size_t notDrawn_ = 0;
};

/// extras.whittle.background of the scene, [r, g, b]. Extras may hold anything, so other
/// shapes are none of our business.
void readBackground(const Document& document, int sceneIndex, Scene& scene, Notices& notices) {
  if (sceneIndex < 0) return;
  static const Json::json_pointer kWhere("/extras/whittle/background");
  const Json& description = document.json["scenes"][at(sceneIndex)];
  if (!description.contains(kWhere)) return;
  const Json& value = description[kWhere];
  bool isColour = value.is_array() && value.size() == 3;
  for (std::size_t i = 0; isColour && i < 3; ++i) {
    isColour = value[i].is_number() && value[i].get<double>() >= 0.0 && value[i].get<double>() < 1e30;
  }
  if (!isColour) {
    notices.warn("extras.whittle.background of the scene is not three numbers of 0 or more; it is left out");
    return;
  }
  scene.background.radiance = {value[0].get<float>(), value[1].get<float>(), value[2].get<float>()};
}

/// What an animation moves, once it is as it has it; says what is shown.
Moved pose(Document& document, const LoadOptions& options, Scene& scene, Notices& notices) {
  scene.animations = document.animationFacts;
  const auto& all = scene.animations;
  if (document.isPosed) {
    if (all.empty() && !options.animation) notices.note("the file has no animation: nothing moves");
    Posed posed = poseDocument(document, options.animation, options.time.value_or(0.0));
    const double end = posed.animation < 0 ? 0.0 : all[at(posed.animation)].seconds;
    if (end > 0.0 && options.time.value_or(0.0) > end)
      notices.note(fmt::format("the animation ends at {:.4g} s: its last pose is shown", end));
    return std::move(posed.moved);
  }
  if (!all.empty())
    notices.note(fmt::format(
        "the scene is shown at rest; --time SECONDS shows {}{}, {:.4g} s long",
        all.size() == 1 ? "its animation" : fmt::format("the first of its {} animations", all.size()),
        quotedName(all[0].name), all[0].seconds));
  return {std::vector<bool>(document.nodes.size()), {}, {}, {}, {}};
}

/// extras.whittle.sky of the scene, [elevation, azimuth] or with a turbidity behind them.
void readSky(const Document& document, int sceneIndex, Scene& scene, Notices& notices) {
  if (sceneIndex < 0) return;
  static const Json::json_pointer kWhere("/extras/whittle/sky");
  const Json& description = document.json["scenes"][at(sceneIndex)];
  if (!description.contains(kWhere)) return;
  const Json& value = description[kWhere];
  bool isList = value.is_array() && (value.size() == 2 || value.size() == 3);
  for (std::size_t i = 0; isList && i < value.size(); ++i) isList = value[i].is_number();
  Sky sky;
  if (isList) {
    sky.elevation = value[0].get<double>();
    sky.azimuth = value[1].get<double>();
    if (value.size() == 3) sky.turbidity = value[2].get<double>();
  }
  if (!isList || !isInRange(sky)) {
    notices.warn(
        fmt::format("extras.whittle.sky of the scene is not [elevation, azimuth] or with a turbidity: "
                    "{} to 90 degrees, degrees, {} to {}; it is left out",
                    kLowestSun, kLeastTurbidity, kMostTurbidity));
    return;
  }
  scene.sky = sky;
}

Loaded load(Document& document, const LoadOptions& options, Scene& scene, Notices& notices) {
  Loaded loaded;
  Moved moved = pose(document, options, scene, notices);
  Hierarchy hierarchy = readHierarchy(document, options.sceneName, notices);
  applyVariant(document, options.variant);
  std::optional<Hierarchy> atAnyTime;
  if (!hierarchy.shownSometime.empty()) {
    atAnyTime = hierarchy;
    atAnyTime->shown = hierarchy.shownSometime;
  }
  const Hierarchy& all = atAnyTime ? *atAnyTime : hierarchy;  // what later poses show is read with the rest
  const std::set<int> materials = usedMaterials(document, all);
  loaded.movement = movementOf(document, all, materials, std::move(moved));
  scene.meshesMove = loaded.movement.meshes;
  unpackMeshes(document, all);
  loaded.sums = holdGeometry(document, all, options.laterTriangleBytes);
  settlePlace(document, hierarchy, notices);
  scene.origin = hierarchy.origin;
  loaded.materials = readMaterials(document, materials, scene, notices);
  {
    const LoggedWork work(document.log, "read meshes");
    MeshLoader(document, hierarchy, loaded.sums, loaded.materials, scene, notices).addAll();
  }
  readCameras(document, hierarchy, scene, notices);
  readLights(document, hierarchy, scene, notices);
  readBackground(document, hierarchy.scene, scene, notices);
  if (!options.sky)
    readSky(document, hierarchy.scene, scene, notices);
  else if (!options.sky->isNone)
    scene.sky = options.sky->sky;
  return loaded;
}

void dropMeshes(Scene& scene) {
  for (auto* array : {&scene.positions, &scene.normals}) array->clear();
  for (auto* array : {&scene.tangents, &scene.colors}) array->clear();
  for (auto* array : {&scene.uv0, &scene.uv1}) array->clear();
  scene.triangles.clear();
  scene.droppedTriangles = 0;
}

/// Those of the file, in the places of the ones it had; what others added stays behind them.
void placeLights(const Document& document, const Hierarchy& hierarchy, Scene& scene, Notices& notices) {
  const std::vector<Light> before = std::exchange(scene.lights, {});
  readLights(document, hierarchy, scene, notices);
  std::copy_if(before.begin(), before.end(), std::back_inserter(scene.lights),
               [](const Light& light) { return light.node < 0; });
}

void move(Document& document, const LoadOptions& options, const Loaded& loaded, double seconds,
          Scene& scene) {
  Notices heardBefore;
  document.notices = &heardBefore;
  MemoryBudget heldBefore({std::numeric_limits<std::uint64_t>::max() / 2, true});
  document.budget = &heldBefore;
  poseDocument(document, options.animation, seconds);
  Hierarchy hierarchy = readHierarchy(document, options.sceneName, heardBefore);
  settlePlace(document, hierarchy, heardBefore);
  scene.origin = hierarchy.origin;
  changeMaterials(document, loaded.movement.materials, scene, heardBefore);
  if (loaded.movement.meshes) {
    dropMeshes(scene);
    MeshLoader(document, hierarchy, loaded.sums, loaded.materials, scene, heardBefore).addAll();
  }
  std::vector<Camera> cameras = std::exchange(scene.cameras, {});
  if (!scene.hasOurCamera) readCameras(document, hierarchy, scene, heardBefore);
  if (scene.cameras.empty()) scene.cameras = std::move(cameras);
  placeLights(document, hierarchy, scene, heardBefore);
}

/// `work` with the document's errors as one line.
template <typename Work>
void inOneLine(const Document& document, const Work& work) {
  try {
    work();
  } catch (const Json::exception& e) {
    document.fail(e.what());  // a hole in the checks, but still one line instead of a crash
  } catch (const std::bad_alloc&) {
    document.fail("needs more memory than there is");
  } catch (const std::length_error&) {
    document.fail("needs more memory than there is");
  }
}

}  // namespace

}  // namespace gltf

struct OpenFile::State {
  gltf::Document document;
  LoadOptions options;
  gltf::Loaded loaded;
};

OpenFile::OpenFile() = default;
OpenFile::~OpenFile() = default;

Scene OpenFile::load(const std::filesystem::path& path, const LoadOptions& options, Notices& notices) {
  state_ = std::make_unique<State>();
  state_->options = options;
  Scene scene;
  scene.file = path.string();
  gltf::Document& document = state_->document;
  document.confined = options.confined;
  document.isPosed = options.time || options.animation;
  MemoryBudget own(options.memory ? MemoryLimit{} : memoryLimitOfMachine());
  document.budget = options.memory ? options.memory : &own;
  document.textureLevels = options.laterTextureLevels;
  document.log = options.log;
  gltf::inOneLine(document, [&] {
    gltf::openDocument(document, path, notices);
    state_->loaded = gltf::load(document, options, scene, notices);
    gltf::settleOutside(document);
  });
  const LoggedWork work(options.log, "set up what is missing");
  addDefaults(scene, notices, options);
  return scene;
}

void OpenFile::moveTo(double seconds, Scene& scene) {
  State& s = *state_;
  gltf::inOneLine(s.document, [&] { gltf::move(s.document, s.options, s.loaded, seconds, scene); });
}

bool OpenFile::moves() const {
  const gltf::Movement& m = state_->loaded.movement;
  return m.meshes || m.eyesOrLamps || !m.materials.empty();
}

Scene loadGltf(const std::filesystem::path& path, const LoadOptions& options, Notices& notices) {
  std::optional<OpenFile> file(std::in_place);
  Scene scene = file->load(path, options, notices);
  const LoggedWork work(options.log, "free the document");
  file.reset();
  returnFreedMemory();
  return scene;
}

}  // namespace whittle
