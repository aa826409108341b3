// Parse, run, exit status; the only place that catches. 0 done, 1 the run failed, 2
// wrong usage or unusable input.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>

#include "cli/application.h"
#include "scene/input_error.h"

int main(int argc, char** argv) {
  const auto fail = [](const char* text, int status) {
    fmt::print(stderr, "whittle: {}\n", text);
    return status;
  };
  try {
    return whittle::cli::runApplication(argc, argv);
  } catch (const whittle::InputError& e) {
    return fail(e.what(), 2);
  } catch (const std::invalid_argument& e) {
    return fail(e.what(), 2);
  } catch (const std::bad_alloc&) {
    return fail("out of memory; a smaller picture, --wavefront or scene needs less", 1);
  } catch (const std::exception& e) {
    return fail(e.what(), 1);
  }
}
