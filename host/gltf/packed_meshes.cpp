// Draco keeps neither the order of triangles nor their first corners; numbers of points are those of the
// accessors.
#include "gltf/packed_meshes.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "gltf/accessor.h"
#include "gltf/codec_library.h"
#include "gltf/mesh.h"
#include "gltf/packed_views.h"

namespace whittle::gltf {
namespace {

constexpr const char* kDraco = "KHR_draco_mesh_compression";

/// Calls visit(primitive, its JSON, mesh, number) for all drawable primitives of shown meshes, each once.
template <class Visit>
void eachPrimitive(Document& document, const Hierarchy& hierarchy, const Visit& visit) {
  std::set<int> meshes;
  for (const int node : hierarchy.shown) meshes.insert(document.nodes[at(node)].mesh);
  meshes.erase(-1);
  for (const int mesh : meshes) {
    auto& primitives = document.model.meshes[at(mesh)].primitives;
    for (std::size_t p = 0; p < primitives.size(); ++p)
      if (isDrawable(primitives[p]))
        visit(primitives[p], document.json["meshes"][at(mesh)]["primitives"][p], mesh, static_cast<int>(p));
  }
}

/// A stream, and the primitives that share it with all their accessors.
struct DracoJob {
  std::string label;
  DracoMesh mesh;
  std::vector<std::string> names = {};  ///< of its attributes
  std::vector<tinygltf::Primitive*> primitives = {};
  std::string problem = {};
};

/// What tells one job from another.
using DracoKey = std::tuple<int, std::map<std::string, int>, std::map<std::string, int>, int>;

std::uint64_t mostTriangles(const Document& document, const tinygltf::Primitive& p, std::uint64_t points) {
  const std::uint64_t corners = p.indices >= 0 ? accessorAt(document, p.indices).count : points;
  return p.mode == TINYGLTF_MODE_TRIANGLES ? corners / 3 : corners;
}

DracoJob dracoJob(Document& document, tinygltf::Primitive& p, const Json& json, const std::string& label) {
  DracoJob job{label, {viewData(document, json["bufferView"].get<int>()), 0, 0, {}}};
  job.mesh.mostPoints = accessorAt(document, p.attributes.at("POSITION")).count;
  job.mesh.mostTriangles = mostTriangles(document, p, job.mesh.mostPoints);
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
  if (job.mesh.mostPoints >= kMost || job.mesh.mostTriangles >= kMost / 3)
    document.fail(fmt::format("{}: more vertices or triangles than 32-bit indices can name", label));
  for (const auto& [name, id] : json["attributes"].items()) {
    const auto found = p.attributes.find(name);
    if (found == p.attributes.end()) continue;
    const tinygltf::Accessor& a = accessorAt(document, found->second);
    if (a.count != job.mesh.mostPoints)
      document.fail(
          fmt::format("{}: {} has {} elements for {} vertices", label, name, a.count, job.mesh.mostPoints));
    job.names.push_back(name);
    job.mesh.attributes.push_back({id.get<std::uint32_t>(), componentCount(a), a.componentType});
  }
  if (std::find(job.names.begin(), job.names.end(), "POSITION") == job.names.end())
    document.fail(fmt::format("{}: its Draco stream is to hold no POSITION", label));
  return job;
}

/// What a stream becomes is held; what the decoder takes meanwhile comes on top, of as many as there are
/// threads: connectivity with a table for each attribute, and each value twice more in 32 bits for each
/// component.
void holdDraco(const Document& document, const std::vector<DracoJob>& jobs) {
  constexpr std::uint64_t kTriangle = 120, kTriangleAttribute = 28, kValue = 48;
  std::uint64_t bytes = 0, triangles = 0;
  std::vector<std::uint64_t> passing;
  for (const DracoJob& job : jobs) {
    const std::uint64_t attributes = job.mesh.attributes.size();
    triangles += job.mesh.mostTriangles;
    bytes += 12 * job.mesh.mostTriangles + 16 * attributes * job.mesh.mostPoints;
    passing.push_back((kTriangle + kTriangleAttribute * attributes) * job.mesh.mostTriangles +
                      kValue * attributes * job.mesh.mostPoints);
  }
  std::sort(passing.begin(), passing.end(), std::greater<>());
  passing.resize(std::min(passing.size(), static_cast<std::size_t>(tbb::this_task_arena::max_concurrency())));
  const std::string what = fmt::format("its {} triangles in Draco's streams", triangles);
  document.pass(bytes + std::accumulate(passing.begin(), passing.end(), std::uint64_t{0}), what);
  document.hold(bytes, what);
}

/// An accessor over `values`, behind all those of the file.
int addAccessor(Document& document, tinygltf::Accessor like, std::uint64_t count, Bytes values) {
  like.bufferView = -1;
  like.byteOffset = 0;
  like.count = count;
  like.sparse = {};
  const auto index = static_cast<int>(document.model.accessors.size());
  document.model.accessors.push_back(std::move(like));
  document.unpackedAccessors.emplace(index, std::move(values));
  return index;
}

/// Returns the bytes of all of them.
std::uint64_t giveAccessors(Document& document, DracoJob& job) {
  std::uint64_t bytes = sizeof(std::uint32_t) * job.mesh.corners.size();
  for (const DracoAttribute& attribute : job.mesh.attributes) bytes += attribute.values.size();
  std::map<std::string, int> attributes;
  for (std::size_t i = 0; i < job.names.size(); ++i)
    attributes[job.names[i]] =
        addAccessor(document, accessorAt(document, job.primitives[0]->attributes.at(job.names[i])),
                    job.mesh.points, std::move(job.mesh.attributes[i].values));
  const auto corners = std::as_bytes(std::span(job.mesh.corners));
  tinygltf::Accessor indices;
  indices.type = TINYGLTF_TYPE_SCALAR;
  indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  const int index = addAccessor(document, indices, job.mesh.corners.size(), {corners.begin(), corners.end()});
  for (tinygltf::Primitive* const p : job.primitives) {
    for (const auto& [name, accessor] : attributes) p->attributes[name] = accessor;
    p->indices = index;
    p->mode = TINYGLTF_MODE_TRIANGLES;  // Draco's streams have lists, whatever they were
  }
  return bytes;
}

void unpackDraco(Document& document, const Hierarchy& hierarchy) {
  bool isRequired = false;
  for (const Json& required : child(document.json, "extensionsRequired")) isRequired |= required == kDraco;
  std::map<DracoKey, std::size_t> known;
  std::vector<DracoJob> jobs;
  const DracoCodec* codec = nullptr;
  eachPrimitive(document, hierarchy, [&](tinygltf::Primitive& p, const Json& json, int mesh, int number) {
    const Json* draco = extension(json, kDraco);
    if (!draco) return;
    if (!codec) codec = dracoCodec(document, !isRequired);
    if (!codec) return;
    const DracoKey key{(*draco)["bufferView"].get<int>(),
                       (*draco)["attributes"].get<std::map<std::string, int>>(), p.attributes, p.indices};
    const auto [place, isNew] = known.try_emplace(key, jobs.size());
    if (isNew) jobs.push_back(dracoJob(document, p, *draco, primitiveLabel(document, mesh, number)));
    jobs[place->second].primitives.push_back(&p);
  });
  if (jobs.empty()) return;
  holdDraco(document, jobs);
  tbb::parallel_for(std::size_t{0}, jobs.size(),
                    [&](std::size_t i) { jobs[i].problem = codec->decode(jobs[i].mesh); });
  for (DracoJob& job : jobs) {
    if (!job.problem.empty()) document.fail(fmt::format("{}: {}", job.label, job.problem));
    document.notices->unpack(kDraco, job.mesh.packed.size(), giveAccessors(document, job));
  }
}

void addView(const Document& document, int accessor, std::set<int>& views) {
  if (accessor < 0) return;
  const tinygltf::Accessor& a = accessorAt(document, accessor);
  if (a.bufferView >= 0) views.insert(a.bufferView);
}

}  // namespace

void unpackMeshes(Document& document, const Hierarchy& hierarchy) {
  unpackDraco(document, hierarchy);
  std::set<int> views;
  eachPrimitive(document, hierarchy, [&](const tinygltf::Primitive& p, const Json&, int, int) {
    addView(document, p.indices, views);
    for (const auto& [name, accessor] : p.attributes) addView(document, accessor, views);
    for (const auto& target : p.targets)
      for (const auto& [name, accessor] : target) addView(document, accessor, views);
  });
  unpackViews(document, views);
}

}  // namespace whittle::gltf
