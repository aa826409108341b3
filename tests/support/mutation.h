// Files with something wrong in them: what editors, transfers and bad writers do to bytes, and nonsense where
// numbers stand.
#pragma once

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>

namespace whittle::test {

/// How many a test tries: WHITTLE_MUTATIONS, or few enough for every run of the suite.
inline int mutations() {
  const char* const wanted = std::getenv("WHITTLE_MUTATIONS");
  return wanted ? std::atoi(wanted) : 200;
}

inline std::string fileText(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// One to four changes of `file`, which is not empty.
inline std::string mutated(std::string file, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
  static const std::array<std::string, 12> kNumbers{
      "-1",  "0",     "1e39", "-1e308", "4294967295", "2147483648", "18446744073709551615",
      "0.5", "1e-45", "null", "[]",     "\"x\""};
  const std::size_t changes = 1 + below(4);
  for (std::size_t k = 0; k < changes && !file.empty(); ++k) {
    const std::size_t at = below(file.size());
    switch (below(6)) {
      case 0:  // a byte
        file[at] = static_cast<char>(random() & 0xff);
        break;
      case 1:  // a bit
        file[at] = static_cast<char>(file[at] ^ (1 << below(8)));
        break;
      case 2:  // cut off
        if (below(4) == 0) file.resize(at);
        break;
      case 3: {  // a piece over another
        const std::size_t from = below(file.size());
        file.replace(at, 1 + below(16), file.substr(from, 1 + below(16)));
        break;
      }
      default: {  // a number of the text
        const std::size_t begin = file.find_first_of("0123456789", at);
        if (begin == std::string::npos) break;
        const std::size_t end = file.find_first_not_of("0123456789.eE+-", begin);
        file.replace(begin, end == std::string::npos ? end : end - begin, kNumbers[below(kNumbers.size())]);
      }
    }
  }
  return file;
}

}  // namespace whittle::test
