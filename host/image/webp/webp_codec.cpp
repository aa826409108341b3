// WebP (RFC 9649), on libwebp: still pictures, colours as they are stored beside their alpha.
#include <webp/decode.h>

#include "image/webp.h"

namespace whittle {
namespace {

class Codec final : public WebpCodec {
 public:
  std::string decode(std::span<const std::byte> bytes, Image& image) const override {
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(data, bytes.size(), &features) != VP8_STATUS_OK) return "its WebP header is damaged";
    if (features.has_animation != 0) return "is an animated WebP, which Whittle does not read";
    if (features.width < 1 || features.height < 1 || features.width > kMaxTextureSide ||
        features.height > kMaxTextureSide)
      return "its WebP header has a size that is not possible";
    image.width = features.width;
    image.height = features.height;
    image.texels.resize(std::size_t{4} * static_cast<std::size_t>(image.width) *
                        static_cast<std::size_t>(image.height));
    const bool isWhole = WebPDecodeRGBAInto(data, bytes.size(), image.texels.data(), image.texels.size(),
                                            4 * image.width) != nullptr;
    return isWhole ? "" : "its WebP data are damaged";
  }
};

}  // namespace
}  // namespace whittle

const whittle::WebpCodec* whittleWebpCodec() {
  static const whittle::Codec codec;
  return &codec;
}
