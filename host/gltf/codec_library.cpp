#include "gltf/codec_library.h"

#include <fmt/format.h>

#include "scene/own_library.h"

namespace whittle::gltf {
namespace {

/// A library that may not have been built.
template <class Codec>
struct Library {
  const Codec* codec = nullptr;
  std::string problem;

  Library(const char* file, const char* entry, const char* package)
      : problem(fmt::format("Whittle was built without {}", package)) {
    using Entry = const Codec* (*)();
    if (const auto found = reinterpret_cast<Entry>(loadOwnLibrary(file, entry, problem))) codec = found();
  }

  const Codec* get(const Document& document, const char* extensionName, bool hasFallback) const {
    if (!codec && !hasFallback)
      document.fail(fmt::format("needs {}, which cannot be unpacked: {}", extensionName, problem));
    return codec;
  }
};

}  // namespace

const MeshoptCodec* meshoptCodec(const Document& document, bool hasFallback) {
  static const Library<MeshoptCodec> library("libwhittle_meshopt.so", "whittleMeshoptCodec",
                                             "libmeshoptimizer-dev");
  return library.get(document, "EXT_meshopt_compression", hasFallback);
}

const DracoCodec* dracoCodec(const Document& document, bool hasFallback) {
  static const Library<DracoCodec> library("libwhittle_draco.so", "whittleDracoCodec", "libdraco-dev");
  return library.get(document, "KHR_draco_mesh_compression", hasFallback);
}

}  // namespace whittle::gltf
