// Edits of a scene between two renders of a session: the bits of a fresh render of the edited scene, and
// nothing uploaded that the edit did not reach.
#include <functional>

#include "render/render_session.h"
#include "scene/appearance.h"
#include "support/pictures.h"

namespace whittle::test {
namespace {

Settings editSettings() {
  Settings settings = smallSettings(4);
  settings.width = 48, settings.height = 27;
  return onTestDevice(settings);
}

/// A scene that is rendered, edited and rendered again.
class EditedSession {
 public:
  explicit EditedSession(Scene s) : scene(std::move(s)) {
    session.render(scene, editSettings(), testHooks());
  }

  RenderResult edit(const char* what, const std::function<void(Appearance&)>& change) {
    Appearance appearance = appearanceOf(scene);
    change(appearance);
    setAppearance(appearance, scene);
    RenderResult kept = session.render(scene, editSettings(), testHooks());
    const RenderResult fresh = render(scene, editSettings(), testHooks());
    EXPECT_EQ(differingPixels(kept.radiance, fresh.radiance), 0U) << what;
    EXPECT_EQ(kept.stats.featuresUsed, fresh.stats.featuresUsed) << what;
    EXPECT_EQ(kept.stats.buffers.size(), fresh.stats.buffers.size()) << what;
    return kept;
  }
  const RenderWork& work() const { return session.work(); }

  Scene scene;
  RenderSession session;
};

std::size_t materialCalled(const Scene& scene, const std::string& name) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    if (scene.materials[i].name == name) return i;
  ADD_FAILURE() << name;
  return 0;
}

TEST(Edits, ALightUploadsLightsAlone) {
  EditedSession s(ownScene("cornell_box"));
  s.edit("nothing", [](Appearance&) {});
  EXPECT_FALSE(s.work().scene || s.work().tables.any());
  s.edit("intensity", [](Appearance& a) { a.lights[0].intensity *= 3.0F; });
  EXPECT_TRUE(s.work().tables.lights);
  EXPECT_FALSE(s.work().scene || s.work().tables.materials || s.work().tables.triangles || s.work().queues);
  EXPECT_EQ(s.work().programs, 0);
  s.edit("place", [](Appearance& a) { a.lights[1].position += glm::vec3(0.1F, -0.3F, 0.2F); });
  EXPECT_TRUE(s.work().tables.lights);
  s.edit("one light off", [](Appearance& a) { a.lights[1].intensity = glm::vec3(0.0F); });
  EXPECT_TRUE(s.work().tables.lights);
  EXPECT_FALSE(s.work().scene);
  const RenderResult dark =
      s.edit("all lights off", [](Appearance& a) { a.lights[0].intensity = glm::vec3(0.0F); });
  EXPECT_FALSE(uses(dark.stats, "direct light"));
  EXPECT_EQ(dark.stats.rays.shadow, 0U);
  s.edit("and on", [](Appearance& a) { a.lights[0].intensity = glm::vec3(2.0F, 1.0F, 0.5F); });
  EXPECT_FALSE(s.work().scene);
}

TEST(Edits, AConeUploadsLightsAlone) {
  EditedSession s(ownScene("spot_cone"));
  s.edit("cone",
         [](Appearance& a) { a.lights[0].outerConeAngle *= 0.5F, a.lights[0].innerConeAngle = 0.0F; });
  EXPECT_TRUE(s.work().tables.lights);
  EXPECT_FALSE(s.work().scene || s.work().tables.materials || s.work().tables.triangles);
}

TEST(Edits, AFactorUploadsMaterialsAlone) {
  EditedSession s(ownScene("cornell_box"));
  const std::size_t red = materialCalled(s.scene, "red"), silver = materialCalled(s.scene, "silver");
  s.edit("base colour", [&](Appearance& a) { a.materials[red].baseColor = {0.1F, 0.2F, 0.9F, 1.0F}; });
  EXPECT_TRUE(s.work().tables.materials);
  EXPECT_FALSE(s.work().scene || s.work().tables.lights || s.work().tables.triangles);
  EXPECT_EQ(s.work().programs, 0);
  s.edit("rough metal", [&](Appearance& a) { a.materials[silver].roughness = 0.7F; });
  EXPECT_TRUE(s.work().tables.materials);
  EXPECT_FALSE(s.work().scene);
}

TEST(Edits, WithoutTheOnlyGlassRefractionIsLeftOut) {
  EditedSession s(ownScene("cornell_box"));
  const std::size_t glass = materialCalled(s.scene, "glass");
  const RenderResult opaque =
      s.edit("no glass", [&](Appearance& a) { a.materials[glass].transmission = 0.0F; });
  EXPECT_FALSE(uses(opaque.stats, "refraction"));
  EXPECT_TRUE(s.work().tables.materials && s.work().tables.triangles) << "shadow rays ask the triangles";
  EXPECT_FALSE(s.work().scene);
  const RenderResult clear = s.edit("glass", [&](Appearance& a) { a.materials[glass].transmission = 0.8F; });
  EXPECT_TRUE(uses(clear.stats, "refraction"));
  EXPECT_TRUE(s.work().tables.triangles);
  EXPECT_FALSE(s.work().scene);
}

/// Of two alike materials the device has one, until they differ.
TEST(Edits, AlikeMaterialsPart) {
  Scene scene = ownScene("cornell_box");
  const std::size_t red = materialCalled(scene, "red"), green = materialCalled(scene, "green");
  scene.materials[green].baseColor = scene.materials[red].baseColor;
  EditedSession s(std::move(scene));
  s.edit("they part", [&](Appearance& a) { a.materials[green].baseColor = {0.1F, 0.9F, 0.1F, 1.0F}; });
  EXPECT_TRUE(s.work().tables.triangles);
  EXPECT_FALSE(s.work().scene);
  s.edit("they meet", [&](Appearance& a) { a.materials[green].baseColor = a.materials[red].baseColor; });
  EXPECT_FALSE(s.work().scene);
}

TEST(Edits, ATextureThatWasNotReadIsUploaded) {
  Scene scene = ownScene("textured");
  Image image = scene.images[0];
  for (auto& texel : image.texels) texel = static_cast<std::uint8_t>(255 - texel);
  scene.images.push_back(image);
  Material& m = scene.materials[0];
  m.emissionTexture = m.baseColorTexture;
  m.emissionTexture.image = static_cast<int>(scene.images.size()) - 1;
  EditedSession s(std::move(scene));
  s.edit("it glows", [](Appearance& a) { a.materials[0].emission = glm::vec3(2.0F); });
  EXPECT_TRUE(s.work().scene);
}

TEST(Edits, TheBackgroundUploadsNothing) {
  Scene scene = ownScene("mirror");
  scene.background.width = 4, scene.background.height = 2;
  for (int i = 0; i < 24; ++i) scene.background.map.push_back(static_cast<float>(i));
  scene.background.radiance = glm::vec3(0.1F);
  EditedSession s(std::move(scene));
  s.edit("rotation", [](Appearance& a) { a.backgroundRotation = 77.0; });
  s.edit("strength", [](Appearance& a) { a.backgroundRadiance *= 3.0F; });
  EXPECT_FALSE(s.work().scene || s.work().tables.any());
  EXPECT_EQ(s.work().programs, 0);
}

/// Images of one size with texels of their own, so that they have to be told apart.
TEST(Edits, TexelsAreReadForTheFirstPictureAlone) {
  Scene scene = ownScene("textured");
  ASSERT_FALSE(scene.images.empty());
  Image twin = scene.images[0];
  twin.texels[0] ^= 1U;
  scene.images.push_back(twin);
  for (Material& m : scene.materials)
    if (m.emissionTexture.image < 0 && m.baseColorTexture.image == 0) {
      m.emissionTexture = m.baseColorTexture;
      m.emissionTexture.image = static_cast<int>(scene.images.size()) - 1;
      m.emission = glm::vec3(0.1F);
    }
  RenderSession session;
  session.render(scene, editSettings(), testHooks());
  EXPECT_GE(session.work().texelReads, 2U) << "the twins";
  Appearance appearance = appearanceOf(scene);
  appearance.lights[0].intensity *= 2.0F;
  appearance.materials[0].roughness = 0.4F;
  setAppearance(appearance, scene);
  session.render(scene, editSettings(), testHooks());
  EXPECT_EQ(session.work().texelReads, 0U) << "after an edit";
  Camera camera = scene.cameras[0];
  camera.position += glm::vec3(0.1F);
  RenderHooks hooks = testHooks();
  hooks.camera = &camera;
  session.render(scene, editSettings(), hooks);
  EXPECT_EQ(session.work().texelReads, 0U) << "after a move";
  session.sceneChanged();
  session.render(scene, editSettings(), testHooks());
  EXPECT_GE(session.work().texelReads, 2U) << "another scene's texels";
}

}  // namespace
}  // namespace whittle::test
