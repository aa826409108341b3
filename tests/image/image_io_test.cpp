// Image files: what is written is read back, what is broken is refused with one line, nothing is
// left half written.
#include "image/image_io.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <OpenImageIO/imageio.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <limits>

#include "image/temporary_folder.h"
#include "scene/input_error.h"
#include "scene/whole_file.h"

namespace whittle {
namespace {

std::vector<std::byte> readAll(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

/// Writes any picture straight through OpenImageIO: the files that other programs would give us.
void writeWith(const std::filesystem::path& path, OIIO::ImageSpec spec, OIIO::TypeDesc type,
               const void* pixels) {
  auto out = OIIO::ImageOutput::create(path.string());
  ASSERT_TRUE(out && out->open(path.string(), spec)) << OIIO::geterror();
  ASSERT_TRUE(out->write_image(type, pixels) && out->close());
}

template <class F>
std::string inputErrorOf(F&& f) {
  try {
    f();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

FloatImage testPattern(int width, int height, int channels) {
  FloatImage image{width, height, channels, {}};
  for (int i = 0; i < width * height * channels; ++i)
    image.pixels.push_back(std::ldexp(1.0F + 0.01F * static_cast<float>(i), i % 60 - 30));
  return image;
}

using Bytes = std::vector<std::uint8_t>;

TEST(DecodeImage, keepsColoursUnderTransparentAlpha) {
  const TemporaryFolder folder;
  const Bytes rgba{200, 100, 50, 0, 200, 100, 50, 1, 200, 100, 50, 128, 200, 100, 50, 255};
  OIIO::ImageSpec spec(2, 2, 4, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  writeWith(folder / "a.png", spec, OIIO::TypeDesc::UINT8, rgba.data());
  const Image image = decodeImage(readAll(folder / "a.png"), "a.png");
  EXPECT_EQ(image.width, 2);
  EXPECT_EQ(image.height, 2);
  EXPECT_EQ(image.name, "a.png");
  EXPECT_EQ(image.texels, rgba);
}

TEST(DecodeImage, expandsGreyAndGreyAlpha) {
  const TemporaryFolder folder;
  const Bytes grey{7, 250};
  writeWith(folder / "g.png", OIIO::ImageSpec(2, 1, 1, OIIO::TypeDesc::UINT8), OIIO::TypeDesc::UINT8,
            grey.data());
  EXPECT_EQ(decodeImage(readAll(folder / "g.png"), "g").texels, (Bytes{7, 7, 7, 255, 250, 250, 250, 255}));
  const Bytes greyAlpha{7, 9, 250, 0};
  OIIO::ImageSpec spec(2, 1, 2, OIIO::TypeDesc::UINT8);
  spec.alpha_channel = 1;
  spec.attribute("oiio:UnassociatedAlpha", 1);
  writeWith(folder / "ga.png", spec, OIIO::TypeDesc::UINT8, greyAlpha.data());
  EXPECT_EQ(decodeImage(readAll(folder / "ga.png"), "ga").texels, (Bytes{7, 7, 7, 9, 250, 250, 250, 0}));
}

TEST(DecodeImage, rounds16BitsTo8) {
  const TemporaryFolder folder;
  // 257·v is exactly v of 255; 128 more is just past the middle between two codes.
  const std::vector<std::uint16_t> wide{0, 257 * 100, 65535, 257 * 10, 257 * 10 + 127, 257 * 10 + 130};
  writeWith(folder / "w.png", OIIO::ImageSpec(2, 1, 3, OIIO::TypeDesc::UINT16), OIIO::TypeDesc::UINT16,
            wide.data());
  EXPECT_EQ(decodeImage(readAll(folder / "w.png"), "w").texels, (Bytes{0, 100, 255, 255, 10, 10, 11, 255}));
}

TEST(DecodeImage, readsPalettePng) {
  // Two pixels, one bit each, palette {(10, 20, 30), (200, 150, 100)}, tRNS {255, 64}; zlib block stored.
  // Checksums by zlib's crc32.
  const Bytes png{0x89, 'P',  'N',  'G',  13,   10,   26,   10,   0,    0,    0,    13,   'I',  'H',  'D',
                  'R',  0,    0,    0,    2,    0,    0,    0,    1,    1,    3,    0,    0,    0,    0xce,
                  0xec, 0xed, 0xc9, 0,    0,    0,    6,    'P',  'L',  'T',  'E',  10,   20,   30,   200,
                  150,  100,  0xd3, 0x22, 0xc4, 0x62, 0,    0,    0,    2,    't',  'R',  'N',  'S',  255,
                  64,   0x93, 0x6b, 0x71, 0xda, 0,    0,    0,    13,   'I',  'D',  'A',  'T',  0x78, 1,
                  1,    2,    0,    0xfd, 0xff, 0,    0x40, 0x00, 0x42, 0x00, 0x41, 0x20, 0xb0, 0x99, 0xcb,
                  0,    0,    0,    0,    'I',  'E',  'N',  'D',  0xae, 0x42, 0x60, 0x82};
  const Image image = decodeImage(std::as_bytes(std::span(png)), "palette");
  EXPECT_EQ(image.texels, (Bytes{10, 20, 30, 255, 200, 150, 100, 64}));
}

TEST(DecodeImage, readsJpegAndIgnoresOrientation) {
  const TemporaryFolder folder;
  Bytes rgb(32 * 16 * 3, 40);
  for (int i = 0; i < 32 * 8 * 3; ++i) rgb[i] = 200;  // the upper half
  OIIO::ImageSpec spec(32, 16, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("Orientation", 3);  // "turn me upside down": glTF says to ignore it
  spec.attribute("Compression", "jpeg:100");
  writeWith(folder / "o.jpg", spec, OIIO::TypeDesc::UINT8, rgb.data());
  const Image image = decodeImage(readAll(folder / "o.jpg"), "o.jpg");
  ASSERT_EQ(image.width, 32);
  // 8x8 blocks are constant here, so JPEG at quality 100 is within a code or two of colour conversion.
  EXPECT_NEAR(image.texels[0], 200, 2);
  EXPECT_NEAR(image.texels[15 * 32 * 4], 40, 2);
  EXPECT_EQ(image.texels[3], 255);
}

TEST(DecodeImage, refusesWhatIsBrokenInOneLineWithTheName) {
  const TemporaryFolder folder;
  Bytes rgb;  // busy enough that most of the file is texels
  for (std::uint32_t i = 0; i < 64 * 64 * 3; ++i)
    rgb.push_back(static_cast<std::uint8_t>(i * i * 2654435761U >> 24U));
  for (const char* name : {"x.png", "x.jpg"}) {
    writeCodes(folder / name, {64, 64, 3, rgb}, {});
    const std::vector<std::byte> whole = readAll(folder / name);
    for (const std::size_t size : {std::size_t{0}, std::size_t{3}, std::size_t{20}, whole.size() / 2}) {
      const std::string error = inputErrorOf([&] { decodeImage(std::span(whole).first(size), "wood"); });
      EXPECT_NE(error.find("wood"), std::string::npos) << error;
      EXPECT_EQ(error.find('\n'), std::string::npos) << error;
      EXPECT_NE(error, "no InputError") << name << " cut to " << size;
    }
  }
  std::vector<std::byte> png = readAll(folder / "x.png");
  png[png.size() / 2] ^= std::byte{0x10};
  EXPECT_NE(inputErrorOf([&] { decodeImage(png, "wood"); }).find("IDAT chunk is damaged"), std::string::npos);
  const std::string cut = inputErrorOf([&] { decodeImage(std::span(png).first(png.size() / 2), "wood"); });
  EXPECT_NE(cut.find("cut off at byte"), std::string::npos) << cut;
  EXPECT_NE(inputErrorOf([&] { readImage(folder / "missing.png"); }).find("missing.png"), std::string::npos);
}

TEST(DecodeImage, refusesGiantHeaders) {
  // A picture of 16385 x 1 white bits is a good PNG of a few bytes; one column too many is enough
  // to be refused.
  const TemporaryFolder folder;
  const Bytes row(16385, 255);
  writeWith(folder / "wide.png", OIIO::ImageSpec(16385, 1, 1, OIIO::TypeDesc::UINT8), OIIO::TypeDesc::UINT8,
            row.data());
  const std::string error = inputErrorOf([&] { readImage(folder / "wide.png"); });
  EXPECT_NE(error.find("16385x1"), std::string::npos) << error;
  writeWith(folder / "ok.png", OIIO::ImageSpec(16384, 1, 1, OIIO::TypeDesc::UINT8), OIIO::TypeDesc::UINT8,
            row.data());
  EXPECT_EQ(readImage(folder / "ok.png").width, 16384);
}

TEST(WriteExr, roundTripsEveryBitAndTheMetadata) {
  const TemporaryFolder folder;
  FloatImage image = testPattern(5, 3, 3);
  image.pixels[4] = std::numeric_limits<float>::infinity();
  image.pixels[7] = std::numeric_limits<float>::quiet_NaN();
  image.pixels[8] = -0.0F;
  image.pixels[9] = std::numeric_limits<float>::denorm_min();
  writeExr(folder / "a.exr", image, {{"whittle:seed", "7"}});
  const FloatImage back = readFloatImage(folder / "a.exr");
  ASSERT_EQ(back.pixels.size(), image.pixels.size());
  EXPECT_EQ(std::memcmp(back.pixels.data(), image.pixels.data(), image.pixels.size() * sizeof(float)), 0);
  const auto input = OIIO::ImageInput::open((folder / "a.exr").string());
  EXPECT_EQ(input->spec().get_string_attribute("whittle:seed"), "7");
  EXPECT_EQ(folder.fileCount(), 1);
}

TEST(WriteExr, namesChannelsAndGivesTheSameBytesAgain) {
  const TemporaryFolder folder;
  const FloatImage depth = testPattern(4, 4, 1);
  writeExr(folder / "d.exr", depth, {}, {"depth"});
  const auto input = OIIO::ImageInput::open((folder / "d.exr").string());
  EXPECT_EQ(input->spec().channelnames, std::vector<std::string>{"depth"});
  EXPECT_EQ(input->spec().get_string_attribute("DateTime"), "");  // a date would make every file differ
  const std::vector<std::byte> first = readAll(folder / "d.exr");
  writeExr(folder / "d.exr", depth, {}, {"depth"});
  EXPECT_EQ(readAll(folder / "d.exr"), first);
}

TEST(WriteRgb8, pngRoundTripsAndIsReadAsLinear) {
  const TemporaryFolder folder;
  const Bytes rgb{0, 10, 11, 128, 188, 255};
  writeCodes(folder / "a.png", {2, 1, 3, rgb}, {{"whittle:camera", "front"}});
  EXPECT_EQ(readImage(folder / "a.png").texels, (Bytes{0, 10, 11, 255, 128, 188, 255, 255}));
  const auto input = OIIO::ImageInput::open((folder / "a.png").string());
  EXPECT_EQ(input->spec().get_string_attribute("whittle:camera"), "front");
  // IEC 61966-2-1 by hand: 10/255 is below 0.04045 (v/12.92), the others above.
  const FloatImage linear = readFloatImage(folder / "a.png");
  EXPECT_EQ(linear.pixels[0], 0.0F);
  EXPECT_NEAR(linear.pixels[1], 10 / 255.0 / 12.92, 1e-8);
  EXPECT_NEAR(linear.pixels[2], std::pow((11 / 255.0 + 0.055) / 1.055, 2.4), 1e-8);
  EXPECT_NEAR(linear.pixels[3], 0.21586, 1e-5);
  EXPECT_EQ(linear.pixels[5], 1.0F);
}

TEST(WriteRgb8, refusesBadExtensionsFoldersAndSizes) {
  const TemporaryFolder folder;
  const Bytes rgb(3, 0);
  EXPECT_NE(inputErrorOf([&] {
              writeCodes(folder / "a.exr", {1, 1, 3, rgb}, {});
            }).find(".png"),
            std::string::npos);
  EXPECT_NE(inputErrorOf([&] {
              writeCodes(folder / "no/a.png", {1, 1, 3, rgb}, {});
            }).find("does not exist"),
            std::string::npos);
  EXPECT_NE(inputErrorOf([&] { writeExr(folder / "a.png", testPattern(1, 1, 3), {}); }).find(".exr"),
            std::string::npos);
  EXPECT_THROW(writeCodes(folder / "a.png", {2, 1, 3, rgb}, {}), std::runtime_error);
  EXPECT_EQ(folder.fileCount(), 0);
}

TEST(CheckWritable, acceptsOursAndRefusesTheRest) {
  const TemporaryFolder folder;
  for (const char* name : {"a.exr", "a.PNG", "a.jpg", "a.jpeg"})
    EXPECT_NO_THROW(checkWritable(folder / name)) << name;
  EXPECT_THROW(checkWritable(folder / "a.gif"), InputError);
  EXPECT_THROW(checkWritable(folder / "a"), InputError);
  EXPECT_THROW(checkWritable(folder / "no/a.png"), InputError);
  std::filesystem::create_directory(folder / "b.png");
  EXPECT_THROW(checkWritable(folder / "b.png"), InputError);
  EXPECT_EQ(folder.fileCount(), 1);  // nothing was created to find out
}

/// Lets this process write files of at most `bytes`: the nearest thing to a full disk that a test can have.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit small{bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
    oldHandler_ = std::signal(SIGXFSZ, SIG_IGN);  // write() then fails with EFBIG
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, oldHandler_);
  }

 private:
  rlimit old_{};
  void (*oldHandler_)(int) = nullptr;
};

TEST(WholeFile, failingWriteLeavesTheOldFileAndNothingElse) {
  const TemporaryFolder folder;
  FloatImage image = testPattern(64, 64, 3);
  writeExr(folder / "a.exr", testPattern(2, 2, 3), {});
  const std::vector<std::byte> before = readAll(folder / "a.exr");
  {
    const FileSizeLimit limit(4096);
    EXPECT_THROW(writeExr(folder / "a.exr", image, {}), std::runtime_error);
    EXPECT_THROW(writeExr(folder / "b.exr", image, {}), std::runtime_error);
    EXPECT_EQ(inputErrorOf([&] { EXPECT_THROW(writeExr(folder / "b.exr", image, {}), std::runtime_error); }),
              "no InputError");
  }
  EXPECT_EQ(readAll(folder / "a.exr"), before);
  EXPECT_EQ(folder.fileCount(), 1);
}

TEST(WholeFile, replacesFollowsLinksAndHonoursTheUmask) {
  const TemporaryFolder folder;
  const std::string text = "whole";
  std::ofstream(folder / "old") << "something longer that was there before";
  std::filesystem::create_symlink("old", folder / "link");
  const mode_t oldMask = ::umask(0027);
  writeWholeFile(folder / "link", std::as_bytes(std::span(text)));
  ::umask(oldMask);
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(std::filesystem::file_size(folder / "old"), text.size());
  EXPECT_EQ(std::filesystem::status(folder / "old").permissions(), std::filesystem::perms(0640));
  EXPECT_EQ(folder.fileCount(), 2);
}

TEST(WholeFile, whatKilledWritersLeftIsSweptOnceItIsOld) {
  const TemporaryFolder folder;
  const auto hours = [](int n) {
    return std::filesystem::file_time_type::clock::now() - std::chrono::hours(n);
  };
  for (const auto& [name, age] : {std::pair{".whittle-1-0.part", 2},
                                  {".whittle-2-0.part", 0},
                                  {"mine.part", 2},
                                  {".whittle-3-0.exr", 2}}) {
    std::ofstream(folder / name) << "a part";
    std::filesystem::last_write_time(folder / name, hours(age));
  }
  tryFolder(folder / "a.exr");
  EXPECT_FALSE(std::filesystem::exists(folder / ".whittle-1-0.part"));
  EXPECT_TRUE(std::filesystem::exists(folder / ".whittle-2-0.part"))
      << "perhaps another process writes it now";
  EXPECT_EQ(folder.fileCount(), 3) << "nothing of others, and nothing new";
}

}  // namespace
}  // namespace whittle
