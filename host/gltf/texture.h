// Texture slots: images decoded once each, samplers, KHR_texture_transform.
#pragma once

#include <functional>
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

  /// The slot that the textureInfo under `key` of `owner` describes; an empty slot where there is none. Its
  /// image is a number of this reader until decodeAll is called.
  TextureSlot slot(const Json& owner, const char* key);
  /// To be called once all materials are in the scene: decodes what their slots ask for, side by side, and
  /// empties the slots of images that cannot be used. 16-bit texels that only slots of colours would read are
  /// freed.
  void decodeAll();

 private:
  int imageAt(std::size_t texture);
  int numberOf(std::size_t asked);
  std::function<Image()> decoderOf(std::size_t image);
  void dropUnreadTexels();

  Document& document_;
  ImageSources& sources_;
  Scene& scene_;
  Notices& notices_;
  std::vector<std::size_t> asked_;  ///< glTF images that slots ask for, the first of those alike
  std::vector<bool> sourceless_;    ///< by glTF texture: already warned about
};

}  // namespace whittle::gltf
