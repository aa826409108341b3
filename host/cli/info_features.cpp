// Features for people. One that is nothing without another that is left out stands beside it, and so do those
// that are left out for the same reason: the list says what a scene lacks once.
#include "cli/info_features.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "analysis/feature_needs.h"
#include "report/text.h"

namespace whittle::cli {
namespace {

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Two texts side by side, each wrapped in its own column.
std::string sideBySide(const std::string& left, const std::string& right) {
  constexpr std::size_t kLeft = 36, kRight = 40;
  const auto l = linesOf(wrapped(left, kLeft, 0)), r = linesOf(wrapped(right, kRight, 0));
  std::string out;
  for (std::size_t i = 0; i < std::max(l.size(), r.size()); ++i) {
    const std::string own = i < l.size() ? l[i] : "";
    out += "  " + (i < r.size() ? padded(own, kLeft) + "  " + r[i] : own) + "\n";
  }
  return out;
}

/// The feature whose absence says it all: what `f` needs and the scene leaves out, as far as that goes.
Feature rootOf(Feature f, const SceneFeatures& features) {
  for (const FeatureNeed& need : featureNeeds())
    if (need.feature == f && need.oneOf.size() == 1 && !features.has(need.oneOf.front()))
      return rootOf(need.oneOf.front(), features);
  return f;
}

std::string leftOutText(const SceneFeatures& features) {
  struct Group {
    std::string names, reason;
  };
  std::vector<Group> groups;
  const auto reasonOf = [&](Feature f) {
    const auto& lines = features.lines();
    return std::find_if(lines.begin(), lines.end(), [&](const auto& l) { return l.feature == f; })->reason;
  };
  for (const auto& line : features.lines()) {
    if (line.used) continue;
    const std::string reason = reasonOf(rootOf(line.feature, features));
    const auto same =
        std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return g.reason == reason; });
    if (same == groups.end())
      groups.push_back({line.text, reason});
    else
      same->names += ", " + line.text;
  }
  std::string out;
  for (const Group& g : groups) out += sideBySide(g.names, g.reason);
  return out;
}

std::string section(const char* title, const std::vector<std::string>& names) {
  return fmt::format("\n{}\n  {}\n", title,
                     wrapped(names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", ")), 78, 2));
}

}  // namespace

std::string featuresText(const SceneFeatures& features) {
  std::vector<std::string> needed, kept;
  for (const auto& line : features.lines()) {
    if (!line.used) continue;
    const std::string why = line.neededBy.empty() ? "" : fmt::format(" (needed by {})", line.neededBy);
    (line.forced ? kept : needed).push_back(line.text + why);
  }
  const std::string leftOut = leftOutText(features);
  return section("Needed", needed) + (kept.empty() ? "" : section("Kept because asked for", kept)) +
         "\nLeft out\n" + (leftOut.empty() ? "  nothing\n" : leftOut);
}

}  // namespace whittle::cli
