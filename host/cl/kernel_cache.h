// The folder where PoCL keeps what it has compiled: chosen and tried by us, since PoCL ends the process, or
// has no device, where it cannot be used.
#pragma once

#include <filesystem>
#include <string>

namespace whittle {

/// Chooses the folder that PoCL itself would choose ($POCL_CACHE_DIR, $XDG_CACHE_HOME/pocl/kcache,
/// $HOME/.cache/pocl/kcache), tries it by writing, and takes a private one among the temporary files where
/// that fails. Sets $POCL_CACHE_DIR, and takes away what killed compilations left there. Returns a warning in
/// one line where it is not the folder that was asked for, else nothing. Called before the first OpenCL call
/// of the process; further calls find the folder settled.
std::string settleKernelCache();

/// The folder of our own cache (program_cache.h): $WHITTLE_CACHE_DIR, $XDG_CACHE_HOME/whittle,
/// $HOME/.cache/whittle, else one in the private folder among the temporary files. It need not be there.
std::filesystem::path programCacheFolder();

/// Marks in $POCL_CACHE_DIR that the kernels called `key` were compiled into it: PoCL itself cannot be asked.
/// Whoever empties the folder takes the marks away with the kernels.
void noteCompiled(const std::string& key);
bool wasCompiled(const std::string& key);

/// Beside the kernels, for compile_turn.h.
inline constexpr const char* kTurnsFile = "whittle-turns";
/// Held by the process that compiles while nobody waits.
inline constexpr const char* kBesideFile = "whittle-beside";

}  // namespace whittle
