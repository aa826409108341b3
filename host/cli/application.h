// The command line as a whole, apart from main so that tests can run it in-process.
#pragma once

namespace whittle::cli {

/// Parses and runs. Returns the exit status of a finished command; wrong usage, unusable input and failures
/// leave as exceptions (InputError, std::invalid_argument: status 2; anything else: status 1).
int runApplication(int argc, const char* const* argv);

}  // namespace whittle::cli
