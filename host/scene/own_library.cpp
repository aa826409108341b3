// See own_library.h.
#include "scene/own_library.h"

#include <dlfcn.h>

#include <filesystem>

namespace whittle {

void* loadOwnLibrary(const char* library, const char* entry, std::string& problem) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  for (const char* place : {".", "..", "../lib/whittle"}) {
    const fs::path file = folder / place / library;
    std::error_code error;
    if (!fs::exists(file, error)) continue;
    if (void* const handle = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL))
      if (void* const found = dlsym(handle, entry)) return found;
    const char* const said = dlerror();
    problem = said ? said : "it does not hold what it should";
    return nullptr;
  }
  return nullptr;
}

}  // namespace whittle
