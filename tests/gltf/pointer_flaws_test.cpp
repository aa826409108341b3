// KHR_animation_pointer: pointers that lead nowhere cost a warning, accessors of another type the file.
#include <gtest/gtest.h>

#include "gltf/pointers.h"

namespace whittle {
namespace {

using test::animate;
using test::at;
using test::channel;
using test::gallery;
using test::GltfBuilder;
using test::Json;
using test::mentions;
using test::showAtTimes;

TEST(GltfPointerFlaws, WhatIsNotThereIsSaidOnceByName) {
  const auto warned = [](const std::vector<std::string>& pointers) {
    GltfBuilder b = gallery();
    for (const std::string& pointer : pointers) animate(b, pointer, 1, {0, 1});
    b.load(at(1));
    EXPECT_EQ(b.notices.warnings.size(), 1U);
    return b.notices.warnings.empty() ? "" : b.notices.warnings[0];
  };
  EXPECT_EQ(
      warned({"/materials/0/extensions/KHR_materials_fur/length"}),
      "animations[0] \"show\" does not move /materials/0/extensions/KHR_materials_fur/length (unknown)");
  for (const char* absent :
       {"/materials/9/alphaCutoff", "/materials/00/alphaCutoff", "/materials/-1/alphaCutoff",
        "/nodes/99/translation", "/meshes/1/weights", "/meshes/0/weights/0", "/cameras/0/orthographic/xmag",
        "/cameras/0/perspective/zfar",
        "/materials/0/emissiveTexture/extensions/KHR_texture_transform/rotation",
        "/extensions/KHR_lights_punctual/lights/1/intensity"})
    EXPECT_EQ(warned({absent}),
              std::string("animations[0] \"show\" does not move ") + absent + " (not in the file)");
  for (const char* unknown :
       {"", "/", "//", "nodes/0/scale", "/nodes/0", "/nodes/0/", "/nodes/0/matrix", "/nodes/0/translation/0",
        "/materials/0/name", "/materials/0/doubleSided", "/materials/0/emissiveFactor/0",
        "/materials/0/normalTexture/index", "/materials/0/normalTexture/texCoord", "/meshes/0/primitives/0",
        "/nodes/0/extensions/KHR_node_visibility", "/scenes/0/nodes", "/~1/~0"}) {
    GltfBuilder b = gallery();
    animate(b, unknown, 1, {0, 1});
    b.load(at(1));
    const std::string name = std::string(unknown).empty() ? "nothing" : unknown;
    EXPECT_TRUE(mentions(b.notices.warnings, name + " (unknown)")) << unknown;
  }
  EXPECT_EQ(warned({"/a", "/b", "/c", "/d", "/e"}),
            "animations[0] \"show\" does not move /a (unknown), /b (unknown), /c (unknown) and 2 more");
  EXPECT_LT(warned({"/" + std::string(5000, 'x')}).size(), 200U);
}

TEST(GltfPointerFlaws, WrongAccessorsAreRefused) {
  const auto refused = [](const std::string& pointer, const char* type, int components, const char* words,
                          const char* interpolation = "LINEAR") {
    GltfBuilder b = gallery();
    const std::vector<float> values(static_cast<std::size_t>(2 * components), 0.5F);
    channel(b, pointer, b.floats(type, components, values), 2, interpolation);
    const std::string line = b.error(at(1));
    EXPECT_NE(line.find(words), std::string::npos) << line;
    EXPECT_NE(line.find(pointer), std::string::npos) << line;
    EXPECT_NO_THROW(b.load()) << "at rest nobody reads it";
  };
  refused("/materials/0/alphaCutoff", "VEC3", 3, "takes SCALAR values, but its accessor has others");
  refused("/materials/0/emissiveFactor", "SCALAR", 1, "takes VEC3 values");
  refused("/materials/0/pbrMetallicRoughness/baseColorFactor", "MAT2", 4, "takes VEC4 values");
  refused("/meshes/0/weights", "VEC2", 2, "takes SCALAR values");
  refused("/nodes/0/extensions/KHR_node_visibility/visible", "SCALAR", 1, "takes unsigned bytes", "STEP");
  GltfBuilder b = gallery();
  showAtTimes(b, 0, {1, 0});
  b.json["animations"][0]["samplers"][0]["interpolation"] = "LINEAR";
  EXPECT_NE(b.error(at(1)).find("its interpolation must be STEP"), std::string::npos);
  GltfBuilder nameless = gallery();
  animate(nameless, "/x", 1, {0, 1});
  Json& e = nameless.json["animations"][0]["channels"][0]["target"]["extensions"];
  e["KHR_animation_pointer"] = Json::object();
  EXPECT_NE(nameless.error(at(1)).find("pointer is missing"), std::string::npos);
  e.clear();
  nameless.load(at(1));
  EXPECT_TRUE(mentions(nameless.notices.warnings, "does not move a pointer to nothing"));
}

}  // namespace
}  // namespace whittle
