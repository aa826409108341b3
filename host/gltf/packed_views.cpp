// Checks of streams: the table "JSON schema updates" in the extension's text.
#include "gltf/packed_views.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <array>
#include <utility>

#include "gltf/codec_library.h"

namespace whittle::gltf {
namespace {

constexpr std::array kExtensions{"EXT_meshopt_compression", "KHR_meshopt_compression"};

/// A compressed view with the name of its extension; null where it is as it is.
struct Packed {
  const char* extension = nullptr;
  const Json* json = nullptr;
};

Packed packedAt(const Document& document, int view) {
  const Json& json = document.json["bufferViews"][at(view)];
  for (const char* name : kExtensions)
    if (const Json* found = extension(json, name)) return {name, found};
  return {};
}

/// The bytes that stand behind a view may be there as well, for readers without the codec.
bool hasFallback(const Document& document, int view, const char* name) {
  for (const Json& required : child(document.json, "extensionsRequired"))
    if (required == name) return false;
  const Json& buffer = document.json["buffers"][at(document.model.bufferViews[at(view)].buffer)];
  return buffer.contains("uri") || document.hasBinary;
}

template <class Value, std::size_t n>
std::optional<Value> called(const std::array<std::pair<const char*, Value>, n>& words,
                            const std::string& word) {
  for (const auto& [name, value] : words)
    if (word == name) return value;
  return std::nullopt;
}

constexpr std::array<std::pair<const char*, MeshoptMode>, 3> kStreamModes{
    {{"ATTRIBUTES", MeshoptMode::Attributes},
     {"TRIANGLES", MeshoptMode::Triangles},
     {"INDICES", MeshoptMode::Indices}}};
constexpr std::array<std::pair<const char*, MeshoptFilter>, 4> kStreamFilters{
    {{"NONE", MeshoptFilter::None},
     {"OCTAHEDRAL", MeshoptFilter::Octahedral},
     {"QUATERNION", MeshoptFilter::Quaternion},
     {"EXPONENTIAL", MeshoptFilter::Exponential}}};

bool fits(const MeshoptStream& s) {
  const bool isShort = s.stride == 2, isWord = s.stride == 4, isLong = s.stride == 8;
  if (s.mode != MeshoptMode::Attributes)
    return s.filter == MeshoptFilter::None && (isShort || isWord) &&
           (s.mode != MeshoptMode::Triangles || s.count % 3 == 0);
  if (s.stride == 0 || s.stride > 256 || s.stride % 4 != 0) return false;
  return s.filter == MeshoptFilter::Octahedral ? isWord || isLong
                                               : s.filter != MeshoptFilter::Quaternion || isLong;
}

/// The version in the low half of a stream's first byte; the high half tells the mode.
int versionOf(const MeshoptStream& s) {
  return s.packed.empty() ? 0 : std::to_integer<int>(s.packed[0] & std::byte{0x0f});
}

/// Fewer bytes than the shortest stream of so many elements has: two bits for sixteen bytes of attributes, a
/// byte for a triangle or an index. Of version 1 attributes may take none.
bool isTooShort(const MeshoptStream& s) {
  const std::uint64_t size = s.packed.size();
  if (s.mode == MeshoptMode::Attributes) return versionOf(s) == 0 && size < s.count * s.stride / 64;
  return size < (s.mode == MeshoptMode::Triangles ? s.count / 3 : s.count);
}

struct Job {
  int view = 0;
  const char* extension = nullptr;
  std::string label;
  MeshoptStream stream;
  Bytes bytes = {};
  bool isWhole = false;
};

Job jobOf(Document& document, int view, const Packed& packed) {
  const Json& json = *packed.json;
  Job job{view, packed.extension, fmt::format("bufferViews[{}]", view), {}};
  const std::string modeWord = json["mode"].get<std::string>(), filterWord = json.value("filter", "NONE");
  const auto mode = called(kStreamModes, modeWord);
  const auto filter = called(kStreamFilters, filterWord);
  if (!mode)
    document.fail(
        fmt::format("{}: {} has the unknown mode{}", job.label, packed.extension, quotedName(modeWord)));
  if (!filter)
    document.fail(
        fmt::format("{}: {} has the filter{}, which Whittle does not read; gltfpack -cc writes others",
                    job.label, packed.extension, quotedName(filterWord)));
  MeshoptStream& s = job.stream;
  s = {{}, json["count"].get<std::uint64_t>(), json["byteStride"].get<std::uint64_t>(), *mode, *filter};
  const std::uint64_t length = document.model.bufferViews[at(view)].byteLength;
  if (!fits(s) || s.count * s.stride != length)
    document.fail(fmt::format("{}: {}: {} elements of {} bytes are not legal for {}, {} and {} bytes",
                              job.label, packed.extension, s.count, s.stride, modeWord, filterWord, length));
  s.packed = bytesOfBuffer(document, json["buffer"].get<int>(), json.value("byteOffset", std::uint64_t{0}),
                           json["byteLength"].get<std::uint64_t>(), job.label);
  if (isTooShort(s))
    document.fail(fmt::format("{}: {} elements cannot come of {} compressed bytes", job.label, s.count,
                              s.packed.size()));
  document.hold(length, fmt::format("the unpacked {}", job.label));
  return job;
}

[[noreturn]] void failUnpacking(const Document& document, const Job& job) {
  if (versionOf(job.stream) > 0)
    document.fail(
        fmt::format("{}: {}: a stream of version {}, which this libmeshoptimizer does not unpack; gltfpack "
                    "-c -noq -i IN -o OUT "
                    "makes one of version 0 of it",
                    job.label, job.extension, versionOf(job.stream)));
  document.fail(fmt::format("{}: its meshopt stream is damaged", job.label));
}

}  // namespace

void unpackViews(Document& document, const std::set<int>& views) {
  std::vector<Job> jobs;
  const MeshoptCodec* codec = nullptr;
  for (const int view : views) {
    const Packed packed = packedAt(document, view);
    if (!packed.json || document.unpackedViews.contains(view)) continue;
    if (!codec) codec = meshoptCodec(document, hasFallback(document, view, packed.extension));
    if (!codec) return;  // and the fallback is there
    jobs.push_back(jobOf(document, view, packed));
  }
  tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t i) {
    jobs[i].bytes.resize(jobs[i].stream.count * jobs[i].stream.stride);
    jobs[i].isWhole = codec->decode(jobs[i].stream, jobs[i].bytes.data());
  });
  for (Job& job : jobs) {
    if (!job.isWhole) failUnpacking(document, job);
    document.notices->unpack(job.extension, job.stream.packed.size(), job.bytes.size());
    document.unpackedViews.emplace(job.view, std::move(job.bytes));
  }
}

std::optional<std::span<const std::byte>> unpackedView(Document& document, int view) {
  if (!packedAt(document, view).json) return std::nullopt;
  unpackViews(document, {view});
  const auto found = document.unpackedViews.find(view);
  if (found == document.unpackedViews.end()) return std::nullopt;
  return std::span<const std::byte>(found->second);
}

}  // namespace whittle::gltf
