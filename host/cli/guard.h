// The program is two processes: the first guards, the second works. Drivers and compilers run inside the
// second one, and what ends it there (a crash, a signal, no more memory, a lock that nobody gives back) is
// said by the first one, in a line that names what was being done and what has been written by then. The
// first one takes the signals as well, so that they are answered at once, whatever the second is busy with.
#pragma once

#include <functional>
#include <string>

namespace whittle::cli {

/// Runs `program` in a child process and returns its exit status. 1 where something else ended it; a signal
/// that the user sent (SIGINT, SIGTERM, SIGHUP) ends this process in the same way, once it is said what is
/// written. The child ends with this process, however that one ends. Where no process can be started
/// `program` runs in this one, unguarded.
///
/// Called once, with one thread running. The guard itself takes no memory worth counting and no time: it
/// sleeps.
int runGuarded(const std::function<int()>& program);

// By the worker, for the guard to say. Without a guard they do nothing.
void nowDoing(const std::string& phase);    ///< "compiling kernels"
void haveWritten(const std::string& file);  ///< whole, under its name
void haveExplained();                       ///< an exit status other than 0; takes no memory

/// By the worker: from here on the first signal that the user sends (SIGINT, SIGTERM, SIGHUP) only makes
/// endIsWanted() true, and it is the worker's to come to an end that loses nothing. The next one ends it at
/// once. The status is that of the signal all the same. Without a guard it does nothing.
void answerSignals();
bool endIsWanted();

}  // namespace whittle::cli
