// Floats in JSON as people write them: 0.001, not the 0.0010000000474974513 that
// the same float is as a double.
#pragma once

namespace whittle {

/// The double whose shortest decimal is that of `value`: what a JSON writer prints
/// reads back as the same float.
double jsonFloat(float value);

}  // namespace whittle
