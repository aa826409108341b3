// Local meshes into the scene's world-space arrays: instances, skins, mirrored and singular transforms,
// triangles that cannot be traced.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "gltf/geometry_sums.h"
#include "gltf/mesh.h"
#include "scene/notices.h"
#include "scene/scene.h"

namespace whittle::gltf {

/// Appends meshes to a scene. Vertices that no triangle uses are left behind.
class Baker {
 public:
  /// Makes room for `sums`, so that nothing is copied while the arrays grow.
  Baker(const Document& document, const GeometrySums& sums, Scene& scene);

  /// One copy of `mesh`. `label` names the node, for messages. `consumed`: null, or the mesh itself, which
  /// nobody reads again: its arrays go as their copies come.
  void add(const LocalMesh& mesh, const glm::dmat4& toWorld, std::uint32_t material, const std::string& label,
           LocalMesh* consumed = nullptr);
  /// `jointToWorld`: joint transforms times inverse bind matrices, one for each joint of the skin. Throws
  /// InputError if a vertex names a joint that the skin does not have.
  void addSkinned(const LocalMesh& mesh, std::span<const glm::dmat4> jointToWorld, std::uint32_t material,
                  const std::string& label);
  /// Pads the optional arrays to full length and says what was dropped.
  void finish(Notices& notices);

 private:
  template <class TransformOf>
  void bake(const LocalMesh& mesh, std::uint32_t material, const std::string& label, LocalMesh* consumed,
            TransformOf transformOf);
  void reserveIndices(const LocalMesh& mesh);
  void addTriangle(const Triangle& triangle);

  const Document& document_;
  std::size_t vertices_;  ///< that there is room for
  Scene& scene_;
  std::uint64_t unusable_ = 0;    ///< not finite or too large
  std::uint64_t degenerate_ = 0;  ///< no area
  std::uint64_t flattened_ = 0;   ///< of those, by singular transforms
  std::string flattenedBy_;       ///< the first node that did it
};

}  // namespace whittle::gltf
