// Files whose animations move properties by pointer (KHR_animation_pointer), and one in which every property
// that is drawn can be moved.
#pragma once

#include "gltf/builder.h"

namespace whittle::test {

/// A channel for `pointer` whose sampler has these values at 0, 2, 4, … seconds.
inline void channel(GltfBuilder& b, const std::string& pointer, int output, std::size_t keys,
                    const char* interpolation) {
  std::vector<float> times(keys);
  for (std::size_t i = 0; i < keys; ++i) times[i] = 2 * static_cast<float>(i);
  const int input = b.floats("SCALAR", 1, times);
  b.json["accessors"][input]["max"] = {times.back()};
  if (!b.json.contains("animations"))
    b.push("animations", {{"name", "show"}, {"channels", Json::array()}, {"samplers", Json::array()}});
  Json& animation = b.json["animations"].back();
  animation["channels"].push_back(
      {{"sampler", animation["samplers"].size()},
       {"target",
        {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}}}});
  animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
}

inline void animate(GltfBuilder& b, const std::string& pointer, int components,
                    const std::vector<float>& values, const char* interpolation = "LINEAR") {
  static const char* const kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  const std::size_t elements = values.size() / static_cast<std::size_t>(components);
  channel(b, pointer, b.floats(kTypes[components - 1], components, values),
          interpolation == std::string("CUBICSPLINE") ? elements / 3 : elements, interpolation);
}

/// Shown or not, at 0, 2, 4, … seconds.
inline void showAtTimes(GltfBuilder& b, int node, const std::vector<std::uint8_t>& shown) {
  b.json["nodes"][node]["extensions"]["KHR_node_visibility"]["visible"] = shown[0] != 0;
  const int output = b.accessor(b.view(shown), "SCALAR", kUbyte, shown.size());
  channel(b, "/nodes/" + std::to_string(node) + "/extensions/KHR_node_visibility/visible", output,
          shown.size(), "STEP");
}

/// A textured triangle with a material of every extension, two cameras and a spot light.
inline GltfBuilder gallery() {
  GltfBuilder b;
  b.json["extensionsRequired"] = {"KHR_animation_pointer"};
  b.json["extensions"]["KHR_lights_punctual"]["lights"] =
      Json::array({{{"type", "spot"}, {"range", 9}, {"spot", Json::object()}}});
  const std::string png = pngBytes();
  b.push("images", {{"bufferView", b.view(std::vector<char>(png.begin(), png.end()))}});
  b.push("textures", {{"source", 0}});
  const Json texture{{"index", 0}, {"extensions", {{"KHR_texture_transform", Json::object()}}}};
  b.material({{"alphaMode", "MASK"},
              {"pbrMetallicRoughness", {{"baseColorTexture", texture}}},
              {"normalTexture", texture},
              {"occlusionTexture", texture},
              {"emissiveFactor", {1, 1, 1}},
              {"extensions",
               {{"KHR_materials_emissive_strength", Json::object()},
                {"KHR_materials_ior", Json::object()},
                {"KHR_materials_transmission", Json::object()},
                {"KHR_materials_volume", {{"attenuationDistance", 1}}},
                {"KHR_materials_specular", Json::object()},
                {"KHR_materials_clearcoat", {{"clearcoatNormalTexture", texture}}},
                {"KHR_materials_sheen", Json::object()},
                {"KHR_materials_iridescence", Json::object()},
                {"KHR_materials_anisotropy", Json::object()}}}});
  b.node({{"mesh", b.triangleMesh({{"material", 0},
                                   {"attributes",
                                    {{"TEXCOORD_0", b.vec2({0, 0, 1, 0, 0, 1})},
                                     {"NORMAL", b.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1})}}}})}});
  b.push("cameras",
         {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}, {"aspectRatio", 1}}}});
  b.push("cameras",
         {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 1}, {"zfar", 2}}}});
  b.node({{"camera", 0}});
  b.node({{"camera", 1}});
  b.node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  return b;
}

}  // namespace whittle::test
