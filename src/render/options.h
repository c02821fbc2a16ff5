// What a render is asked for besides the scene.
#pragma once

#include <atomic>
#include <optional>

#include "render/distance/distance_mixture.h"
#include "render/film/aov.h"
#include "render/film/film.h"
#include "render/method/medium_sampler.h"
#include "render/transmittance/transmittance.h"
#include "vm/run/machine.h"

namespace tyndall::render {

struct RenderOptions {
  int threads = 0;         // 0: all
  bool skip_empty = true;  // leave out what is proven to be empty; false to measure what that saves
  vm::RunObserver* shader_observer =
      nullptr;  // of every batch of a shader, by the worker's thread; to measure
  Method method = Method::decoupled;
  Distance distance = Distance::product;  // of the decoupled method; of tracking as far as it has them
  Transmittance transmittance = Transmittance::march;
  bool emission_sampling = true;  // media that emit are sampled as lights; false to measure what that saves
  bool distant_guiding = true;    // rays are sent towards distant lights (distant_light_guiding.h); the same
  bool lamp_guiding = true;       // and towards lamps (lamp_guiding.h); the same
  bool learned_lights =
      true;  // many lights are chosen by what a pilot sees of them (learned_lights.h); the same
  // Half-open pixel rectangle and sample range; defaults: everything.
  std::optional<PixelWindow> crop;
  int first_sample = 0;
  std::optional<int> sample_count;  // default: the scene's
  AovSet aovs;                      // outputs beside the picture
  // Ends once the root of the picture's mean squared relative error is below this (adaptive_sampling.h), each
  // block with as many samples as it needs; sample_count is then the most that a pixel gets.
  std::optional<double> error;
  // [s]: ends when it is over, with whole passes as far as can be told from those before. A block of pixels
  // that is at work then is not counted, so that each has all samples of a pass or none.
  std::optional<double> time_limit;
  const std::atomic<bool>* stop = nullptr;  // set to end early with what there is
};

}  // namespace tyndall::render
