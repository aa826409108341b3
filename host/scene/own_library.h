// Libraries of the program's own that are loaded when they are first needed.
#pragma once

#include <string>

namespace whittle {

/// Loads `library` from beside the program, from above it (test programs) or from ../lib/whittle (installed),
/// and returns what it exports as `entry`. Null: `problem` says why; as it was where the file is nowhere.
void* loadOwnLibrary(const char* library, const char* entry, std::string& problem);

}  // namespace whittle
