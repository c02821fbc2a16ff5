// What is told about a finished rendering: the picture's metadata, the statistics as JSON, warnings, the last
// line.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "base/diagnostics.h"
#include "image/image.h"
#include "render/render.h"
#include "tools/render_arguments.h"

namespace tyndall::tools {

// Wall-clock seconds of the stages.
struct StageSeconds {
  double read = 0, parse = 0, resolve = 0, compile = 0, render = 0, write = 0;
};

// A number that stays the same as long as the scene's printed form does: FNV-1a of the text, 64 bits in
// hexadecimal.
std::string stable_hash(std::string_view text);

// Everything that decided the picture and nothing else: two runs of any thread count write the same.
image::Metadata metadata_of(const RenderArguments& arguments, const scene::Scene& scene,
                            const std::string& scene_hash, const render::Statistics& statistics);

// The contents of --stats FILE.json.
nlohmann::json statistics_json(const scene::Scene& scene, const std::string& scene_hash,
                               const StageSeconds& seconds, const render::Statistics& statistics,
                               const Sources& sources);

// Adds a message for every shader statement that gave bad values, and for bad samples with the command that
// replays the first: warnings, or errors with --strict; so for tolerances that were not kept and for
// light that the film lost. Warns of steps that were widened, and of bounds that were cut.
void report_run_problems(const RenderArguments& arguments, const render::Statistics& statistics,
                         Diagnostics& diagnostics);

// "fog.exr: 640x360, 64 samples a pixel in 0:12, 1.20 Msamples/s", and what `bounces` cut when that is much.
std::string summary_line(const RenderArguments& arguments, const scene::Scene& scene,
                         const render::Statistics& statistics);

}  // namespace tyndall::tools
