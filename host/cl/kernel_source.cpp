// Pastes kernel files together; see the header.
#include "cl/kernel_source.h"

#include <cerrno>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "scene/input_error.h"

namespace whittle {
namespace {

class Assembler {
 public:
  explicit Assembler(const std::optional<std::filesystem::path>& folder) : folder_(folder) {}

  void paste(const std::string& path) {
    if (!pasted_.insert(path).second) return;
    std::istringstream lines(read(path));
    out_ << "#line 1 \"" << path << "\"\n";
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
      static const std::string kInclude = "#include \"";
      if (line.rfind(kInclude, 0) != 0) {
        out_ << line << '\n';
        continue;
      }
      const auto end = line.find('"', kInclude.size());
      paste(line.substr(kInclude.size(), end - kInclude.size()));
      out_ << "#line " << number + 1 << " \"" << path << "\"\n";
    }
  }

  std::string text() const { return out_.str(); }

 private:
  std::string read(const std::string& path) const {
    if (folder_) {
      const std::filesystem::path file = *folder_ / path;
      errno = std::filesystem::is_directory(file) ? EISDIR : 0;
      std::ifstream in(file);
      if (!in || errno == EISDIR)
        throw InputError("--kernels: " + file.string() +
                         " cannot be read: " + std::generic_category().message(errno));
      return {std::istreambuf_iterator<char>(in), {}};
    }
    const auto found = embeddedKernelFiles().find(path);
    if (found == embeddedKernelFiles().end())
      throw std::runtime_error("no kernel file " + path + " in this binary");
    return found->second;
  }

  std::optional<std::filesystem::path> folder_;
  std::set<std::string> pasted_;
  std::ostringstream out_;
};

}  // namespace

std::string assembleKernelSource(const std::vector<std::string>& stages,
                                 const std::optional<std::filesystem::path>& folder) {
  Assembler assembler(folder);
  for (const auto& stage : stages) assembler.paste(stage);
  return assembler.text();
}

}  // namespace whittle
