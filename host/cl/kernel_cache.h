// The folder where PoCL keeps what it has compiled: chosen and tried by us, since PoCL ends the process, or
// has no device, where it cannot be used.
#pragma once

#include <string>

namespace whittle {

/// Chooses the folder that PoCL itself would choose ($POCL_CACHE_DIR, $XDG_CACHE_HOME/pocl/kcache,
/// $HOME/.cache/pocl/kcache), tries it by writing, and takes a private one among the temporary files where
/// that fails. Sets $POCL_CACHE_DIR, and takes away what killed compilations left there. Returns a warning in
/// one line where it is not the folder that was asked for, else nothing. Called before the first OpenCL call
/// of the process; further calls find the folder settled.
std::string settleKernelCache();

/// Beside the kernels, for compile_turn.h.
inline constexpr const char* kTurnsFile = "whittle-turns";

}  // namespace whittle
