// What a stage of the wavefront is, for everything that prints one. The
// stages themselves: wavefront/stages.h.
#pragma once

namespace whittle {

struct StageFacts {
  const char* name = "";     ///< of kernel, launch and method; statistics, trace and profile say the same
  const char* label = "";    ///< what it does
  const char* job = "";      ///< what it does together with others: five kernels compact, two shade
  const char* program = "";  ///< that it is compiled in
  const char* file = "";     ///< in kernels/
  const char* unit = "";     ///< what its items are
  const char* queue = "";    ///< that its items are entries of
};

}  // namespace whittle
