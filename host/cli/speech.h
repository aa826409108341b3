// What the program says to people, in one place. Saying something never ends anything: standard error may be
// closed, full, too long or a pipe that nobody reads, and the render goes on. Names of files and of what is
// in them may hold anything: all text passes through report/printable.h.
#pragma once

#include <string>

namespace whittle::cli {

/// Before anything else: descriptors 0 to 2 that are closed become /dev/null, or the first picture that is
/// opened would take the place of standard error and hold its messages; and a pipe that nobody reads becomes
/// an error.
void settleStreams();

// One line each, on standard error.
void warn(const std::string& text);      ///< "warning: …"
void note(const std::string& text);      ///< "note: …"
void complain(const std::string& text);  ///< "whittle: …"
/// warn, unless it is empty.
void warnIfAny(const std::string& text);

/// Several lines on standard error, ends of lines included.
void tellError(const std::string& lines);
/// As it is, control characters and all: the progress bar's own text.
void drawError(const std::string& text);

/// Several lines on standard output, ends of lines included. Throws as finishOutput, which knows whether all
/// arrived.
void tell(const std::string& lines);
/// JSON has no control characters, and may have long lines.
void tellJson(const std::string& json);
/// Throws std::runtime_error if something did not reach standard output. Where its reader has gone, ends the
/// process as the signal SIGPIPE does.
void finishOutput();

}  // namespace whittle::cli
