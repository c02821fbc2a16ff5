// tyndall-bench [NAME|list] [SECONDS]: how fast things are, by hand; no test. Exits with 1 when a target is
// missed. `errors`, `denoise`, `sampling`, `default-steps`, `pepper`, `quality` and `extremes` take a part of
// a scene's name instead of seconds.
#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <string_view>

#include "bench.h"

namespace {

struct Asked {
  double seconds = 0.3;   // a row
  std::string_view part;  // the second argument as it is
};

struct Benchmark {
  std::string_view name;
  bool in_all = false;
  bool (*run)(const Asked& asked) = nullptr;  // false when a target is missed
};

using namespace tyndall;
// `language` and `inputs` are first, while the process has one thread: they measure children.
constexpr std::array benchmarks{
    Benchmark{"language", true, [](const Asked&) { return bench_language(); }},
    Benchmark{"inputs", true, [](const Asked&) { return bench_inputs(); }},
    Benchmark{"vm", true, [](const Asked& asked) { return vm::bench(asked.seconds); }},
    Benchmark{"ops", false, [](const Asked& asked) { return vm::bench_ops(asked.seconds / 10), true; }},
    Benchmark{"batches", true, [](const Asked&) { return bench_batches(); }},
    Benchmark{"bounds", true, [](const Asked& asked) { return bench_bounds(asked.seconds); }},
    Benchmark{"lights", true, [](const Asked&) { return bench_lights(); }},
    Benchmark{"errors", false, [](const Asked& asked) { return bench_errors(asked.part); }},
    Benchmark{"extremes", false, [](const Asked& asked) { return bench_extremes(asked.part); }},
    Benchmark{"denoise", false, [](const Asked& asked) { return bench_denoise(asked.part); }},
    Benchmark{"fire", false, [](const Asked&) { return bench_fire(); }},
    Benchmark{"hair", false, [](const Asked&) { return bench_hair(); }},
    Benchmark{"motion", true, [](const Asked&) { return bench_motion(); }},
    Benchmark{"scattering", false, [](const Asked&) { return bench_scattering(); }},
    Benchmark{"distant-guiding", false, [](const Asked&) { return bench_distant_guiding(); }},
    Benchmark{"pepper", false, [](const Asked& asked) { return bench_pepper(asked.part); }},
    Benchmark{"quality", false, [](const Asked& asked) { return bench_quality(asked.part); }},
    Benchmark{"transmittance", false, [](const Asked&) { return bench_transmittance(), true; }},
    Benchmark{"sampling", false, [](const Asked& asked) { return bench_sampling(asked.part); }},
    Benchmark{"steps", false, [](const Asked&) { return bench_steps(); }},
    Benchmark{"default-steps", false, [](const Asked& asked) { return bench_default_steps(asked.part); }},
    Benchmark{"sampling-pictures", false, [](const Asked&) { return write_sampling_pictures(); }},
    Benchmark{"verify", false, [](const Asked&) { return print_verification(); }},
    Benchmark{"scenes", true, [](const Asked& asked) { return bench_scenes(asked.seconds); }},
};

}  // namespace

int main(int argc, char** argv) {
  const std::string_view what = argc > 1 ? argv[1] : "all";
  Asked asked;
  if (what == "list") {
    for (const Benchmark& benchmark : benchmarks) fmt::print("{}\n", benchmark.name);
    return 0;
  }
  if (argc > 2) asked = {std::atof(argv[2]), argv[2]};
  bool known = false, good = true;
  if (asked.seconds > 0 || what == "errors" || what == "denoise" || what == "sampling" ||
      what == "default-steps" || what == "pepper" || what == "quality" || what == "extremes")
    for (const Benchmark& benchmark : benchmarks)
      if (what == benchmark.name || (what == "all" && benchmark.in_all)) {
        known = true;
        good &= benchmark.run(asked);
      }
  if (known) return good ? 0 : 1;
  fmt::print(stderr, "usage: tyndall-bench [NAME] [seconds a row, > 0]; NAME is all, list or one of");
  for (const Benchmark& benchmark : benchmarks) fmt::print(stderr, " {}", benchmark.name);
  fmt::print(stderr, "\n");
  return 2;
}
