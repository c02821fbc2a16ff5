// What scenes of any size cost before the first ray: text, loops, placements, curves, against their targets.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "bench.h"
#include "measured_scene.h"
#include "support/filled.h"

namespace tyndall {

namespace {

const std::string frame_text =
    "camera perspective { from: (0, 0, 300) to: (0, 0, 0) }\nlight environment { radiance: 1 }\n";

// Spheres made by a loop.
std::string spheres_by_loop(int n) {
  return frame_text + support::filled(R"(
for i in 0..<$N {
  sphere { center: (mod(i, 100), mod(floor(i / 100), 100), floor(i / 10000)) radius: 0.3 }
}
)",
                                      {{"N", n}});
}

std::string placements(int n) {
  return frame_text + support::filled(R"(
object tree {
  sphere { center: (0, 1, 0) radius: 0.4 }
  cylinder { from: (0, 0, 0) to: (0, 1, 0) radius: 0.1 }
  box { min: (-1, -0.1, -1) max: (1, 0, 1) }
}
for i in 0..<$N { place tree { transform: translate((mod(i, 300), 0, floor(i / 300))) * rotate_y(1deg * i) } }
)",
                                      {{"N", n}});
}

std::string placed_lamps(int n) {
  return frame_text + support::filled(R"(
object lamp {
  sphere { radius: 0.1 }
  light point { position: (0, 1, 0) power: 1 }
}
for i in 0..<$N { place lamp { transform: translate((mod(i, 300), 0, floor(i / 300))) } }
)",
                                      {{"N", n}});
}

// A mesh as numbers: nothing but points and triangles.
std::string mesh_text(int points) {
  std::string text(frame_text);
  text += "mesh {\n  points: [\n";
  for (int i = 0; i < points; ++i)
    text += fmt::format("    ({:.6f}, {:.6f}, {:.6f}),\n", 0.013 * i, 1.7e-3 * (i % 1000), -0.37 * (i % 77));
  text += "  ]\n  triangles: [\n";
  for (int i = 0; i + 2 < points; ++i) text += fmt::format("    ({}, {}, {}),\n", i, i + 1, i + 2);
  return text += "  ]\n}\n";
}

// Statements written one by one, as another program would.
std::string statement_text(int spheres) {
  std::string text(frame_text);
  for (int i = 0; i < spheres; ++i)
    text += fmt::format("sphere {{ center: ({:.6f}, {:.6f}, {:.6f}) radius: {:.4f} }}\n", 0.013 * i,
                        1.7e-3 * (i % 1000), -0.37 * (i % 77), 0.01 + 1e-4 * (i % 50));
  return text;
}

// n, 2n, 4n: each doubling may cost no more than `2 * slack`.
template <class Text>
bool bench_growth(std::string_view title, Text&& text, int n, Until until, double bytes_each_at_most) {
  fmt::print("{}\n", title);
  std::vector<Cost> costs;
  for (const int times : {1, 2, 4}) {
    const auto cost = cost_of_scene("bench.tyn", text(n * times), until);
    if (!cost) return false;
    costs.push_back(*cost);
    const auto& lap = cost->lap_cpu_seconds;
    fmt::print(
        "  {:>9}: lex {:.3f} parse {:.3f} resolve {:.3f} compile {:.3f} s of CPU, {:.2f} s; peak {:.0f} MB\n",
        n * times, lap[1], lap[2], lap[3], lap[4], cost->wall_seconds, cost->peak_bytes / megabyte);
  }
  const double count = 2.0 * n;
  bool met =
      print_target("CPU for 4n over that for 2n", costs[2].cpu_seconds / costs[1].cpu_seconds, "", 2.3, true);
  met &= print_target("bytes each, at the peak", (costs[2].peak_bytes - costs[1].peak_bytes) / count, "B",
                      bytes_each_at_most, true);
  fmt::print("  {:<44}{:>10.0f} B\n", "bytes each, when all is made",
             (costs[2].resident_bytes - costs[1].resident_bytes) / count);
  return met;
}

bool bench_million() {
  fmt::print("1,000,000 spheres made by a loop\n");
  const auto cost = cost_of_scene("bench.tyn", spheres_by_loop(1'000'000), Until::compiled);
  if (!cost) return false;
  bool met = print_target("CPU of all threads", cost->cpu_seconds, "s", 10, true);
  met &= print_target("peak memory", cost->peak_bytes / megabyte, "MB", 1000, true);
  fmt::print("  {:<44}{:>10.2f} s\n", "wall clock, with whatever else the machine does", cost->wall_seconds);
  return met;
}

// The least of some runs of the program itself, loading it included.
bool bench_check() {
  fmt::print("`tyndall check` of a page of text\n");
  double least = 1e30;
  for (int i = 0; i < 11; ++i) {
    const auto cost =
        measured_program(TYNDALL_PROGRAM, {"check", TYNDALL_SOURCE_DIR "/tests/language/correct.tyn"});
    if (!cost) return false;
    least = std::min(least, *cost);
  }
  return print_target("CPU of a run", 1000 * least, "ms", 50, true);
}

bool bench_text(std::string_view title, const std::string& text) {
  fmt::print("{} ({:.1f} MB)\n", title, static_cast<double>(text.size()) / megabyte);
  std::vector<double> lex, parse, both;
  double bytes = 0;
  for (int i = 0; i < 5; ++i) {
    const auto cost = cost_of_scene("bench.tyn", text, Until::parsed);
    if (!cost) return false;
    lex.push_back(cost->lap_cpu_seconds[1]);
    parse.push_back(cost->lap_cpu_seconds[2]);
    both.push_back(lex.back() + parse.back());
    bytes = cost->peak_bytes;
  }
  const auto rate = [&](std::vector<double> seconds) {
    std::nth_element(seconds.begin(), seconds.begin() + 2, seconds.end());
    return static_cast<double>(text.size()) / megabyte / seconds[2];
  };
  fmt::print("  lex {:.0f} MB/s, parse {:.0f} MB/s; peak {:.1f} bytes a byte of text\n", rate(lex),
             rate(parse), bytes / static_cast<double>(text.size()));
  return print_target("lexed and parsed", rate(both), "MB/s", 50, false);
}

}  // namespace

bool bench_language() {
  bool met = bench_check();
  met &= bench_text("parsing: a mesh as numbers", mesh_text(400'000));
  met &= bench_text("parsing: spheres as statements", statement_text(300'000));
  met &= bench_million();
  met &= bench_growth("spheres by a loop", spheres_by_loop, 125'000, Until::compiled, 1000);
  met &= bench_growth("placements of one object", placements, 50'000, Until::compiled, 1500);
  met &= bench_growth("placements of an object with a lamp", placed_lamps, 50'000, Until::compiled, 1500);
  met &= bench_growth("a mesh as numbers", mesh_text, 50'000, Until::compiled, 4000);
  return met;
}

}  // namespace tyndall
