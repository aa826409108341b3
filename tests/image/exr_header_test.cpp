// Headers by hand: they never reach a library.
#include "image/exr_header.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "scene/input_error.h"

namespace whittle {
namespace {

std::string integer(std::uint32_t value) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> 8 * i & 0xff);
  return bytes;
}

std::string zeroEnded(const std::string& text) { return text + std::string(1, '\0'); }

std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
  return zeroEnded(name) + zeroEnded(type) + integer(static_cast<std::uint32_t>(value.size())) + value;
}

/// A part whose channels R, G, … have these types.
std::string part(const std::vector<std::uint32_t>& types) {
  std::string list;
  for (std::size_t i = 0; i < types.size(); ++i)
    list += zeroEnded(std::string(1, static_cast<char>('A' + i))) + integer(types[i]) + integer(0) +
            integer(1) + integer(1);
  return attribute("name", "string", "a part") + attribute("channels", "chlist", zeroEnded(list)) +
         attribute("compression", "compression", "x") + zeroEnded("");
}

std::string file(bool several, const std::string& parts) {
  return integer(20000630) + integer(several ? 0x1002 : 2) + parts;
}

std::string headerErrorOf(const std::string& bytes) {
  try {
    checkSampleTypes(std::as_bytes(std::span(bytes)), "a.exr");
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(ExrHeader, TypesThatAreDefinedPass) {
  EXPECT_EQ(headerErrorOf(file(false, part({0, 1, 2}))), "");
  EXPECT_EQ(headerErrorOf(file(true, part({1}) + part({2, 2}) + zeroEnded(""))), "");
}

TEST(ExrHeader, OthersAreRefusedInAnyChannelOfAnyPart) {
  const std::string says = "a.exr: channel B has samples of type 3, which OpenEXR does not define";
  EXPECT_EQ(headerErrorOf(file(false, part({1, 3}))), says);
  EXPECT_EQ(headerErrorOf(file(true, part({1}) + part({2, 3}) + zeroEnded(""))), says);
}

TEST(ExrHeader, WhatLiesBehindTheHeadersIsNotLookedAt) {
  EXPECT_EQ(headerErrorOf(file(false, part({1}) + part({7}))), "") << "one part: the second is data";
  EXPECT_EQ(headerErrorOf(file(true, part({1}) + zeroEnded("") + part({7}))), "");
  EXPECT_EQ(headerErrorOf("no picture" + part({7})), "");
}

TEST(ExrHeader, AnyCutIsLeftToTheCodec) {
  const std::string whole = file(true, part({1, 2}) + part({0}) + zeroEnded(""));
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_EQ(headerErrorOf(whole.substr(0, size)), "") << size;
}

}  // namespace
}  // namespace whittle
