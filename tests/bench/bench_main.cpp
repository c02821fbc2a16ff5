// tyndall-bench [vm|ops|bounds|scenes|lights|scattering|transmittance|verify|language] [seconds]: how fast
// things are, by hand; no test. Exits with 1 when a target is missed.
#include <fmt/format.h>

#include <cstdlib>
#include <string_view>

#include "bench.h"

int main(int argc, char** argv) {
  const std::string_view what = argc > 1 ? argv[1] : "all";
  const double seconds = argc > 2 ? std::atof(argv[2]) : 0.3;
  const bool all = what == "all";
  const bool known = all || what == "vm" || what == "ops" || what == "bounds" || what == "scenes" ||
                     what == "lights" || what == "scattering" || what == "transmittance" ||
                     what == "verify" || what == "language";
  if (!known || !(seconds > 0)) {
    fmt::print(stderr,
               "usage: tyndall-bench "
               "[vm|ops|bounds|scenes|lights|scattering|transmittance|verify|language|all] [seconds a "
               "row, > 0]\n");
    return 2;
  }
  bool good = true;
  // First, while the process has one thread: it measures children.
  if (all || what == "language") good &= tyndall::bench_language();
  if (all || what == "vm") good &= tyndall::vm::bench(seconds);
  if (what == "ops") tyndall::vm::bench_ops(seconds / 10);
  if (all || what == "bounds") tyndall::bench_bounds(seconds);
  if (all || what == "lights") good &= tyndall::bench_lights();
  if (what == "scattering") good &= tyndall::bench_scattering();
  if (what == "transmittance") tyndall::bench_transmittance();
  if (what == "verify") good = tyndall::print_verification();
  if (all || what == "scenes") good &= tyndall::bench_scenes(seconds);
  return good ? 0 : 1;
}
