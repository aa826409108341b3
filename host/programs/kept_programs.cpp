// See kept_programs.h.
#include "programs/kept_programs.h"

#include <algorithm>

namespace whittle {

const cl::Program* KeptPrograms::find(const std::string& key) {
  const auto found =
      std::find_if(programs_.begin(), programs_.end(), [&](const auto& kept) { return kept.first == key; });
  if (found == programs_.end()) return nullptr;
  programs_.splice(programs_.begin(), programs_, found);
  return &found->second;
}

void KeptPrograms::keep(const std::string& key, const cl::Program& program) {
  if (programs_.size() == most_) programs_.pop_back();
  programs_.emplace_front(key, program);
  ++total_;
}

}  // namespace whittle
