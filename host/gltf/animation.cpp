// Reads the channels of one animation and evaluates each at one time: glTF 2.0, 3.11 and appendix C.
#include "gltf/animation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "gltf/accessor.h"
#include "gltf/check.h"
#include "gltf/choice.h"
#include "gltf/keyframes.h"

namespace whittle::gltf {
namespace {

std::string textIn(const Json& object, const char* key, const char* fallback = "") {
  const auto found = object.find(key);
  return found == object.end() || !found->is_string() ? fallback : found->get<std::string>();
}

/// Reads one animation of the checked list.
class AnimationReader {
 public:
  AnimationReader(Document& document, const Json& animation, std::size_t index)
      : document_(document), animation_(animation), index_(index) {}

  void pose(double seconds, std::vector<bool>& moved) {
    std::size_t pointers = 0, unknown = 0;
    for (const Json& channel : animation_["channels"]) {
      const Json& target = channel["target"];
      const std::string path = textIn(target, "path");
      if (path == "pointer") {
        ++pointers;
      } else if (!target.contains("node")) {
        continue;  // legal: what an extension moves
      } else if (!apply(channel, target["node"].get<int>(), path, seconds, moved)) {
        ++unknown;
      }
    }
    if (pointers > 0)
      document_.warn(
          fmt::format("{}: {} channels of KHR_animation_pointer are not played", label(), pointers));
    if (unknown > 0)
      document_.warn(
          fmt::format("{}: {} channels move something unknown, and are not played", label(), unknown));
  }

 private:
  std::string label() const {
    return fmt::format("animations[{}]{}", index_, quotedName(textIn(animation_, "name")));
  }

  /// Whether the path is known.
  bool apply(const Json& channel, int nodeIndex, const std::string& path, double seconds,
             std::vector<bool>& moved) {
    static const std::map<std::string, int> kWidths{
        {"translation", 3}, {"rotation", 4}, {"scale", 3}, {"weights", 0}};
    const auto width = kWidths.find(path);
    if (width == kWidths.end()) return false;
    Node& node = document_.nodes[at(nodeIndex)];
    if (path == "weights") {
      node.rare->weights = sampled(channel, 0, Blend::Straight, seconds);
    } else {
      Node::Parts& parts = *node.rare->parts;
      if (parts.isMatrix) {
        document_.warn(fmt::format("{} moves {}, which has a matrix: it stays where it is", label(),
                                   nodeLabel(document_, nodeIndex)));
        return true;
      }
      const auto v =
          sampled(channel, width->second, path == "rotation" ? Blend::Turn : Blend::Straight, seconds);
      if (path == "rotation")
        parts.rotation = {v[0], v[1], v[2], v[3]};
      else
        (path == "scale" ? parts.scale : parts.translation) = {v[0], v[1], v[2]};
      node.local = std::make_unique<glm::dmat4>(composed(parts.translation, parts.rotation, parts.scale));
    }
    moved[at(nodeIndex)] = true;
    return true;
  }

  /// The channel's values at a time. `width`: how many there are; 0: as many as the file has of each
  /// keyframe.
  std::vector<double> sampled(const Json& channel, int width, Blend blend, double seconds) {
    const Json& samplers = animation_["samplers"];
    const auto number = channel["sampler"].get<std::size_t>();
    if (number >= samplers.size())
      document_.fail(fmt::format("{}: a channel has the sampler {}, but there are {}", label(), number,
                                 samplers.size()));
    const Json& sampler = samplers[number];
    const std::string name = fmt::format("{}.samplers[{}]", label(), number);
    const auto interpolation = interpolationCalled(textIn(sampler, "interpolation", "LINEAR"));
    if (!interpolation) document_.fail(name + ": its interpolation is none of STEP, LINEAR, CUBICSPLINE");
    Keyframes keys{*interpolation, blend, readTimes(sampler["input"].get<int>(), name), {}, 0};
    keys.values = readValues(sampler["output"].get<int>(), name);
    const std::size_t elements = keys.times.size() * (*interpolation == Interpolation::CubicSpline ? 3 : 1);
    keys.width = width > 0 ? static_cast<std::size_t>(width) : keys.values.size() / elements;
    if (keys.width == 0 || keys.values.size() != elements * keys.width)
      document_.fail(fmt::format("{} has {} values, which do not go with its {} times", name,
                                 keys.values.size(), keys.times.size()));
    return valueAt(keys, seconds);
  }

  std::vector<float> readTimes(int accessor, const std::string& name) {
    const tinygltf::Accessor& a = accessorAt(document_, accessor);
    if (componentCount(a) != 1 || !isFloat(a) || a.count == 0)
      document_.fail(name + ": its times must be floats, one at least");
    std::vector<float> times = readFloats(document_, accessor);
    const auto isFine = [](float t) { return std::isfinite(t); };
    if (!std::all_of(times.begin(), times.end(), isFine) || !std::is_sorted(times.begin(), times.end()))
      document_.fail(name + ": its times do not grow");
    return times;
  }

  std::vector<float> readValues(int accessor, const std::string& name) {
    const tinygltf::Accessor& a = accessorAt(document_, accessor);
    if (!isFloat(a) && !(isSmallInteger(a) && a.normalized))
      document_.fail(name + ": its values must be floats or normalised integers");
    std::vector<float> values = readFloats(document_, accessor);
    if (!std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); }))
      document_.fail(name + " has values that are not finite");
    return values;
  }

  Document& document_;
  const Json& animation_;
  std::size_t index_;
};

/// `max` of the accessor that holds its times, if there is one.
std::optional<double> lastTimeOf(const Json& sampler, const Json& accessors) {
  if (!sampler.is_object() || !accessors.is_array()) return std::nullopt;
  const Json& input = child(sampler, "input");
  if (!input.is_number_unsigned() || input.get<std::size_t>() >= accessors.size()) return std::nullopt;
  const Json& accessor = accessors[input.get<std::size_t>()];
  if (!accessor.is_object()) return std::nullopt;
  const Json& last = child(accessor, "max");
  if (!last.is_array() || last.size() != 1 || !last[0].is_number()) return std::nullopt;
  return last[0].get<double>();
}

}  // namespace

std::vector<AnimationFacts> animationsOf(const Json& file) {
  std::vector<AnimationFacts> found;
  const Json& accessors = child(file, "accessors");
  for (const Json& animation : file["animations"]) {
    AnimationFacts facts;
    if (animation.is_object()) {
      facts.name = textIn(animation, "name");
      for (const Json& sampler : child(animation, "samplers"))
        if (const auto last = lastTimeOf(sampler, accessors)) facts.seconds = std::max(facts.seconds, *last);
    }
    found.push_back(std::move(facts));
  }
  return found;
}

Posed poseNodes(Document& document, const std::optional<std::string>& wanted, double seconds) {
  Posed posed{-1, std::vector<bool>(document.nodes.size())};
  const auto& all = document.animationFacts;
  if (all.empty() && !wanted) return posed;
  std::vector<std::string> names;
  names.reserve(all.size());
  for (const AnimationFacts& facts : all) names.push_back(facts.name);
  const std::size_t index = wanted ? indexCalled(document, "animation", names, *wanted) : 0;
  posed.animation = static_cast<int>(index);
  const Json checked = checkedAnimations(document, Json::array({document.animations[index]}));
  AnimationReader(document, checked[0], index).pose(seconds, posed.moved);
  return posed;
}

Movement movementOf(const Document& document, const Hierarchy& hierarchy, std::vector<bool> moved) {
  // Nodes outside the scene may be joints: all that hang on what moves.
  std::vector<int> stack;
  for (std::size_t i = 0; i < moved.size(); ++i)
    if (moved[i]) stack.push_back(static_cast<int>(i));
  while (!stack.empty()) {
    const int node = stack.back();
    stack.pop_back();
    for (const int below : document.nodes[at(node)].children) {
      if (moved[at(below)]) continue;
      moved[at(below)] = true;
      stack.push_back(below);
    }
  }
  Movement movement;
  for (const int shown : hierarchy.shown) {
    const Node& node = document.nodes[at(shown)];
    movement.eyesOrLamps |= moved[at(shown)] && (node.camera >= 0 || node.light >= 0);
    if (node.mesh < 0) continue;
    movement.meshes |= moved[at(shown)];
    if (node.skin < 0) continue;
    const auto& joints = document.model.skins[at(node.skin)].joints;
    movement.meshes |= std::any_of(joints.begin(), joints.end(), [&](int joint) { return moved[at(joint)]; });
  }
  return movement;
}

}  // namespace whittle::gltf
