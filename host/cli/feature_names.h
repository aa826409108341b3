// Features by the names that `whittle info` gives them.
#pragma once

#include <cstdint>
#include <string>

namespace whittle::cli {

/// Bits of kernels/shared/features.h for "Normal map, metal", whatever the case of letters; "" gives none.
/// Throws InputError that names `option`, and the names that come near.
std::uint64_t parseFeatureNames(const std::string& option, const std::string& list);

}  // namespace whittle::cli
