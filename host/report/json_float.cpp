// Floats as the shortest decimals that read back as the same float.
#include "report/json_float.h"

#include <array>
#include <charconv>

namespace whittle {

double jsonFloat(float value) {
  std::array<char, 32> text;  // "-1.17549435e-38" is the longest kind
  const auto written = std::to_chars(text.data(), text.data() + text.size(), value);
  double read = 0.0;
  std::from_chars(text.data(), written.ptr, read);
  return read;
}

}  // namespace whittle
