// tyndall-bench [vm|scenes|transmittance] [seconds]: how fast things are, by hand; never a test.
#include <fmt/format.h>

#include <cstdlib>
#include <string_view>

#include "bench.h"

int main(int argc, char** argv) {
  const std::string_view what = argc > 1 ? argv[1] : "all";
  const double seconds = argc > 2 ? std::atof(argv[2]) : 0.3;
  const bool all = what == "all";
  if (!(all || what == "vm" || what == "scenes" || what == "transmittance") || !(seconds > 0)) {
    fmt::print(stderr, "usage: tyndall-bench [vm|scenes|transmittance|all] [seconds a row, > 0]\n");
    return 2;
  }
  if (all || what == "vm") tyndall::vm::bench(seconds);
  if (what == "transmittance") tyndall::bench_transmittance();
  if (all || what == "scenes") return tyndall::bench_scenes(seconds) ? 0 : 1;
  return 0;
}
