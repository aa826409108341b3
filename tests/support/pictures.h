// What the render tests share: scenes from disk, small settings, bits of pictures.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <string>

#include "gltf/loader.h"
#include "programs/kernel_programs.h"
#include "render/renderer.h"
#include "support/test_device.h"
#include "support/text.h"

namespace whittle::test {

/// Small enough for the reference, 16:9 like the scenes' composition.
inline Settings smallSettings(int bounces = 8) {
  Settings settings;
  settings.width = 96;
  settings.height = 54;
  settings.bounces = bounces;
  return settings;
}

/// The same with every feature compiled in, for tests of what no feature changes: one compile serves all
/// scenes and tests, and on a cold cache compiling is what takes their time. That leaving features out
/// changes no bit is tested by itself (analysis/features_test.cpp, render/shared_scenes_test.cpp).
inline Settings wholeSettings(int bounces = 8) {
  Settings settings = smallSettings(bounces);
  settings.keepAllFeatures = true;
  return settings;
}

/// With the kernels that the environment selects, see support/test_device.h.
inline RenderHooks testHooks() {
  RenderHooks hooks;
  hooks.kernelFolder = testKernelFolder();
  return hooks;
}

/// On the device that it selects.
inline Settings onTestDevice(Settings settings) {
  if (const char* selector = std::getenv("WHITTLE_TEST_DEVICE")) settings.device = selector;
  return settings;
}

/// Renders on the device and with the kernels that the environment selects, see support/test_device.h. All
/// renders of a process share the device and what was compiled on it, unless the settings name one or
/// launches are not timed.
inline RenderResult renderOnDevice(const Scene& scene, Settings settings, RenderHooks hooks = {}) {
  if (!hooks.kernelFolder) hooks.kernelFolder = testKernelFolder();
  if (settings.device.empty() && hooks.timeStages) {
    static OpenDevice shared{openTestDevice()};
    hooks.device = &shared;
  } else if (const char* selector = std::getenv("WHITTLE_TEST_DEVICE")) {
    settings.device = selector;
  }
  return render(scene, settings, hooks);
}

inline Scene loadScene(const std::filesystem::path& file) {
  Notices notices;
  return loadGltf(file, {}, notices);
}

/// A scene of the project, by name without extension.
inline Scene ownScene(const std::string& name) {
  return loadScene(std::filesystem::path(WHITTLE_SCENES) / (name + ".glb"));
}

/// Names of all the project's scenes.
inline std::vector<std::string> ownScenes() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(WHITTLE_SCENES)) {
    if (entry.path().extension() == ".glb") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// Pixels whose bits differ.
inline std::size_t differingPixels(const FloatImage& a, const FloatImage& b) {
  if (a.width != b.width || a.height != b.height || a.channels != b.channels) return std::size_t(-1);
  std::size_t count = 0;
  const auto channels = static_cast<std::size_t>(a.channels);
  for (std::size_t i = 0; i < a.pixels.size(); i += channels) {
    count += std::memcmp(&a.pixels[i], &b.pixels[i], channels * sizeof(float)) != 0;
  }
  return count;
}

/// Whether a feature with these words in its text was needed.
inline bool uses(const Stats& stats, const std::string& words) {
  return std::any_of(stats.featuresUsed.begin(), stats.featuresUsed.end(),
                     [&](const std::string& text) { return contains(text, words); });
}

/// Launches and items of a stage; zeros if it never ran.
inline StageStats stageOf(const Stats& stats, const std::string& name) {
  for (const auto& stage : stats.stages) {
    if (stage.facts.name == name) return stage;
  }
  return {};
}

}  // namespace whittle::test
