// What unpacks compressed geometry, as libraries of their own that are loaded with the first file that needs
// them: meshoptimizer (EXT_meshopt_compression) and Draco (KHR_draco_mesh_compression). Both are optional
// when Whittle is built. What a file announces is checked before they are called: packed_views.cpp,
// packed_meshes.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace whittle::gltf {

enum class MeshoptMode : std::uint8_t { Attributes, Triangles, Indices };
enum class MeshoptFilter : std::uint8_t { None, Octahedral, Quaternion, Exponential };

/// `count` elements of `stride` bytes, legal for mode and filter (the table in the extension's text).
struct MeshoptStream {
  std::span<const std::byte> packed;
  std::uint64_t count = 0, stride = 0;
  MeshoptMode mode = MeshoptMode::Attributes;
  MeshoptFilter filter = MeshoptFilter::None;
};

class MeshoptCodec {
 public:
  virtual ~MeshoptCodec() = default;
  /// Unpacks into count · stride bytes, aligned to 4; false where the stream is damaged or of a version that
  /// the library does not know. Any thread.
  virtual bool decode(const MeshoptStream& stream, std::byte* out) const = 0;
};

/// One attribute to be unpacked, as its accessor has it: of Draco's own number format nothing is left.
struct DracoAttribute {
  std::uint32_t id = 0;                ///< in the stream
  int components = 1;                  ///< of each value
  int componentType = 0;               ///< glTF's code
  std::vector<std::byte> values = {};  ///< once unpacked: one for each point, without gaps
};

/// What the file's accessors announce, and what comes out.
struct DracoMesh {
  std::span<const std::byte> packed;
  std::uint64_t mostPoints = 0, mostTriangles = 0;  ///< a stream with more is refused before it takes memory
  std::vector<DracoAttribute> attributes = {};
  std::uint64_t points = 0;
  std::vector<std::uint32_t> corners = {};  ///< three for each triangle; below `points`
};

class DracoCodec {
 public:
  virtual ~DracoCodec() = default;
  /// Returns what is wrong with the stream; empty: nothing. Any thread.
  virtual std::string decode(DracoMesh& mesh) const = 0;
};

}  // namespace whittle::gltf

/// What the libraries export.
extern "C" [[gnu::visibility("default")]] const whittle::gltf::MeshoptCodec* whittleMeshoptCodec();
extern "C" [[gnu::visibility("default")]] const whittle::gltf::DracoCodec* whittleDracoCodec();
