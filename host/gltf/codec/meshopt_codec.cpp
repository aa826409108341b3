// EXT_meshopt_compression, on libmeshoptimizer. Its decoders are made for hostile bytes; sizes and strides,
// which they take on trust, are checked by the caller.
#include <meshoptimizer.h>

#include "gltf/mesh_codecs.h"

namespace whittle::gltf {
namespace {

class Codec final : public MeshoptCodec {
 public:
  bool decode(const MeshoptStream& s, std::byte* out) const override {
    const auto* packed = reinterpret_cast<const unsigned char*>(s.packed.data());
    const int status = s.mode == MeshoptMode::Attributes
                           ? meshopt_decodeVertexBuffer(out, s.count, s.stride, packed, s.packed.size())
                       : s.mode == MeshoptMode::Triangles
                           ? meshopt_decodeIndexBuffer(out, s.count, s.stride, packed, s.packed.size())
                           : meshopt_decodeIndexSequence(out, s.count, s.stride, packed, s.packed.size());
    if (status != 0) return false;
    if (s.filter == MeshoptFilter::Octahedral) meshopt_decodeFilterOct(out, s.count, s.stride);
    if (s.filter == MeshoptFilter::Quaternion) meshopt_decodeFilterQuat(out, s.count, s.stride);
    if (s.filter == MeshoptFilter::Exponential) meshopt_decodeFilterExp(out, s.count, s.stride);
    return true;
  }
};

}  // namespace
}  // namespace whittle::gltf

const whittle::gltf::MeshoptCodec* whittleMeshoptCodec() {
  static const whittle::gltf::Codec codec;
  return &codec;
}
