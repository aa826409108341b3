// Walks the node hierarchy. Every walk keeps its own stack: hierarchies as deep
// as the file has nodes are legal.
#include "gltf/nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "gltf/choice.h"
#include "gltf/origin.h"

namespace whittle::gltf {

namespace {

using Parents = std::vector<int>;

Parents findParents(const Document& document) {
  const auto& nodes = document.nodes;
  Parents parents(nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const int c : nodes[i].children) {
      int& parent = parents[static_cast<std::size_t>(c)];
      if (parent >= 0) {
        document.fail(fmt::format("{} has two parents, nodes {} and {}", nodeLabel(document, c), parent, i));
      }
      parent = static_cast<int>(i);
    }
  }
  return parents;
}

std::vector<int> rootsOf(const Parents& parents) {
  std::vector<int> roots;
  for (std::size_t i = 0; i < parents.size(); ++i) {
    if (parents[i] < 0) roots.push_back(static_cast<int>(i));
  }
  return roots;
}

/// Depth first from `roots`, children in file order. With one parent each no node is
/// met twice below distinct roots.
template <class Visit>
void walk(const std::vector<Node>& nodes, const std::vector<int>& roots, Visit visit) {
  std::vector<int> stack(roots.rbegin(), roots.rend());
  while (!stack.empty()) {
    const int node = stack.back();
    stack.pop_back();
    visit(node);
    const auto& children = nodes[static_cast<std::size_t>(node)].children;
    stack.insert(stack.end(), children.rbegin(), children.rend());
  }
}

/// A node on a cycle, there being one: going up from each node, until a root or where one has been before.
int nodeOfCycle(const Parents& parents) {
  std::vector<std::size_t> seenFrom(parents.size(), parents.size());
  for (std::size_t start = 0; start < parents.size(); ++start) {
    int node = static_cast<int>(start);
    while (node >= 0 && seenFrom[static_cast<std::size_t>(node)] == parents.size()) {
      seenFrom[static_cast<std::size_t>(node)] = start;
      node = parents[static_cast<std::size_t>(node)];
    }
    if (node >= 0 && seenFrom[static_cast<std::size_t>(node)] == start) return node;
  }
  return 0;
}

/// `origin` is taken off the roots, before anything is composed: what lies there comes out as if its file had
/// placed it at 0.
void globalTransforms(const Document& document, const Parents& parents, const std::vector<int>& roots,
                      const glm::dvec3& origin, std::vector<glm::dmat4>& toWorld) {
  const auto& nodes = document.nodes;
  toWorld.assign(nodes.size(), glm::dmat4(1.0));
  std::size_t reached = 0;
  walk(nodes, roots, [&](int node) {
    const auto i = static_cast<std::size_t>(node);
    glm::dmat4 local = nodes[i].local ? *nodes[i].local : glm::dmat4(1.0);
    if (parents[i] < 0) local[3] -= glm::dvec4(origin, 0.0);
    toWorld[i] = parents[i] < 0 ? local : toWorld[static_cast<std::size_t>(parents[i])] * local;
    ++reached;
  });
  // With single parents, what no root reaches hangs on a cycle.
  if (reached != nodes.size()) {
    document.fail(fmt::format("{} is its own ancestor: nodes must form trees",
                              nodeLabel(document, nodeOfCycle(parents))));
  }
}

int sceneCalled(const Document& document, const std::string& wanted) {
  std::vector<std::string> names;
  for (const auto& scene : document.model.scenes) names.push_back(scene.name);
  return static_cast<int>(indexCalled(document, "scene", names, wanted));
}

int chooseScene(const Document& document, const std::optional<std::string>& wanted, Notices& notices) {
  if (wanted) return sceneCalled(document, *wanted);
  if (document.model.defaultScene >= 0) return document.model.defaultScene;
  if (document.model.scenes.empty()) {
    if (!document.nodes.empty()) notices.note("the file has no scene: all its nodes are shown");
    return -1;
  }
  if (document.model.scenes.size() > 1) notices.note("the file names no default scene: the first is shown");
  return 0;
}

/// By node: it or one above it is not visible. `always`: at any time.
std::vector<bool> hiddenNodes(const Document& document, const Parents& parents, const std::vector<int>& roots,
                              bool always) {
  std::vector<bool> isHidden(parents.size());
  walk(document.nodes, roots, [&](int node) {
    const Node& n = document.nodes[at(node)];
    const bool hides = !n.isVisible && !(always && n.comesAndGoes);
    isHidden[at(node)] = hides || (parents[at(node)] >= 0 && isHidden[at(parents[at(node)])]);
  });
  return isHidden;
}

/// `listed`, what a scene names as its roots, without those that another one of them brings along. glTF wants
/// roots only, but files name children too, and other readers show them. Such a node is drawn as the child
/// that it is: its transform is that of its place below its parents, whoever names it (glTF 2.0, 3.5.2), and
/// a second copy would lie exactly in the first one.
std::vector<int> distinctRoots(const Document& document, const Parents& parents,
                               const std::vector<int>& allRoots, const std::vector<int>& listed,
                               Notices& notices) {
  std::vector<bool> isListed(parents.size());
  std::vector<int> children;
  for (const int root : listed) {
    if (isListed[at(root)]) document.fail(fmt::format("the scene lists {} twice", nodeLabel(document, root)));
    isListed[at(root)] = true;
    if (parents[at(root)] >= 0) children.push_back(root);
  }
  if (children.empty()) return listed;
  const std::string more = children.size() > 1 ? fmt::format(" (and {} more)", children.size() - 1) : "";
  notices.warn(
      fmt::format("the scene lists {}, a child of node {}: it is drawn once, in its place below that{}",
                  nodeLabel(document, children[0]), parents[at(children[0])], more));
  std::vector<bool> comesAlong(parents.size());
  walk(document.nodes, allRoots, [&](int node) {
    const int parent = parents[at(node)];
    comesAlong[at(node)] = parent >= 0 && (isListed[at(parent)] || comesAlong[at(parent)]);
  });
  std::vector<int> roots;
  std::copy_if(listed.begin(), listed.end(), std::back_inserter(roots),
               [&](int node) { return !comesAlong[at(node)]; });
  return roots;
}

}  // namespace

std::string nodeLabel(const Document& document, int node) {
  return fmt::format("node {}{}", node, quotedName(document.nodes[static_cast<std::size_t>(node)].name));
}

Hierarchy readHierarchy(Document& document, const std::optional<std::string>& sceneName, Notices& notices) {
  const auto& model = document.model;
  const Parents parents = findParents(document);
  const std::vector<int> allRoots = rootsOf(parents);
  document.hold((sizeof(glm::dmat4) + 4 * sizeof(int)) * parents.size(),
                fmt::format("its {} nodes", parents.size()));
  Hierarchy hierarchy;
  globalTransforms(document, parents, allRoots, glm::dvec3(0.0), hierarchy.toWorld);
  hierarchy.scene = chooseScene(document, sceneName, notices);
  const std::vector<int> roots =
      hierarchy.scene < 0
          ? allRoots
          : distinctRoots(document, parents, allRoots, model.scenes[at(hierarchy.scene)].nodes, notices);
  const std::vector<bool> isHidden = hiddenNodes(document, parents, allRoots, false);
  const bool changes = std::any_of(document.nodes.begin(), document.nodes.end(),
                                   [](const Node& node) { return node.comesAndGoes; });
  const std::vector<bool> isNeverSeen =
      changes ? hiddenNodes(document, parents, allRoots, true) : std::vector<bool>();
  walk(document.nodes, roots, [&](int node) {
    if (document.nodes[at(node)].camera >= 0) hierarchy.cameras.push_back(node);
    if (!isHidden[at(node)]) hierarchy.shown.push_back(node);
    if (changes && !isNeverSeen[at(node)]) hierarchy.shownSometime.push_back(node);
  });
  return hierarchy;
}

void settlePlace(Document& document, Hierarchy& hierarchy, Notices& notices) {
  Extents extents(document);
  hierarchy.origin = originFor(document, hierarchy, extents);
  if (hierarchy.origin != glm::dvec3(0.0)) {
    const Parents parents = findParents(document);
    globalTransforms(document, parents, rootsOf(parents), hierarchy.origin, hierarchy.toWorld);
  }
  warnOfCoarsePositions(document, hierarchy, extents, notices);
}

}  // namespace whittle::gltf
