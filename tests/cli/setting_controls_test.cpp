// The window's settings: every one goes there and back through its option, and devices are named.
#include "cli/setting_controls.h"

#include <gtest/gtest.h>

#include "scene/input_error.h"

namespace whittle::test {
namespace {

DeviceList twoOfThree() {
  DeviceList list;
  for (int i = 0; i < 3; ++i) {
    DeviceInfo d;
    d.index = i, d.name = "same name", d.platform = "platform", d.usable = i != 1;
    list.devices.push_back(d);
  }
  return list;
}

TEST(SettingControls, DefaultsAreTakenBack) {
  const Settings standard;
  Settings settings;
  for (const auto& c : cli::settingControls(standard, twoOfThree())) {
    EXPECT_EQ(cli::settingText(standard, c.id), c.standard) << c.id;
    cli::setSetting(settings, c.id, c.standard);
    EXPECT_EQ(cli::settingText(settings, c.id), c.standard) << c.id;
    EXPECT_NE(c.tip.find("--" + c.id), std::string::npos) << c.id;
  }
}

TEST(SettingControls, WordsAreTaken) {
  Settings settings;
  for (const auto& c : cli::settingControls({}, twoOfThree()))
    for (const auto& word : c.words) {
      cli::setSetting(settings, c.id, word);
      EXPECT_EQ(cli::settingText(settings, c.id), word) << c.id;
    }
}

TEST(SettingControls, DevicesAreChosenByNumberSinceNamesMayBeAlike) {
  const auto controls = cli::settingControls({}, twoOfThree());
  const auto device =
      std::find_if(controls.begin(), controls.end(), [](const auto& c) { return c.id == "device"; });
  ASSERT_NE(device, controls.end());
  EXPECT_EQ(device->words, (std::vector<std::string>{"", "0", "2"})) << "1 cannot be used";
  EXPECT_EQ(device->captions[2], "2  same name, platform");
}

/// Rough surfaces that reflect by themselves need no mirrors in their place: 0.03 instead of 0.2.
TEST(SettingControls, GlossyDecidesWhatCountsAsAMirrorUnlessAHandDid) {
  Settings settings;
  cli::setSetting(settings, "glossy", "on");
  EXPECT_EQ(cli::settingText(settings, "mirror-roughness"), "0.03");
  EXPECT_EQ(cli::standardText({}, settings, "mirror-roughness"), "0.03");
  EXPECT_EQ(cli::optionsText(settings), "--glossy") << "render settles the other itself";
  cli::setSetting(settings, "mirror-roughness", "0.2");
  EXPECT_EQ(cli::optionsText(settings), "--glossy --mirror-roughness 0.2");
  cli::setSetting(settings, "glossy", "off");
  EXPECT_EQ(cli::settingText(settings, "mirror-roughness"), "0.2");
  cli::setSetting(settings, "mirror-roughness", "0.1");
  cli::setSetting(settings, "glossy", "on");
  EXPECT_EQ(cli::settingText(settings, "mirror-roughness"), "0.1");
}

TEST(SettingControls, WhatIsRefusedChangesNothing) {
  Settings settings;
  settings.bounces = 5;
  EXPECT_THROW(cli::setSetting(settings, "bounces", "0"), std::exception);
  EXPECT_THROW(cli::setSetting(settings, "colour", "1"), InputError);
  EXPECT_EQ(settings.bounces, 5);
}

}  // namespace
}  // namespace whittle::test
