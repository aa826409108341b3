// Collects a scene and writes it as binary glTF 2.0 through tinygltf. The same calls give the same bytes.
#pragma once

#include <tiny_gltf.h>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "mesh.h"

namespace generator {

/// A texture of a material: an image added before and the coordinate set it is looked up with.
struct TextureUse {
  int image = -1;
  int uvSet = 0;
};

/// glTF's material with its extensions; only what differs from glTF's defaults is written.
struct MaterialSpec {
  std::string name;
  glm::dvec4 baseColor{0.8, 0.8, 0.8, 1};
  double metallic = 0;
  double roughness = 1;
  glm::dvec3 emission{0};  ///< W/(m² sr); above 1 it is split into factor and KHR_materials_emissive_strength
  double transmission = 0;
  double ior = 1.5;
  double specular = 1;   ///< KHR_materials_specular; 0: no gloss at any angle
  double thickness = 0;  ///< metres; above 0 the surface bounds a solid (KHR_materials_volume)
  glm::dvec3 attenuationColor{1};
  double attenuationDistance = 0;  ///< metres; 0: no absorption
  bool doubleSided = false;
  std::string alphaMode = "OPAQUE";
  TextureUse baseColorTexture;
  TextureUse normalTexture;
  TextureUse metallicRoughnessTexture;
  TextureUse emissionTexture;
};

/// Ready-made surfaces that several scenes use.
MaterialSpec matte(const std::string& name, glm::dvec3 color);
MaterialSpec mirror(const std::string& name, glm::dvec3 color);
MaterialSpec glass(const std::string& name, double ior);
/// A mirror that roughness dulls.
MaterialSpec metal(const std::string& name, glm::dvec3 color, double roughness);
/// A dielectric that reflects as Fresnel says.
MaterialSpec varnished(const std::string& name, glm::dvec3 color, double roughness);
/// Glass that lets `color` through after `distance` metres.
MaterialSpec tinted(const std::string& name, double ior, glm::dvec3 color, double distance);
/// Black but for its own light.
MaterialSpec lamp(const std::string& name, glm::dvec3 radiance);

struct LightSpec {
  std::string name;
  std::string type = "point";  ///< point, spot or directional
  glm::dvec3 color{1};
  double intensity = 1;  ///< W/sr; W/m² for a directional light
  glm::dvec3 position{0};
  glm::dvec3 target{0, -1, 0};                           ///< where spot and directional lights point
  double innerCone = 0, outerCone = 0.7853981633974483;  ///< radians, half angles
  bool castsShadows = true;
};

/// Where a camera is at a time, and what it looks at.
struct CameraView {
  double seconds = 0;
  glm::dvec3 from{0}, at{0, 0, -1};
};

/// Where a geometry goes: scaled, turned, moved.
struct Placement {
  glm::dvec3 position{0};
  double scale = 1;
  double turnY = 0;             ///< degrees about +Y
  glm::dquat turn{1, 0, 0, 0};  ///< after that
};

/// Where a part goes that is placed within something that is placed itself.
Placement within(const Placement& whole, const Placement& part);

class GltfBuilder {
 public:
  explicit GltfBuilder(const std::string& sceneName);

  int addMaterial(const MaterialSpec& spec);
  /// An embedded PNG; nearest filtering for pixel patterns, linear otherwise.
  int addImage(const std::string& name, const std::vector<std::uint8_t>& png, bool nearest);
  /// Stores the arrays once; place() may use them again and again. Takes the mesh to be able to free it on
  /// the way.
  int addGeometry(Mesh mesh);
  void place(const std::string& name, int geometry, int material, const Placement& placement = {});
  /// A glTF mesh that nodes share.
  int addMesh(const std::string& name, int geometry, int material);
  void placeMesh(int mesh, const Placement& placement);
  /// A geometry that is used once, where it is.
  void add(const std::string& name, Mesh mesh, int material, const Placement& placement = {}) {
    place(name, addGeometry(std::move(mesh)), material, placement);
  }

  void addLight(const LightSpec& spec);
  /// A perspective camera at `from` that looks at `at`, +Y up, `yfovDegrees` the full vertical angle of view.
  void addCamera(const std::string& name, glm::dvec3 from, glm::dvec3 at, double yfovDegrees);
  /// An animation of the camera that was added last: from view to view at constant speed. It stays where it
  /// was added until somebody plays that. Seconds from 0 on, growing.
  void moveCamera(const std::string& name, const std::vector<CameraView>& views);
  /// Radiance of rays that leave the scene (the scene's extras.whittle.background).
  void setBackground(glm::dvec3 radiance);

  /// Writes the .glb; throws std::runtime_error if that fails.
  void write(const std::filesystem::path& path);

 private:
  struct Geometry {
    tinygltf::Primitive primitive;  // without a material
  };

  int addView(const void* data, std::size_t bytes, int target);
  template <class T>
  int addAccessor(const std::vector<T>& values, int componentType, int type, int target);
  void useExtension(const std::string& name);
  int addNode(tinygltf::Node node);

  int camera_ = -1;  ///< node of the one that was added last
  tinygltf::Model model_;
  std::vector<Geometry> geometries_;
  tinygltf::Value::Array lights_;
};

}  // namespace generator
