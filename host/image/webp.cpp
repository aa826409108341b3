#include "image/webp.h"

#include <fmt/format.h>

#include <cstring>

#include "scene/input_error.h"
#include "scene/own_library.h"

namespace whittle {
namespace {

struct WebpLibrary {
  const WebpCodec* codec = nullptr;
  std::string problem = "Whittle was built without libwebp-dev";

  WebpLibrary() {
    using Entry = decltype(&whittleWebpCodec);
    if (const auto entry =
            reinterpret_cast<Entry>(loadOwnLibrary("libwhittle_webp.so", "whittleWebpCodec", problem)))
      codec = entry();
  }
};

const WebpLibrary& webpLibrary() {
  static const WebpLibrary library;
  return library;
}

}  // namespace

bool isWebp(std::span<const std::byte> bytes) {
  return bytes.size() >= kWebpStart && std::memcmp(bytes.data(), "RIFF", 4) == 0 &&
         std::memcmp(bytes.data() + 8, "WEBP", 4) == 0;
}

bool canDecodeWebp() { return webpLibrary().codec != nullptr; }

Image decodeWebp(std::span<const std::byte> bytes, const std::string& name) {
  if (!canDecodeWebp())
    throw InputError(fmt::format("{}: is WebP, which cannot be decoded: {}", name, webpLibrary().problem));
  Image image{name, 0, 0, {}};
  if (const std::string problem = webpLibrary().codec->decode(bytes, image); !problem.empty())
    throw InputError(fmt::format("{}: {}", name, problem));
  return image;
}

}  // namespace whittle
