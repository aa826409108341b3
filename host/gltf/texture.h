// Texture slots: images decoded once each, samplers, KHR_texture_transform.
#pragma once

#include <vector>

#include "gltf/document.h"
#include "gltf/image_sources.h"
#include "scene/scene.h"

namespace whittle::gltf {

/// Fills Scene::images with what slots ask for. An image that cannot be used costs a
/// warning and leaves its slots empty.
class TextureReader {
 public:
  TextureReader(Document& document, ImageSources& sources, Scene& scene, Notices& notices);

  /// The slot that the textureInfo under `key` of `owner` describes; an empty slot where there is none.
  TextureSlot slot(const Json& owner, const char* key);
  /// To be called once all materials are there: frees the 16-bit texels that only slots of
  /// colours would read.
  void dropUnreadTexels();

 private:
  int imageAt(std::size_t texture);
  int decode(std::size_t asked);
  Image read(std::size_t image);

  static constexpr int kUnread = -2;
  Document& document_;
  ImageSources& sources_;
  Scene& scene_;
  Notices& notices_;
  std::vector<int> images_;  ///< by first alike glTF image: index into Scene::images, -1: unusable, kUnread
  std::vector<bool> sourceless_;  ///< by glTF texture: already warned about
};

}  // namespace whittle::gltf
