// The picture: CompiledScene to Film.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "compile/compiled_scene.h"
#include "render/context/statistics.h"
#include "render/film/film.h"
#include "render/options.h"

namespace tyndall::render {

// A render that has not ended: what it needs, with its film, to go on in another process as if it had not
// stopped. `rest` is of this program alone (render.cpp).
struct Unfinished {
  Film film;
  std::string rest;
};

// `report` is called at most a few times a second from one thread at a time; `fraction` in [0, 1].
struct Progress {
  std::function<void(double fraction, double samples_per_second)> report = {};
  // Called after each pass but the last, and after a pause, with the picture so far and what `rest` of an
  // Unfinished would be.
  std::function<void(const Film& film, const Statistics& so_far, const std::string& rest)> pass = {};
  // Asked by all threads before each block of pixels, with the seconds so far: true ends the blocks at work
  // and makes a pause, in which `pass` is called.
  std::function<bool(double seconds)> wants_pause = {};
};

struct RenderResult {
  Film film;
  Statistics statistics;
  std::string rest;  // of an Unfinished
};

// `from` is a render of the same scene and options that was left unfinished (fits() says whether it can be).
RenderResult render(const compile::CompiledScene& world, const RenderOptions& options,
                    const Progress& progress = {}, std::optional<Unfinished> from = {});

// Whether a render with these options can go on from there.
bool fits(const compile::CompiledScene& world, const RenderOptions& options, const Unfinished& from);

// One sample of one pixel, with what happened on its path as text lines: `--pixel x,y --sample N`.
struct Replay {
  Rgb radiance;
  std::string trace;
};
Replay replay(const compile::CompiledScene& world, const RenderOptions& options, int x, int y,
              std::uint64_t sample);

}  // namespace tyndall::render
