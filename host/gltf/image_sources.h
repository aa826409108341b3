// Where the images of a file come from: the same bytes are decoded once, however many images point at them,
// and the sum of all pixels is known before the first is decoded.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <vector>

#include "gltf/document.h"
#include "image/image_header.h"

namespace whittle::gltf {

/// The image that a texture shows: of EXT_texture_webp where there is one and it can be decoded, else the
/// plain one; -1: none.
int imageOf(const Document& document, std::size_t texture);

class ImageSources {
 public:
  explicit ImageSources(Document& document);

  /// The first image with the same bytes: the same range of a buffer, or the same URI, data or not.
  std::size_t firstAlike(std::size_t image) const { return first_[image]; }
  /// The file that an image's URI means. Throws InputError, see fileOf.
  const std::filesystem::path& file(std::size_t image);
  /// Holds what the images of these materials take. Throws InputError where that is too much.
  void hold(const std::set<int>& materials);

 private:
  std::optional<ImageHeader> header(std::size_t image);

  Document& document_;
  std::vector<std::size_t> first_;
  std::map<std::size_t, std::filesystem::path> files_;  ///< known so far
};

}  // namespace whittle::gltf
