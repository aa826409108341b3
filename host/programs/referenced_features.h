// Which features a kernel's text asks for: what decides how many different programs there are.
#pragma once

#include <cstdint>
#include <string>

namespace whittle {

/// Those of `bits` (numbers of kernels/shared/features.h) that can change what `source` compiles to: the
/// ones that its `#if HAS(…)` lines ask for, and any other line with HAS(…), where the answers to the lines
/// around them lead. Two sets of features for which this is the same number give the same program. Other
/// conditions (`defined`, compiler macros) count as either way. Throws std::runtime_error for a feature that
/// does not exist.
std::uint64_t referencedFeatures(const std::string& source, std::uint64_t bits);

}  // namespace whittle
