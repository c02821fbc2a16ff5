// tyndall-bench [NAME] [SECONDS]: how fast things are, by hand; no test. Exits with 1 when a target is
// missed.
#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <string_view>

#include "bench.h"

namespace {

struct Benchmark {
  std::string_view name;
  bool in_all = false;
  bool (*run)(double seconds) = nullptr;  // false when a target is missed
};

using namespace tyndall;
// `language` is first, while the process has one thread: it measures children.
constexpr std::array benchmarks{
    Benchmark{"language", true, [](double) { return bench_language(); }},
    Benchmark{"vm", true, [](double seconds) { return vm::bench(seconds); }},
    Benchmark{"ops", false, [](double seconds) { return vm::bench_ops(seconds / 10), true; }},
    Benchmark{"batches", true, [](double) { return bench_batches(); }},
    Benchmark{"bounds", true, [](double seconds) { return bench_bounds(seconds); }},
    Benchmark{"lights", true, [](double) { return bench_lights(); }},
    Benchmark{"errors", false, [](double) { return bench_errors(); }},
    Benchmark{"fire", false, [](double) { return bench_fire(); }},
    Benchmark{"hair", false, [](double) { return bench_hair(); }},
    Benchmark{"scattering", false, [](double) { return bench_scattering(); }},
    Benchmark{"sunward", false, [](double) { return bench_sunward(); }},
    Benchmark{"transmittance", false, [](double) { return bench_transmittance(), true; }},
    Benchmark{"sampling", false, [](double) { return bench_sampling(); }},
    Benchmark{"steps", false, [](double) { return bench_steps(); }},
    Benchmark{"sampling-pictures", false, [](double) { return write_sampling_pictures(); }},
    Benchmark{"verify", false, [](double) { return print_verification(); }},
    Benchmark{"scenes", true, [](double seconds) { return bench_scenes(seconds); }},
};

}  // namespace

int main(int argc, char** argv) {
  const std::string_view what = argc > 1 ? argv[1] : "all";
  const double seconds = argc > 2 ? std::atof(argv[2]) : 0.3;
  bool known = false, good = true;
  if (seconds > 0)
    for (const Benchmark& benchmark : benchmarks)
      if (what == benchmark.name || (what == "all" && benchmark.in_all)) {
        known = true;
        good &= benchmark.run(seconds);
      }
  if (known) return good ? 0 : 1;
  fmt::print(stderr, "usage: tyndall-bench [NAME] [seconds a row, > 0]; NAME is all or one of");
  for (const Benchmark& benchmark : benchmarks) fmt::print(stderr, " {}", benchmark.name);
  fmt::print(stderr, "\n");
  return 2;
}
