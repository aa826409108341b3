// The one exception for unusable input: the command line turns it into one line and exit status 2.
#pragma once

#include <stdexcept>
#include <string>

namespace whittle {

/// The text is one line that names the file or option, what is wrong and, where there is one, the way out.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace whittle
