// Prints what the machine itself gives to N threads (host/measure/ceilings.h), in lines of
// "KIND<tab>THREADS<tab>RATE".
// usage: ceilings THREADS[,THREADS...] SECONDS MEGABYTES_FOR_EACH_ARRAY
#include "measure/ceilings.h"

#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: ceilings THREADS[,THREADS...] SECONDS MEGABYTES_FOR_EACH_ARRAY\n");
    return 2;
  }
  const double seconds = std::atof(argv[2]), bytes = std::atof(argv[3]) * 1e6;
  std::istringstream counts(argv[1]);
  for (std::string count; std::getline(counts, count, ',');) {
    const int threads = std::atoi(count.c_str());
    if (threads < 1) return 2;
    const whittle::Ceilings c = whittle::measureCeilings(threads, seconds, bytes);
    std::printf("integer\t%d\t%.6g\nfma\t%d\t%.6g\ntriad\t%d\t%.6g\n", threads, c.integer, threads,
                c.multiplyAdd, threads, c.triad);
  }
}
