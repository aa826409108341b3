// Reads the channels of one animation and evaluates each at one time: glTF 2.0, 3.11 and appendix C, and
// KHR_animation_pointer. A channel with a node means the same as one with the pointer to its property.
#include "gltf/animation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

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

/// Of a channel, checked or not.
bool isByPointer(const Json& channel) {
  if (!channel.is_object()) return false;
  const Json& target = child(channel, "target");
  return target.is_object() && textIn(target, "path") == "pointer";
}

/// Reads one animation of the checked list.
class AnimationReader {
 public:
  AnimationReader(Document& document, const Json& animation, std::size_t index)
      : document_(document), animation_(animation), index_(index) {}

  void pose(double seconds, Moved& moved) {
    std::vector<std::string> notPlayed;
    for (const Json& channel : animation_["channels"]) {
      const std::string pointer = pointerOf(channel["target"]);
      if (pointer.empty()) continue;  // legal: what an extension moves
      const auto [property, whyNot] = propertyAt(document_, pointer, moved);
      if (property)
        property->set(sampled(channel, *property, pointer, seconds));
      else
        notPlayed.push_back(fmt::format("{} ({})", shown(pointer), whyNot));
    }
    if (notPlayed.empty()) return;
    constexpr std::size_t kShown = 3;
    const std::size_t more = notPlayed.size() - std::min(kShown, notPlayed.size());
    notPlayed.resize(notPlayed.size() - more);
    document_.warn(fmt::format("{} does not move {}{}", label(), fmt::join(notPlayed, ", "),
                               more > 0 ? fmt::format(" and {} more", more) : ""));
  }

 private:
  std::string label() const {
    return fmt::format("animations[{}]{}", index_, quotedName(textIn(animation_, "name")));
  }

  /// What a channel moves, as a JSON pointer; empty: no node and nothing that is known.
  static std::string pointerOf(const Json& target) {
    const std::string path = textIn(target, "path");
    if (path != "pointer")
      return target.contains("node") ? fmt::format("/nodes/{}/{}", target["node"].get<int>(), path) : "";
    const Json* const e = extension(target, "KHR_animation_pointer");
    const std::string pointer = e ? (*e)["pointer"].get<std::string>() : "";
    return pointer.empty() ? "a pointer to nothing" : pointer;
  }

  /// Its end, where it is long: there it says what is moved.
  static std::string shown(const std::string& pointer) {
    constexpr std::size_t kLongest = 100;
    std::string line = oneLine(pointer);
    if (line.size() <= kLongest) return line;
    std::size_t begin = line.size() - kLongest;
    while (begin < line.size() && (static_cast<unsigned char>(line[begin]) & 0xC0U) == 0x80U) ++begin;
    return "…" + line.substr(begin);
  }

  /// The channel's values at a time.
  std::vector<double> sampled(const Json& channel, const Property& property, const std::string& pointer,
                              double seconds) {
    const Json& samplers = animation_["samplers"];
    const auto number = channel["sampler"].get<std::size_t>();
    if (number >= samplers.size())
      document_.fail(fmt::format("{}: a channel has the sampler {}, but there are {}", label(), number,
                                 samplers.size()));
    const Json& sampler = samplers[number];
    const std::string name = fmt::format("{}.samplers[{}]", label(), number);
    const auto interpolation = interpolationCalled(textIn(sampler, "interpolation", "LINEAR"));
    if (!interpolation) document_.fail(name + ": its interpolation is none of STEP, LINEAR, CUBICSPLINE");
    const int output = sampler["output"].get<int>();
    const bool takesIntegers = isByPointer(channel);
    if (takesIntegers || property.type == Property::Type::Flag)
      checkType(accessorAt(document_, output), property, *interpolation, name, shown(pointer));
    const Blend blend = property.type == Property::Type::Turn ? Blend::Turn : Blend::Straight;
    Keyframes keys{*interpolation, blend, readTimes(sampler["input"].get<int>(), name), {}, 0};
    keys.values = readValues(output, name, takesIntegers);
    const std::size_t elements = keys.times.size() * (*interpolation == Interpolation::CubicSpline ? 3 : 1);
    keys.width = property.width > 0 ? property.width : keys.values.size() / elements;
    if (keys.width == 0 || keys.values.size() != elements * keys.width)
      document_.fail(fmt::format("{} has {} values, which do not go with its {} times", name,
                                 keys.values.size(), keys.times.size()));
    return valueAt(keys, seconds);
  }

  /// As KHR_animation_pointer's table of accessor types.
  void checkType(const tinygltf::Accessor& a, const Property& property, Interpolation interpolation,
                 const std::string& name, const std::string& pointer) const {
    static constexpr std::array kWords{"SCALAR", "VEC2", "VEC3", "VEC4"};
    static constexpr std::array kTypes{TINYGLTF_TYPE_SCALAR, TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3,
                                       TINYGLTF_TYPE_VEC4};
    const std::size_t type = std::max<std::size_t>(property.width, 1) - 1;
    if (a.type != kTypes[type])
      document_.fail(
          fmt::format("{}: {} takes {} values, but its accessor has others", name, pointer, kWords[type]));
    if (property.type != Property::Type::Flag) return;
    if (a.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || a.normalized)
      document_.fail(fmt::format("{}: {} takes unsigned bytes, but its accessor has others", name, pointer));
    if (interpolation != Interpolation::Step)
      document_.fail(
          fmt::format("{}: {} is true or false, so that its interpolation must be STEP", name, pointer));
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

  /// Floats or normalised integers; what a pointer moves takes integers as they are as well.
  std::vector<float> readValues(int accessor, const std::string& name, bool takesIntegers) {
    const tinygltf::Accessor& a = accessorAt(document_, accessor);
    if (!isFloat(a) && !takesIntegers && !(isSmallInteger(a) && a.normalized))
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
      for (const Json& channel : child(animation, "channels")) facts.pointers += isByPointer(channel);
      for (const Json& sampler : child(animation, "samplers"))
        if (const auto last = lastTimeOf(sampler, accessors)) facts.seconds = std::max(facts.seconds, *last);
    }
    found.push_back(std::move(facts));
  }
  return found;
}

Posed poseDocument(Document& document, const std::optional<std::string>& wanted, double seconds) {
  Posed posed;
  posed.moved.nodes.resize(document.nodes.size());
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

namespace {

/// All that hang on those that move: nodes outside the scene too, which may be joints.
void moveChildren(const Document& document, std::vector<bool>& moved) {
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
}

}  // namespace

Movement movementOf(const Document& document, const Hierarchy& hierarchy, const std::set<int>& materials,
                    Moved moved) {
  moveChildren(document, moved.nodes);
  Movement movement;
  std::set_intersection(materials.begin(), materials.end(), moved.materials.begin(), moved.materials.end(),
                        std::inserter(movement.materials, movement.materials.end()));
  movement.meshes = moved.tangents && !movement.materials.empty();
  for (const int eye : hierarchy.cameras)
    movement.eyesOrLamps |= moved.nodes[at(eye)] || moved.cameras.contains(document.nodes[at(eye)].camera);
  for (const int shown : hierarchy.shown) {
    const Node& node = document.nodes[at(shown)];
    movement.eyesOrLamps |= node.light >= 0 && (moved.nodes[at(shown)] || moved.lights.contains(node.light));
    if (node.mesh < 0) continue;
    movement.meshes |= moved.nodes[at(shown)] || moved.meshes.contains(node.mesh);
    if (node.skin < 0) continue;
    const auto& joints = document.model.skins[at(node.skin)].joints;
    movement.meshes |=
        std::any_of(joints.begin(), joints.end(), [&](int joint) { return moved.nodes[at(joint)]; });
  }
  return movement;
}

}  // namespace whittle::gltf
