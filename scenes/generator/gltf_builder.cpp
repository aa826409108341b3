// Turns the builder's calls into tinygltf's model: one buffer, one view for each array, lights
// and materials with the KHR extensions (KHR_lights_punctual, _materials_ior, _transmission,
// _volume, _specular, _emissive_strength).
#include "gltf_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "glb_file.h"

namespace generator {
namespace {

using tinygltf::Value;
using Object = Value::Object;

template <class V>
Value vectorValue(const V& v) {
  Value::Array array;
  for (int i = 0; i < v.length(); ++i) array.emplace_back(static_cast<double>(v[i]));
  return Value(std::move(array));
}

template <class V>
std::vector<double> vectorOf(const V& v) {
  std::vector<double> out;
  out.reserve(v.length());
  for (int i = 0; i < v.length(); ++i) out.push_back(static_cast<double>(v[i]));
  return out;
}

std::vector<double> identityUnless(const std::vector<double>& v, const std::vector<double>& identity) {
  return v == identity ? std::vector<double>{} : v;
}

/// The turn that takes -Z to `direction` and keeps +Y as far up as it can.
std::vector<double> lookRotation(glm::dvec3 direction) {
  const glm::dvec3 back = -glm::normalize(direction);
  const glm::dvec3 helper = std::abs(back.y) > 0.999 ? glm::dvec3(0, 0, back.y) : glm::dvec3(0, 1, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(helper, back));
  const glm::dquat q = glm::normalize(glm::quat_cast(glm::dmat3(right, glm::cross(back, right), back)));
  return {q.x, q.y, q.z, q.w};
}

glm::dquat rotationOf(const Placement& placement) {
  const double half = glm::radians(placement.turnY) / 2;
  return placement.turn * glm::dquat(std::cos(half), 0, std::sin(half), 0);
}

}  // namespace

Placement within(const Placement& whole, const Placement& part) {
  const glm::dquat turn = rotationOf(whole);
  return {.position = whole.position + whole.scale * (turn * part.position),
          .scale = whole.scale * part.scale,
          .turn = glm::normalize(turn * rotationOf(part))};
}

MaterialSpec matte(const std::string& name, glm::dvec3 color) {
  MaterialSpec spec;
  spec.name = name;
  spec.baseColor = glm::dvec4(color, 1);
  spec.specular = 0;  // a reflectance and nothing else
  return spec;
}

MaterialSpec mirror(const std::string& name, glm::dvec3 color) {
  MaterialSpec spec;
  spec.name = name;
  spec.baseColor = glm::dvec4(color, 1);
  spec.metallic = 1;
  spec.roughness = 0;
  return spec;
}

MaterialSpec glass(const std::string& name, double ior) {
  MaterialSpec spec;
  spec.name = name;
  spec.baseColor = glm::dvec4(1);
  spec.roughness = 0;
  spec.transmission = 1;
  spec.ior = ior;
  spec.thickness = 1;
  return spec;
}

MaterialSpec metal(const std::string& name, glm::dvec3 color, double roughness) {
  MaterialSpec spec = mirror(name, color);
  spec.roughness = roughness;
  return spec;
}

MaterialSpec varnished(const std::string& name, glm::dvec3 color, double roughness) {
  MaterialSpec spec = matte(name, color);
  spec.specular = 1;
  spec.roughness = roughness;
  return spec;
}

MaterialSpec tinted(const std::string& name, double ior, glm::dvec3 color, double distance) {
  MaterialSpec spec = glass(name, ior);
  spec.attenuationColor = color;
  spec.attenuationDistance = distance;
  return spec;
}

MaterialSpec lamp(const std::string& name, glm::dvec3 radiance) {
  MaterialSpec spec = matte(name, glm::dvec3(0));
  spec.emission = radiance;
  return spec;
}

GltfBuilder::GltfBuilder(const std::string& sceneName) {
  model_.asset.version = "2.0";
  model_.asset.generator = "Whittle make_scenes";
  model_.scenes.emplace_back();
  model_.scenes[0].name = sceneName;
  model_.defaultScene = 0;
  model_.buffers.emplace_back();
}

int GltfBuilder::addMaterial(const MaterialSpec& spec) {
  tinygltf::Material m;
  m.name = spec.name;
  m.doubleSided = spec.doubleSided;
  m.alphaMode = spec.alphaMode;
  m.pbrMetallicRoughness.baseColorFactor = vectorOf(spec.baseColor);
  m.pbrMetallicRoughness.metallicFactor = spec.metallic;
  m.pbrMetallicRoughness.roughnessFactor = spec.roughness;
  m.pbrMetallicRoughness.baseColorTexture.index = spec.baseColorTexture.image;
  m.pbrMetallicRoughness.baseColorTexture.texCoord = spec.baseColorTexture.uvSet;
  m.normalTexture.index = spec.normalTexture.image;
  m.normalTexture.texCoord = spec.normalTexture.uvSet;
  m.pbrMetallicRoughness.metallicRoughnessTexture.index = spec.metallicRoughnessTexture.image;
  m.pbrMetallicRoughness.metallicRoughnessTexture.texCoord = spec.metallicRoughnessTexture.uvSet;
  m.emissiveTexture.index = spec.emissionTexture.image;
  m.emissiveTexture.texCoord = spec.emissionTexture.uvSet;
  const auto extend = [&](const std::string& name, Object values) {
    useExtension(name);
    m.extensions[name] = Value(std::move(values));
  };
  const double strength = std::max({1.0, spec.emission.x, spec.emission.y, spec.emission.z});
  m.emissiveFactor = vectorOf(spec.emission / strength);
  if (strength > 1) extend("KHR_materials_emissive_strength", {{"emissiveStrength", Value(strength)}});
  if (spec.ior != 1.5) extend("KHR_materials_ior", {{"ior", Value(spec.ior)}});
  if (spec.specular != 1) extend("KHR_materials_specular", {{"specularFactor", Value(spec.specular)}});
  if (spec.transmission > 0) {
    extend("KHR_materials_transmission", {{"transmissionFactor", Value(spec.transmission)}});
  }
  if (spec.thickness > 0) {
    Object volume{{"thicknessFactor", Value(spec.thickness)}};
    if (spec.attenuationDistance > 0) {
      volume["attenuationDistance"] = Value(spec.attenuationDistance);
      volume["attenuationColor"] = vectorValue(spec.attenuationColor);
    }
    extend("KHR_materials_volume", std::move(volume));
  }
  model_.materials.push_back(std::move(m));
  return static_cast<int>(model_.materials.size()) - 1;
}

int GltfBuilder::addView(const void* data, std::size_t bytes, int target) {
  std::vector<unsigned char>& buffer = model_.buffers[0].data;
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = buffer.size();
  view.byteLength = bytes;
  view.target = target;
  const auto* first = static_cast<const unsigned char*>(data);
  buffer.insert(buffer.end(), first, first + bytes);
  buffer.resize((buffer.size() + 3) / 4 * 4);  // accessors start at multiples of their component's size
  model_.bufferViews.push_back(std::move(view));
  return static_cast<int>(model_.bufferViews.size()) - 1;
}

template <class T>
int GltfBuilder::addAccessor(const std::vector<T>& values, int componentType, int type, int target) {
  tinygltf::Accessor accessor;
  accessor.bufferView = addView(values.data(), values.size() * sizeof(T), target);
  accessor.componentType = componentType;
  accessor.type = type;
  accessor.count = values.size();
  if constexpr (std::is_same_v<T, glm::vec3>) {
    glm::vec3 low(std::numeric_limits<float>::infinity()), high = -low;
    for (const glm::vec3& v : values) {
      low = glm::min(low, v);
      high = glm::max(high, v);
    }
    accessor.minValues = vectorOf(low);
    accessor.maxValues = vectorOf(high);
  }
  model_.accessors.push_back(std::move(accessor));
  return static_cast<int>(model_.accessors.size()) - 1;
}

int GltfBuilder::addGeometry(Mesh mesh) {
  constexpr int kVertices = TINYGLTF_TARGET_ARRAY_BUFFER, kIndices = TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER;
  constexpr int kFloat = TINYGLTF_COMPONENT_TYPE_FLOAT;
  model_.buffers[0].data.reserve(model_.buffers[0].data.size() + mesh.positions.size() * 24 +
                                 mesh.indices.size() * 4);
  tinygltf::Primitive p;
  p.mode = TINYGLTF_MODE_TRIANGLES;
  // Frees each array once it is in the buffer: a large height field is held once, not twice.
  const auto attribute = [&](const std::string& name, auto& values, int type) {
    if (values.empty()) return;
    p.attributes[name] = addAccessor(values, kFloat, type, kVertices);
    std::remove_reference_t<decltype(values)>().swap(values);
  };
  const std::size_t vertices = mesh.positions.size();
  const bool unitSphere = mesh.normals == mesh.positions;
  attribute("POSITION", mesh.positions, TINYGLTF_TYPE_VEC3);
  if (unitSphere) {
    p.attributes["NORMAL"] = p.attributes["POSITION"];
  } else {
    attribute("NORMAL", mesh.normals, TINYGLTF_TYPE_VEC3);
  }
  attribute("TANGENT", mesh.tangents, TINYGLTF_TYPE_VEC4);
  attribute("TEXCOORD_0", mesh.uv0, TINYGLTF_TYPE_VEC2);
  attribute("TEXCOORD_1", mesh.uv1, TINYGLTF_TYPE_VEC2);
  attribute("COLOR_0", mesh.colors, TINYGLTF_TYPE_VEC4);
  if (vertices <= 65535) {
    const std::vector<std::uint16_t> narrow(mesh.indices.begin(), mesh.indices.end());
    p.indices = addAccessor(narrow, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_SCALAR, kIndices);
  } else {
    p.indices =
        addAccessor(mesh.indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, kIndices);
  }
  geometries_.push_back({std::move(p)});
  return static_cast<int>(geometries_.size()) - 1;
}

int GltfBuilder::addNode(tinygltf::Node node) {
  model_.nodes.push_back(std::move(node));
  const int index = static_cast<int>(model_.nodes.size()) - 1;
  model_.scenes[0].nodes.push_back(index);
  return index;
}

void GltfBuilder::place(const std::string& name, int geometry, int material, const Placement& placement) {
  placeMesh(addMesh(name, geometry, material), placement);
}

int GltfBuilder::addMesh(const std::string& name, int geometry, int material) {
  tinygltf::Mesh mesh;
  mesh.name = name;
  mesh.primitives.push_back(geometries_[static_cast<std::size_t>(geometry)].primitive);
  mesh.primitives[0].material = material;
  model_.meshes.push_back(std::move(mesh));
  return static_cast<int>(model_.meshes.size()) - 1;
}

void GltfBuilder::placeMesh(int mesh, const Placement& placement) {
  tinygltf::Node node;
  node.name = model_.meshes[static_cast<std::size_t>(mesh)].name;
  node.mesh = mesh;
  const glm::dquat turn = rotationOf(placement);
  node.translation = identityUnless(vectorOf(placement.position), {0, 0, 0});
  node.rotation = identityUnless({turn.x, turn.y, turn.z, turn.w}, {0, 0, 0, 1});
  node.scale = identityUnless(vectorOf(glm::dvec3(placement.scale)), {1, 1, 1});
  addNode(std::move(node));
}

int GltfBuilder::addImage(const std::string& name, const std::vector<std::uint8_t>& png, bool nearest) {
  tinygltf::Image image;
  image.name = name;
  image.mimeType = "image/png";
  image.bufferView = addView(png.data(), png.size(), 0);
  model_.images.push_back(std::move(image));
  tinygltf::Sampler sampler;
  sampler.magFilter = nearest ? TINYGLTF_TEXTURE_FILTER_NEAREST : TINYGLTF_TEXTURE_FILTER_LINEAR;
  sampler.minFilter = sampler.magFilter;
  model_.samplers.push_back(std::move(sampler));
  tinygltf::Texture texture;
  texture.source = static_cast<int>(model_.images.size()) - 1;
  texture.sampler = static_cast<int>(model_.samplers.size()) - 1;
  model_.textures.push_back(std::move(texture));
  return static_cast<int>(model_.textures.size()) - 1;
}

void GltfBuilder::addLight(const LightSpec& spec) {
  useExtension("KHR_lights_punctual");
  Object light{{"name", Value(spec.name)},
               {"type", Value(spec.type)},
               {"color", vectorValue(spec.color)},
               {"intensity", Value(spec.intensity)}};
  if (spec.type == "spot") {
    light["spot"] =
        Value(Object{{"innerConeAngle", Value(spec.innerCone)}, {"outerConeAngle", Value(spec.outerCone)}});
  }
  if (!spec.castsShadows) light["extras"] = Value(Object{{"castsShadows", Value(false)}});
  lights_.emplace_back(std::move(light));
  tinygltf::Node node;
  node.name = spec.name;
  node.translation = vectorOf(spec.position);
  if (spec.type != "point") node.rotation = lookRotation(spec.target - spec.position);
  node.extensions["KHR_lights_punctual"] =
      Value(Object{{"light", Value(static_cast<int>(lights_.size()) - 1)}});
  addNode(std::move(node));
}

void GltfBuilder::addCamera(const std::string& name, glm::dvec3 from, glm::dvec3 at, double yfovDegrees) {
  tinygltf::Camera camera;
  camera.name = name;
  camera.type = "perspective";
  camera.perspective.yfov = glm::radians(yfovDegrees);
  camera.perspective.aspectRatio = 16.0 / 9.0;
  camera.perspective.znear = 0.01;
  model_.cameras.push_back(std::move(camera));
  tinygltf::Node node;
  node.name = name;
  node.camera = static_cast<int>(model_.cameras.size()) - 1;
  node.translation = vectorOf(from);
  node.rotation = lookRotation(at - from);
  camera_ = addNode(std::move(node));
}

void GltfBuilder::moveCamera(const std::string& name, const std::vector<CameraView>& views) {
  std::vector<float> times;
  std::vector<glm::vec3> places;
  std::vector<glm::vec4> turns;
  for (const CameraView& view : views) {
    times.push_back(static_cast<float>(view.seconds));
    places.emplace_back(view.from);
    const std::vector<double> q = lookRotation(view.at - view.from);
    turns.emplace_back(q[0], q[1], q[2], q[3]);
  }
  constexpr int kFloat = TINYGLTF_COMPONENT_TYPE_FLOAT, kNoTarget = 0;
  const int input = addAccessor(times, kFloat, TINYGLTF_TYPE_SCALAR, kNoTarget);
  model_.accessors[static_cast<std::size_t>(input)].minValues = {static_cast<double>(times.front())};
  model_.accessors[static_cast<std::size_t>(input)].maxValues = {static_cast<double>(times.back())};
  tinygltf::Animation animation;
  animation.name = name;
  const auto add = [&](const char* path, int output) {
    tinygltf::AnimationSampler sampler;
    sampler.input = input;
    sampler.output = output;
    tinygltf::AnimationChannel channel;
    channel.sampler = static_cast<int>(animation.samplers.size());
    channel.target_node = camera_;
    channel.target_path = path;
    animation.samplers.push_back(std::move(sampler));
    animation.channels.push_back(std::move(channel));
  };
  add("translation", addAccessor(places, kFloat, TINYGLTF_TYPE_VEC3, kNoTarget));
  add("rotation", addAccessor(turns, kFloat, TINYGLTF_TYPE_VEC4, kNoTarget));
  model_.animations.push_back(std::move(animation));
}

void GltfBuilder::setBackground(glm::dvec3 radiance) {
  model_.scenes[0].extras = Value(Object{{"whittle", Value(Object{{"background", vectorValue(radiance)}})}});
}

void GltfBuilder::useExtension(const std::string& name) {
  auto& used = model_.extensionsUsed;
  if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
}

void GltfBuilder::write(const std::filesystem::path& path) {
  if (!lights_.empty()) model_.extensions["KHR_lights_punctual"] = Value(Object{{"lights", Value(lights_)}});
  writeGlb(model_, path);
}

}  // namespace generator
