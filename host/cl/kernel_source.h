// Kernel source text: embedded in the binary, or read from a folder by developers; includes resolved here,
// because the -I build option is not portable.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace whittle {

/// Path below kernels/ → text. Generated at build time.
const std::map<std::string, std::string>& embeddedKernelFiles();

/// The text of `stages` (paths below kernels/) with every #include "…" pasted once, where it first
/// appears, and #line directives so that build logs name the file's own lines. `folder`: read from
/// there instead of the binary.
std::string assembleKernelSource(const std::vector<std::string>& stages,
                                 const std::optional<std::filesystem::path>& folder = {});

}  // namespace whittle
