// What every reader of this library shares: opening files and memory blocks with OpenImageIO, limits, and
// errors in one line.
#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/input_error.h"

namespace whittle {

/// Larger pictures are taken for corrupt headers, as larger textures are (image/image_header.h).
inline constexpr int kMaxFloatSide = 65536;
inline constexpr std::int64_t kMaxImagePixels = std::int64_t{1} << 30;

/// What OpenImageIO says, on one line; some of its messages carry several.
std::string oneLine(std::string text);

[[noreturn]] void refuseToDecode(const std::string& name, const std::string& why);

/// Throws InputError unless it is a flat picture of a size that can be held.
void checkSize(const OIIO::ImageSpec& spec, int maxSide, const std::string& name);
void checkSize(int width, int height, int maxSide, const std::string& name);

/// Throws InputError where the file cannot be opened or no reader takes it.
std::unique_ptr<OIIO::ImageInput> openFile(const std::filesystem::path& path);
std::vector<std::byte> readBytes(const std::filesystem::path& path);

bool startsWith(std::span<const std::byte> bytes, std::size_t at, std::string_view magic);
inline constexpr std::string_view kPngMagic = "\x89PNG\r\n\x1a\n";

/// A picture in memory that is open. `bytes` must outlive it.
class MemoryInput {
 public:
  /// `format`: OpenImageIO's reader. Throws InputError naming `name`.
  MemoryInput(std::span<const std::byte> bytes, const char* format, const std::string& name);
  OIIO::ImageInput& input() { return *input_; }

 private:
  OIIO::Filesystem::IOMemReader memory_;  // outlives the reader
  std::unique_ptr<OIIO::ImageInput> input_;
};

/// Turns whatever OpenImageIO and the allocator throw into the one exception for unusable input.
template <class F>
auto guarded(const std::string& name, F&& read) {
  try {
    return read();
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    refuseToDecode(name, oneLine(error.what()));
  }
}

}  // namespace whittle
