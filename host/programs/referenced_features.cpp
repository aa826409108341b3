// Walks the conditional lines of a kernel's text; grammar: or := and {"||" and}, and := not {"&&" not},
// not := "!" not | "(" or ")" | HAS(NAME) | anything else.
#include "programs/referenced_features.h"

#include <cctype>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "kernels/shared/features.h"

namespace whittle {
namespace {

enum class Answer : std::uint8_t { No, Yes, Unknown };

Answer inverse(Answer a) { return a == Answer::Unknown ? a : (a == Answer::Yes ? Answer::No : Answer::Yes); }

int bitOf(std::string_view name) {
  static const std::map<std::string_view, int> bits{
#define WHITTLE_NAMED(name, bit, text) {#name, bit},
      WHITTLE_FEATURES(WHITTLE_NAMED)
#undef WHITTLE_NAMED
  };
  const auto found = bits.find(name);
  if (found == bits.end())
    throw std::runtime_error("a kernel asks for the feature " + std::string(name) + ", which does not exist");
  return found->second;
}

/// One condition; notes each feature that it must know to find its answer.
class Condition {
 public:
  Condition(std::string_view text, std::uint64_t bits, std::uint64_t& asked)
      : text_(text), bits_(bits), asked_(asked) {}

  Answer answer() {
    const Answer a = either();
    return at_ == text_.size() ? a : Answer::Unknown;
  }

 private:
  void skipSpace() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  bool take(std::string_view token) {
    skipSpace();
    if (text_.substr(at_, token.size()) != token) return false;
    at_ += token.size();
    skipSpace();
    return true;
  }
  /// `decided`: the answer is known without what follows, which is read but not asked.
  Answer skipping(bool decided, Answer (Condition::*part)()) {
    const std::uint64_t before = asked_;
    const Answer a = (this->*part)();
    if (decided) asked_ = before;
    return a;
  }
  Answer either() {
    Answer a = both();
    while (take("||")) {
      const Answer b = skipping(a == Answer::Yes, &Condition::both);
      if (a != Answer::Yes) a = b == Answer::Yes ? b : (a == Answer::No ? b : a);
    }
    return a;
  }
  Answer both() {
    Answer a = single();
    while (take("&&")) {
      const Answer b = skipping(a == Answer::No, &Condition::single);
      if (a != Answer::No) a = b == Answer::No ? b : (a == Answer::Yes ? b : a);
    }
    return a;
  }
  Answer single() {
    if (take("!")) return inverse(single());
    if (take("HAS(")) return feature();
    if (take("(")) {
      const Answer a = either();
      return take(")") ? a : Answer::Unknown;
    }
    return something();
  }
  Answer feature() {
    const auto end = text_.find(')', at_);
    const int bit = bitOf(text_.substr(at_, end - at_));
    at_ = end;
    take(")");
    asked_ |= std::uint64_t{1} << bit;
    return (bits_ >> bit) & 1U ? Answer::Yes : Answer::No;
  }
  /// A name or a number, with what stands behind it in brackets.
  Answer something() {
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_'))
      ++at_;
    if (take("(")) {
      const auto end = text_.find(')', at_);
      at_ = end == std::string_view::npos ? text_.size() : end + 1;
      skipSpace();
    }
    return Answer::Unknown;
  }

  std::string_view text_;
  std::uint64_t bits_;
  std::uint64_t& asked_;
  std::size_t at_ = 0;
};

/// A `#if` that is open.
struct Level {
  bool active;          ///< the lines around it may be compiled
  bool taken = false;   ///< a branch so far is sure to be
  bool branch = false;  ///< the branch at hand may be
};

/// Features that a line asks for outside of conditions: as a number, or in a macro.
std::uint64_t askedInLine(std::string_view line) {
  constexpr std::string_view kHas = "HAS(";
  if (line.rfind("#define HAS(", 0) == 0) return 0;
  std::uint64_t asked = 0;
  for (auto at = line.find(kHas); at != std::string_view::npos; at = line.find(kHas, at + 1)) {
    const bool isWord =
        at > 0 && (std::isalnum(static_cast<unsigned char>(line[at - 1])) || line[at - 1] == '_');
    const auto begin = at + kHas.size();
    if (!isWord) asked |= std::uint64_t{1} << bitOf(line.substr(begin, line.find(')', begin) - begin));
  }
  return asked;
}

}  // namespace

std::uint64_t referencedFeatures(const std::string& source, std::uint64_t bits) {
  std::uint64_t asked = 0;
  std::vector<Level> open;
  const auto active = [&] { return open.empty() || (open.back().active && open.back().branch); };
  const auto enter = [&](Level& level, std::string_view condition) {
    level.branch = level.active && !level.taken;
    if (!level.branch) return;
    const Answer a = Condition(condition, bits, asked).answer();
    level.branch = a != Answer::No;
    level.taken = a == Answer::Yes;
  };
  std::istringstream lines(source);
  std::string line;
  while (std::getline(lines, line)) {
    const std::string_view text = std::string_view(line).substr(0, line.find("//"));
    if (text.rfind("#ifdef", 0) == 0 || text.rfind("#ifndef", 0) == 0) {
      open.push_back({active(), false, active()});
    } else if (text.rfind("#if ", 0) == 0) {
      open.push_back({active()});
      enter(open.back(), text.substr(4));
    } else if (!open.empty() && text.rfind("#elif ", 0) == 0) {
      enter(open.back(), text.substr(6));
    } else if (!open.empty() && text.rfind("#else", 0) == 0) {
      open.back().branch = open.back().active && !open.back().taken;
    } else if (!open.empty() && text.rfind("#endif", 0) == 0) {
      open.pop_back();
    } else if (active()) {
      asked |= askedInLine(text);
    }
  }
  return bits & asked;
}

}  // namespace whittle
