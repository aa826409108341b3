// See picture_channels.h.
#include "image/codec/picture_channels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include "scene/input_error.h"

namespace whittle {
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Channels of one layer in one part.
struct Layer {
  std::string name;  ///< empty: the unnamed one
  int part = 0;
  std::vector<std::string> words;  ///< behind the layer's name, in lower case
  std::vector<int> channels;

  int find(const std::string& word) const {
    const auto at = std::find(words.begin(), words.end(), word);
    return at == words.end() ? -1 : channels[at - words.begin()];
  }
};

/// The unnamed channels of a part that has a name are that layer, but for the names that mean the picture.
std::string layerOfPart(const std::string& part, bool several) {
  const std::string name = lower(part);
  return !several || name == "rgb" || name == "rgba" ? "" : part;
}

std::vector<Layer> layersOf(const std::vector<FilePart>& parts) {
  std::vector<Layer> layers;
  for (int p = 0; p < static_cast<int>(parts.size()); ++p) {
    const std::size_t first = layers.size();
    for (int c = 0; c < static_cast<int>(parts[p].channels.size()); ++c) {
      const std::string& channel = parts[p].channels[c];
      const auto dot = channel.rfind('.');
      const std::string name =
          dot == std::string::npos ? layerOfPart(parts[p].name, parts.size() > 1) : channel.substr(0, dot);
      auto layer = std::find_if(layers.begin() + static_cast<std::ptrdiff_t>(first), layers.end(),
                                [&](const Layer& l) { return l.name == name; });
      if (layer == layers.end()) layer = layers.insert(layer, {name, p, {}, {}});
      layer->words.push_back(lower(dot == std::string::npos ? channel : channel.substr(dot + 1)));
      layer->channels.push_back(c);
    }
  }
  return layers;
}

/// A layer's channels of these names, in their order; the first spelling that it has wholly.
template <std::size_t N>
std::vector<int> channelsNamed(const Layer& layer,
                               std::initializer_list<std::array<const char*, N>> spellings) {
  for (const auto& spelling : spellings) {
    std::vector<int> found;
    for (const char* word : spelling)
      if (const int channel = layer.find(word); channel >= 0) found.push_back(channel);
    if (found.size() == N) return found;
  }
  return {};
}

/// The unnamed layer that has the channels, else the only one; several: a refusal. Empty: none has them.
template <std::size_t N>
std::optional<PictureChannels> chooseLayer(const std::vector<Layer>& layers, const std::string& file,
                                           const char* what,
                                           std::initializer_list<std::array<const char*, N>> spellings) {
  std::optional<PictureChannels> only;
  std::vector<std::string> names;
  for (const Layer& layer : layers) {
    std::vector<int> channels = channelsNamed(layer, spellings);
    if (channels.empty()) continue;
    if (layer.name.empty()) return PictureChannels{layer.part, std::move(channels)};
    names.push_back(layer.name);
    only = PictureChannels{layer.part, std::move(channels)};
  }
  if (names.size() > 1)
    throw InputError(
        fmt::format("{}: several layers have {} and none of them is the unnamed one: {}; write one of them "
                    "to a file of its own",
                    file, what, fmt::join(names, ", ")));
  return only;
}

/// The one channel of a file that has no other, but for alpha.
std::optional<PictureChannels> onlyChannel(const std::vector<Layer>& layers) {
  std::optional<PictureChannels> only;
  for (const Layer& layer : layers)
    for (std::size_t i = 0; i < layer.words.size(); ++i) {
      if (layer.words[i] == "a" || layer.words[i] == "alpha") continue;
      if (only) return std::nullopt;
      only = PictureChannels{layer.part, {layer.channels[i]}};
    }
  return only;
}

[[noreturn]] void refuseChannels(const std::vector<FilePart>& parts, const std::string& file) {
  constexpr std::size_t kShown = 12;
  std::vector<std::string> names;
  for (const FilePart& part : parts)
    for (const std::string& channel : part.channels) names.push_back(channel);
  const std::size_t all = names.size();
  names.resize(std::min(all, kShown));
  if (all == 0) throw InputError(fmt::format("{}: not a two-dimensional picture", file));
  throw InputError(fmt::format("{}: no layer has R, G and B; its channels are {}{}", file,
                               fmt::join(names, ", "),
                               all > kShown ? fmt::format(" and {} more", all - kShown) : ""));
}

PictureChannels choose(const std::vector<Layer>& layers, const std::vector<FilePart>& parts,
                       const std::string& file) {
  using Triple = std::array<const char*, 3>;
  using Single = std::array<const char*, 1>;
  if (auto rgb = chooseLayer(layers, file, "R, G and B", {Triple{"r", "g", "b"}, {"red", "green", "blue"}}))
    return *rgb;
  std::vector<Layer> scalars = layers;  // the Y of a vector is no grey
  std::erase_if(scalars, [](const Layer& layer) { return layer.find("x") >= 0; });
  if (auto grey = chooseLayer(scalars, file, "Y", {Single{"y"}})) return *grey;
  if (auto vector = chooseLayer(layers, file, "X, Y and Z", {Triple{"x", "y", "z"}})) return *vector;
  if (auto only = onlyChannel(layers)) return *only;
  refuseChannels(parts, file);
}

}  // namespace

PictureChannels choosePicture(const std::vector<FilePart>& parts, const std::string& file) {
  const std::vector<Layer> layers = layersOf(parts);
  PictureChannels chosen = choose(layers, parts, file);
  chosen.hasAlpha = std::any_of(layers.begin(), layers.end(), [&](const Layer& layer) {
    return layer.part == chosen.part && (layer.find("a") >= 0 || layer.find("alpha") >= 0);
  });
  return chosen;
}

}  // namespace whittle
