// `tyndall golden`: scenes with their reference pictures, as regression tests of a renderer or of a project.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "image/image.h"
#include "image/z_test.h"

namespace tyndall::tools {

struct GoldenArguments {
  std::vector<std::string> paths;  // folders, or scenes
  bool statistical = false, update = false;
  std::optional<std::uint64_t> seed;
  std::optional<double> max;
  std::string references;  // the folder of the references; empty: each is beside its scene
  std::string report, junit;
  std::vector<std::string> include_directories;
  bool allow_outside = false, json = false;
  int threads = 0;
};

// A scene and the picture that it is compared with.
struct GoldenScene {
  std::string scene, reference;
};

enum class GoldenOutcome : std::uint8_t { passed, differs, problem, created, changed, unchanged };

struct GoldenResult {
  GoldenScene golden;
  GoldenOutcome outcome = GoldenOutcome::problem;
  bool tested = true;              // not where an interruption came before
  std::string message;             // what was found
  std::vector<std::string> notes;  // what else is to be known
  double seconds = 0;              // of rendering
  std::optional<double> relative_mse, flip;
  std::optional<image::ZTest> z_test;
  // Kept where they are to be looked at.
  std::optional<image::Image> picture, reference, errors;
  image::View view;
};

std::string_view name(GoldenOutcome outcome);

// The scenes that the paths name, in order of their names; a message where a path is none, or where two
// scenes would have one reference.
struct GoldenScenes {
  std::vector<GoldenScene> scenes;
  std::string problem;
};
GoldenScenes find_golden_scenes(const std::vector<std::string>& paths, const std::string& references);

// Renders a scene and compares it with its reference, or with --update puts the picture in its place.
// `directory` is for pictures on the way, `number` tells the scene apart there.
GoldenResult run_golden(const GoldenArguments& arguments, const GoldenScene& golden,
                        const std::string& directory, std::size_t number, int threads);

// What pictures depend on besides the scenes: "Tyndall 0.1.0, AVX2, 8 threads of …".
std::string describe_machine(int threads);

// A page with all results, and with pictures of those that did not pass; it needs no other file.
std::string golden_html(const GoldenArguments& arguments, const std::vector<GoldenResult>& results,
                        const std::string& machine);
// JUnit's XML, as CI systems read it.
std::string golden_junit(const std::vector<GoldenResult>& results, const std::string& machine);

}  // namespace tyndall::tools
