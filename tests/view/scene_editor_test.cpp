// Edits by hand: values in and out, ranges, undo, handles, and what a written file leaves of them.
#include "view/scene_editor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace whittle::test {
namespace {

using view::Part;
using view::SceneEditor;

/// A spot, a point light and a lamp far away; two materials. The camera sees 1 m up at 1 m ahead.
Scene editable() {
  Scene scene;
  Light spot;
  spot.name = "spot", spot.kind = LightKind::Spot, spot.intensity = {2.0F, 4.0F, 1.0F};
  spot.position = {0, 0, -2};
  Light sun;
  sun.name = "sün", sun.kind = LightKind::Directional;
  Light behind;
  behind.name = "behind", behind.position = {0, 0, 3};
  scene.lights = {spot, sun, behind};
  Material clay;
  clay.name = "clay";
  scene.materials = {clay, Material{}};
  return scene;
}

class SceneEditorTest : public testing::Test {
 protected:
  SceneEditorTest()
      : editor({[this] { ++edits; }, [this](bool, std::string text) { said.push_back(std::move(text)); },
                [](const auto&, const auto&, const auto&) { return std::string("wrote it"); },
                [this]() -> const Camera& { return camera; }, [] { return 2.0; }}) {
    camera.yfov = static_cast<float>(2 * std::atan(1.0));
    editor.take(editable(), false);
  }
  Light light(std::size_t i) const { return editor.appearance().lights[i]; }
  Material material(std::size_t i) const { return editor.appearance().materials[i]; }

  int edits = 0;
  std::vector<std::string> said;
  Camera camera;
  SceneEditor editor;
};

TEST_F(SceneEditorTest, UneditedItHasTheBitsOfTheFile) {
  Scene scene = editable();
  scene.lights.clear();
  for (const glm::vec3& intensity :
       {glm::vec3(0.1F, 0.7F, 1e-30F), glm::vec3(1e30F, 3.3F, 0.0F), glm::vec3(0.0F)}) {
    Light l;
    l.intensity = intensity, l.outerConeAngle = 0.7F, l.position = {0.1F, 1e7F, -3e-5F};
    scene.lights.push_back(l);
  }
  scene.origin = {1e6, 0.1, -5};
  editor.take(scene, false);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_FALSE(differs(light(i), scene.lights[i])) << i;
}

TEST_F(SceneEditorTest, AnIntensityKeepsTheColour) {
  EXPECT_EQ(editor.value("light.0.intensity"), "4");
  EXPECT_EQ(editor.value("light.0.color"), "0.5,1,0.25");
  EXPECT_EQ(editor.set("light.0.intensity", "8"), "");
  EXPECT_EQ(light(0).intensity, glm::vec3(4, 8, 2));
  EXPECT_EQ(editor.set("light.0.intensity", "0"), "");
  EXPECT_EQ(editor.set("light.0.intensity", "4"), "");
  EXPECT_EQ(light(0).intensity, glm::vec3(2, 4, 1));
  EXPECT_FALSE(editor.isEdited(Part::Light, 0));
  EXPECT_EQ(editor.set("light.0.on", "off"), "");
  EXPECT_EQ(light(0).intensity, glm::vec3(0));
  EXPECT_EQ(editor.value("light.0.intensity"), "4");
  EXPECT_EQ(edits, 4);
}

TEST_F(SceneEditorTest, ConesAreDegreesAndPlacesAreOfTheFile) {
  Scene scene = editable();
  scene.origin = {1000, 0, 0};
  editor.take(scene, false);
  EXPECT_EQ(editor.set("light.0.outer-cone", "60"), "");
  EXPECT_FLOAT_EQ(light(0).outerConeAngle, static_cast<float>(std::numbers::pi / 3));
  EXPECT_EQ(editor.value("light.0.position"), "1000,0,-2");
  EXPECT_EQ(editor.set("light.0.position", "1001, 2, 3"), "");
  EXPECT_EQ(light(0).position, glm::vec3(1, 2, 3));
}

TEST_F(SceneEditorTest, MaterialsHaveTheirFactors) {
  EXPECT_EQ(editor.set("material.0.base-color", "0.1,0.2,0.3"), "");
  EXPECT_EQ(editor.set("material.0.roughness", "0"), "");
  EXPECT_EQ(editor.set("material.0.metallic", "0.5"), "");
  EXPECT_EQ(editor.set("material.0.transmission", "1"), "");
  EXPECT_EQ(editor.set("material.0.ior", "1.33"), "");
  EXPECT_EQ(editor.set("material.0.emission", "10,0,2"), "");
  const Material m = material(0);
  EXPECT_EQ(m.baseColor, glm::vec4(0.1F, 0.2F, 0.3F, 1.0F));
  EXPECT_EQ(m.emission, glm::vec3(10, 0, 2));
  EXPECT_EQ(std::vector({m.roughness, m.metallic, m.transmission, m.ior}),
            (std::vector{0.0F, 0.5F, 1.0F, 1.33F}));
  editor.reset(Part::Material, 0);
  EXPECT_FALSE(differs(material(0), editable().materials[0]));
}

TEST_F(SceneEditorTest, WhatMakesNoSenseIsRefusedInTheLoadersWords) {
  const auto expect = [&](const char* id, const char* text, const std::string& problem) {
    EXPECT_EQ(editor.set(id, text), problem) << id << ' ' << text;
  };
  expect("light.0.intensity", "-1", "light 0: its intensity is negative");
  expect("light.0.intensity", "3.9e38",
         "light 0: its intensity is beyond 3.4e38, the most that a float holds");
  expect("light.0.intensity", "1e400", "light.0.intensity: '1e400' is no number");
  expect("light.0.position", "1e31,0,0", "light 0: a transform that cannot be used");
  expect("light.0.color", "1,2,-1", "light 0: its intensity is negative");
  expect("light.0.inner-cone", "50", "light 0: cone angles outside 0 ≤ inner ≤ outer ≤ 90°");
  expect("light.0.outer-cone", "91", "light 0: cone angles outside 0 ≤ inner ≤ outer ≤ 90°");
  expect("light.0.position", "1,2", "light.0.position: '1,2' is not three numbers");
  expect("light.0.on", "yes", "light.0.on: 'yes' is not one of on|off");
  expect("light.0.intensity", "much", "light.0.intensity: 'much' is no number");
  expect("light.0.intensity", "nan", "light.0.intensity: 'nan' is no number");
  expect("light.3.intensity", "1", "'light.3.intensity' is no setting of the window");
  expect("light.x.intensity", "1", "'light.x.intensity' is no setting of the window");
  expect("light.0.size", "1", "'light.0.size' is no setting of the window");
  expect("material.0.roughness", "1.5", "material 0: a factor is outside its range");
  expect("material.0.base-color", "0,0,2", "material 0: a factor is outside its range");
  expect("material.0.emission", "-1,0,0", "material 0: a factor is outside its range");
  expect("material.0.emission", "1e39,0,0", "material 0: a factor is outside its range");
  expect("material.0.ior", "-1", "material 0: ior must not be negative");
  EXPECT_EQ(edits, 0);
  EXPECT_FALSE(editor.hasUndo());
}

TEST_F(SceneEditorTest, UndoGoesBackStepByStepAndADragIsOne) {
  editor.set("light.0.intensity", "8");
  editor.setDragging(true);
  for (const char* roughness : {"0.9", "0.5", "0.1"}) editor.set("material.1.roughness", roughness);
  editor.setDragging(false);
  editor.set("material.1.roughness", "0");
  editor.undo();
  EXPECT_EQ(editor.value("material.1.roughness"), "0.1");
  editor.undo();
  EXPECT_EQ(editor.value("material.1.roughness"), "1");
  EXPECT_EQ(editor.chosen(Part::Material), 1U);
  editor.undo();
  EXPECT_EQ(editor.value("light.0.intensity"), "4");
  EXPECT_FALSE(editor.hasUndo());
  editor.undo();
}

TEST_F(SceneEditorTest, ControlsFitTheKindOfLight) {
  const auto ids = [&](std::size_t i) {
    std::vector<std::string> fields;
    for (const auto& c : editor.controls(Part::Light, i)) fields.push_back(c.id.substr(c.id.rfind('.') + 1));
    return fields;
  };
  EXPECT_EQ(ids(0), (std::vector<std::string>{"on", "intensity", "color", "azimuth", "elevation",
                                              "inner-cone", "outer-cone", "position"}));
  EXPECT_EQ(ids(1), (std::vector<std::string>{"on", "intensity", "color", "azimuth", "elevation"}));
  EXPECT_EQ(ids(2), (std::vector<std::string>{"on", "intensity", "color", "position"}));
  EXPECT_EQ(editor.controls(Part::Light, 0)[1].label, "intensity, cd");
  EXPECT_EQ(editor.controls(Part::Light, 1)[1].label, "intensity, lx");
  EXPECT_EQ(editor.title(Part::Light, 1), "1 sün");
  EXPECT_EQ(editor.title(Part::Material, 1), "1");
  EXPECT_TRUE(editor.controls(Part::Light, 9).empty());
}

TEST_F(SceneEditorTest, ADirectionIsTwoAngles) {
  const auto expectDirection = [&](const glm::vec3& wanted) {
    EXPECT_LT(glm::length(light(0).direction - wanted), 1e-7F) << "a float's rounding";
  };
  EXPECT_EQ(editor.value("light.0.azimuth"), "180") << "along -Z";
  EXPECT_EQ(editor.value("light.0.elevation"), "0");
  EXPECT_EQ(editor.set("light.0.azimuth", "90"), "");
  expectDirection({1, 0, 0});
  EXPECT_EQ(editor.set("light.0.elevation", "30"), "");
  expectDirection({std::sqrt(0.75F), 0.5F, 0});
  EXPECT_EQ(editor.set("light.0.elevation", "-90"), "");
  EXPECT_EQ(light(0).direction, glm::vec3(0, -1, 0)) << "straight down, exactly";
  EXPECT_EQ(editor.set("light.0.elevation", "0"), "");
  expectDirection({1, 0, 0});
  EXPECT_EQ(editor.value("light.0.azimuth"), "90") << "straight down, it was not forgotten";
  EXPECT_EQ(editor.set("light.0.azimuth", "180"), "");
  EXPECT_EQ(light(0).direction, editable().lights[0].direction);
  EXPECT_FALSE(editor.isEdited(Part::Light, 0));
  EXPECT_EQ(editor.set("light.0.elevation", "91"), "light 0: an elevation outside -90° to 90°");
}

TEST_F(SceneEditorTest, AlphaIsOfWhatBlendsOrIsCutOut) {
  const auto hasAlpha = [&](std::size_t i) {
    const auto all = editor.controls(Part::Material, i);
    return std::any_of(all.begin(), all.end(), [](const auto& c) { return c.id.ends_with(".alpha"); });
  };
  Scene scene = editable();
  scene.materials[1].alphaMode = AlphaMode::Blend;
  scene.materials[1].baseColor = {0.5F, 0.25F, 1, 0.75F};
  editor.take(scene, false);
  EXPECT_FALSE(hasAlpha(0)) << "opaque: it would change nothing";
  EXPECT_TRUE(hasAlpha(1));
  EXPECT_EQ(editor.value("material.1.alpha"), "0.75");
  EXPECT_EQ(editor.set("material.1.alpha", "0.5"), "");
  EXPECT_EQ(material(1).baseColor, glm::vec4(0.5F, 0.25F, 1, 0.5F));
  EXPECT_EQ(editor.set("material.1.base-color", "1,1,1"), "");
  EXPECT_EQ(material(1).baseColor.a, 0.5F);
  EXPECT_EQ(editor.set("material.1.alpha", "1.5"), "material 1: a factor is outside its range");
}

/// At 2 m the picture is 4 m high and 8 m wide.
TEST_F(SceneEditorTest, AHandleMovesItsLightParallelToThePicture) {
  const auto handles = editor.handles();
  ASSERT_EQ(handles.size(), 1U) << "of the one that has a place before the camera";
  EXPECT_EQ(handles[0].light, 0U);
  EXPECT_NEAR(handles[0].x, 0.5, 1e-6);
  editor.moveLight(0, 0.25, -0.125);
  EXPECT_NEAR(light(0).position.x, 1, 1e-6);
  EXPECT_NEAR(light(0).position.y, -0.5, 1e-6);
  EXPECT_EQ(light(0).position.z, -2);
  EXPECT_NEAR(editor.handles()[0].x, 0.5 + 1.0 / 8, 1e-6);
  EXPECT_NEAR(editor.handles()[0].y, 0.5 + 0.5 / 4, 1e-6);
  camera.orthographic = true, camera.ymag = 3;
  editor.moveLight(2, 0, 0.5);  // behind the camera, it sees 6 m from there too
  EXPECT_NEAR(light(2).position.y, 3, 1e-6);
}

TEST_F(SceneEditorTest, AWrittenFileKeepsWhatFits) {
  editor.set("light.0.intensity", "8");
  editor.set("light.2.intensity", "8");
  editor.set("material.0.roughness", "0.5");
  Scene scene = editable();
  scene.lights[2].name = "another";
  scene.lights[0].outerConeAngle = 0.5F;
  scene.materials[0].metallic = 0.25F;
  editor.take(scene, true);
  EXPECT_EQ(editor.value("light.0.intensity"), "8");
  EXPECT_EQ(light(0).outerConeAngle, 0.5F) << "the file's";
  EXPECT_EQ(editor.value("light.2.intensity"), "1");
  EXPECT_EQ(material(0).roughness, 0.5F);
  EXPECT_EQ(material(0).metallic, 0.25F) << "the file's";
  ASSERT_EQ(said.size(), 2U);
  EXPECT_NE(said[0].find("edits of 1"), std::string::npos) << said[0];
  EXPECT_NE(said[1].find("edits of 2"), std::string::npos) << said[1];
  scene.lights.clear(), scene.materials.clear();
  editor.take(scene, true);
  EXPECT_EQ(editor.count(Part::Light), 0U);
  editor.take(editable(), false);
  EXPECT_FALSE(editor.isEdited(Part::Light, 0));
}

}  // namespace
}  // namespace whittle::test
