// KHR_draco_mesh_compression, on libdraco. Its decoder takes what a stream announces at its word, so the
// announced sizes are held against those of the accessors before each step that takes memory. Bitstream:
// Draco 2.2.
#include <draco/compression/config/decoder_options.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/mesh/mesh.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <limits>

#include "gltf/mesh_codecs.h"

namespace whittle::gltf {
namespace {

/// Attributes that the file does not ask for: a few may be in the stream all the same.
constexpr std::size_t kMoreAttributes = 4;
/// Values of glTF's attributes have no more components.
constexpr int kMostComponents = 4;

/// The counts that connectivity begins with: of edgebreaker vertices, triangles and attributes with seams of
/// their own (how it is traversed was read before), else triangles and points. Reads a copy of the buffer,
/// which stays where it is; what cannot be read is left to the decoder, which says so.
template <class Decoder>
bool announcesNoMoreThan(draco::DecoderBuffer ahead, const DracoMesh& mesh) {
  constexpr bool isEdgebreaker = std::is_same_v<Decoder, draco::MeshEdgebreakerDecoder>;
  std::uint8_t attributes = 0;
  std::uint32_t vertices = 0, faces = 0, points = 0;
  if constexpr (isEdgebreaker) {
    if (!draco::DecodeVarint(&vertices, &ahead) || !draco::DecodeVarint(&faces, &ahead) ||
        !ahead.Decode(&attributes))
      return true;
  } else if (!draco::DecodeVarint(&faces, &ahead) || !draco::DecodeVarint(&points, &ahead)) {
    return true;
  }
  return faces <= mesh.mostTriangles && points <= mesh.mostPoints && vertices <= mesh.mostPoints &&
         attributes <= mesh.attributes.size() + kMoreAttributes;
}

/// Stops where the stream asks for more than the file said.
template <class Decoder>
class Careful final : public Decoder {
 public:
  explicit Careful(const DracoMesh& mesh) : asked_(mesh) {}
  bool isTooMuch() const { return isTooMuch_; }

 protected:
  bool DecodeConnectivity() override {
    isTooMuch_ = !announcesNoMoreThan<Decoder>(*this->buffer(), asked_);
    return !isTooMuch_ && Decoder::DecodeConnectivity();
  }

  /// Attributes are described by now, and take their memory next.
  bool DecodeAllAttributes() override {
    const draco::PointCloud& cloud = *this->point_cloud();
    const auto count = static_cast<std::size_t>(cloud.num_attributes());
    isTooMuch_ = cloud.num_points() > asked_.mostPoints || count > asked_.attributes.size() + kMoreAttributes;
    for (std::size_t i = 0; i < count; ++i)
      isTooMuch_ = isTooMuch_ || cloud.attribute(static_cast<int>(i))->num_components() > kMostComponents;
    return !isTooMuch_ && Decoder::DecodeAllAttributes();
  }

 private:
  const DracoMesh& asked_;
  bool isTooMuch_ = false;
};

template <class Decoder>
std::string decodeWith(const DracoMesh& asked, draco::Mesh& out) {
  Careful<Decoder> decoder(asked);
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(asked.packed.data()), asked.packed.size());
  const draco::DecoderOptions options;
  const draco::Status status = decoder.Decode(options, &buffer, &out);
  if (status.ok()) return {};
  return decoder.isTooMuch()
             ? "it has more triangles, points or attributes than the file's accessors announce"
             : "its Draco stream is damaged (" + status.error_msg_string() + ")";
}

template <class T>
double numberAt(const std::uint8_t* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return static_cast<double>(value);
}

double numberAt(const std::uint8_t* at, draco::DataType type) {
  switch (type) {
    case draco::DT_INT8:
      return numberAt<std::int8_t>(at);
    case draco::DT_UINT8:
    case draco::DT_BOOL:
      return numberAt<std::uint8_t>(at);
    case draco::DT_INT16:
      return numberAt<std::int16_t>(at);
    case draco::DT_UINT16:
      return numberAt<std::uint16_t>(at);
    case draco::DT_INT32:
      return numberAt<std::int32_t>(at);
    case draco::DT_UINT32:
      return numberAt<std::uint32_t>(at);
    case draco::DT_INT64:
      return numberAt<std::int64_t>(at);
    case draco::DT_UINT64:
      return numberAt<std::uint64_t>(at);
    case draco::DT_FLOAT32:
      return numberAt<float>(at);
    default:
      return numberAt<double>(at);
  }
}

/// The nearest that the type holds.
template <class T>
void put(double number, std::byte* at) {
  T value = static_cast<T>(0);
  if constexpr (std::is_floating_point_v<T>) {
    value = static_cast<T>(number);
  } else if (!std::isnan(number)) {
    constexpr auto least = static_cast<double>(std::numeric_limits<T>::lowest());
    constexpr auto most = static_cast<double>(std::numeric_limits<T>::max());
    value = static_cast<T>(std::clamp(std::round(number), least, most));
  }
  std::memcpy(at, &value, sizeof value);
}

void put(double number, int componentType, std::byte* at) {
  switch (componentType) {
    case 5120:
      return put<std::int8_t>(number, at);
    case 5121:
      return put<std::uint8_t>(number, at);
    case 5122:
      return put<std::int16_t>(number, at);
    case 5123:
      return put<std::uint16_t>(number, at);
    case 5125:
      return put<std::uint32_t>(number, at);
    default:
      return put<float>(number, at);
  }
}

std::size_t bytesOf(int componentType) { return componentType <= 5121 ? 1 : componentType <= 5123 ? 2 : 4; }

/// Reads values through the point map: several points may share one.
std::string unpack(const draco::Mesh& mesh, DracoAttribute& out) {
  const draco::PointAttribute* const from = mesh.GetAttributeByUniqueId(out.id);
  if (!from) return "its Draco stream lacks an attribute that the file names";
  const auto stride = static_cast<std::size_t>(from->byte_stride());
  const auto typeBytes = static_cast<std::size_t>(draco::DataTypeLength(from->data_type()));
  const auto own = static_cast<std::size_t>(from->num_components()),
             wanted = static_cast<std::size_t>(out.components);
  if (own != wanted || stride < own * typeBytes)
    return "its Draco stream has an attribute of another shape than its accessor";
  const std::size_t step = bytesOf(out.componentType);
  out.values.resize(mesh.num_points() * wanted * step);
  std::byte* to = out.values.data();
  for (draco::PointIndex p(0); p < mesh.num_points(); ++p) {
    const draco::AttributeValueIndex index = from->mapped_index(p);
    if (index.value() >= from->size()) return "its Draco stream is damaged (a value beyond the last)";
    const std::uint8_t* const at = from->GetAddress(index);
    for (std::size_t c = 0; c < wanted; ++c, to += step)
      put(numberAt(at + c * typeBytes, from->data_type()), out.componentType, to);
  }
  return {};
}

std::string decodeStream(DracoMesh& mesh) {
  draco::DecoderBuffer start;
  start.Init(reinterpret_cast<const char*>(mesh.packed.data()), mesh.packed.size());
  draco::DracoHeader header{};
  if (!draco::PointCloudDecoder::DecodeHeader(&start, &header).ok()) return "it is no Draco stream";
  if (header.version_major != 2 || header.version_minor != 2)
    return "its Draco stream is of version " + std::to_string(header.version_major) + "." +
           std::to_string(header.version_minor) + ", and glTF has 2.2";
  if (header.encoder_type != draco::TRIANGULAR_MESH ||
      header.encoder_method > draco::MESH_EDGEBREAKER_ENCODING)
    return "its Draco stream holds no triangles";
  draco::Mesh unpacked;
  std::string problem = header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING
                            ? decodeWith<draco::MeshSequentialDecoder>(mesh, unpacked)
                            : decodeWith<draco::MeshEdgebreakerDecoder>(mesh, unpacked);
  if (!problem.empty()) return problem;
  mesh.points = unpacked.num_points();
  mesh.corners.reserve(3 * static_cast<std::size_t>(unpacked.num_faces()));
  for (draco::FaceIndex f(0); f < unpacked.num_faces(); ++f)
    for (const draco::PointIndex& corner : unpacked.face(f)) {
      if (corner.value() >= mesh.points)
        return "its Draco stream is damaged (a corner beyond the last point)";
      mesh.corners.push_back(corner.value());
    }
  for (DracoAttribute& attribute : mesh.attributes)
    if (problem = unpack(unpacked, attribute); !problem.empty()) return problem;
  return {};
}

class Codec final : public DracoCodec {
 public:
  std::string decode(DracoMesh& mesh) const override {
    try {
      return decodeStream(mesh);
    } catch (const std::exception& e) {
      return std::string("its Draco stream is damaged (") + e.what() + ")";
    }
  }
};

}  // namespace
}  // namespace whittle::gltf

const whittle::gltf::DracoCodec* whittleDracoCodec() {
  static const whittle::gltf::Codec codec;
  return &codec;
}
