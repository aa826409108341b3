// Feature names: a list with commas in, bits out.
#include "cli/feature_names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <vector>

#include "analysis/scene_features.h"
#include "report/text.h"
#include "scene/input_error.h"

namespace whittle::cli {
namespace {

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t");
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(" \t") + 1 - begin);
}

/// "did you mean 'a' or 'b'? ", of the names that contain the word, else the one with fewest other letters.
std::string didYouMean(const std::string& word) {
  constexpr std::size_t kMost = 4;
  std::vector<std::string> near, lower;
  for (const Feature f : allFeatures()) {
    lower.push_back(lowerCase(featureText(f)));
    if (lower.back().find(lowerCase(word)) != std::string::npos)
      near.push_back(fmt::format("'{}'", featureText(f)));
  }
  if (near.empty() || near.size() > kMost) {
    const std::string closest = closestWord(lowerCase(word), lower);
    near.clear();
    for (std::size_t i = 0; i < lower.size(); ++i)
      if (lower[i] == closest) near.push_back(fmt::format("'{}'", featureText(allFeatures()[i])));
  }
  return near.empty() ? "" : fmt::format("did you mean {}? ", fmt::join(near, " or "));
}

std::uint64_t parseName(const std::string& option, const std::string& word, const std::string& list) {
  if (word.empty())
    throw InputError(
        fmt::format("{}: '{}' has an empty entry; names stand between single commas", option, list));
  for (const Feature f : allFeatures())
    if (lowerCase(word) == lowerCase(featureText(f))) return bitOf(f);
  throw InputError(fmt::format("{}: no feature is called '{}'; {}`whittle info SCENE` names them all", option,
                               word, didYouMean(word)));
}

}  // namespace

std::uint64_t parseFeatureNames(const std::string& option, const std::string& list) {
  std::uint64_t bits = 0;
  if (list.empty()) return bits;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    bits |= parseName(option, trimmed(list.substr(begin, end - begin)), list);
    begin = end + 1;
  }
  return bits;
}

}  // namespace whittle::cli
