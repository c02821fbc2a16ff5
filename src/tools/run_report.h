// What is told about a finished rendering: its samples, the statistics as JSON, warnings, the last
// line.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "base/diagnostics.h"
#include "render/render.h"
#include "tools/render_arguments.h"

namespace tyndall::tools {

// Wall-clock seconds of the stages.
struct StageSeconds {
  double read = 0, parse = 0, resolve = 0, compile = 0, render = 0, write = 0;
};

// What is to be said of the samples of a pixel: "0..63", "12.5 a pixel on average".
std::string samples_text(const RenderArguments& arguments, const scene::Scene& scene,
                         const render::Statistics& statistics);

// What the scene's clamp removed; nothing where it has none.
std::optional<render::ClampedLight> clamped_light(const scene::Scene& scene,
                                                  const render::Statistics& statistics);

// What the steps of its marches change of a picture, by estimate: "about 0.4 %", or by
// proof; empty where there are none.
std::string step_bias_text(const RenderArguments& arguments, const render::Statistics& statistics);

// The contents of --stats FILE.json.
nlohmann::json statistics_json(const scene::Scene& scene, const std::string& scene_hash,
                               const StageSeconds& seconds, const render::Statistics& statistics,
                               const Sources& sources, const resolve::AssetBytes& assets);

// Adds a message for every shader statement that gave bad values, and for bad samples with the command that
// replays the first: warnings, or errors with --strict; so for tolerances that were not kept and for
// light that the film lost. Warns of steps that are too long or were widened, of light that `bounces` left
// out and of bounds that were cut.
void report_run_problems(const RenderArguments& arguments, const scene::Scene& scene,
                         const render::Statistics& statistics, Diagnostics& diagnostics);

// "fog.exr: 640x360, 64 samples per pixel in 0:12, 1.20 Msamples/s".
std::string summary_line(const RenderArguments& arguments, const scene::Scene& scene,
                         const render::Statistics& statistics);

}  // namespace tyndall::tools
