// Running sums of a march over segments whose coefficients are known: transmittance, what is scattered, what
// is emitted; and the chance by which a march ends where little passes.
#pragma once

#include <cstdint>
#include <vector>

#include "compile/compiled_scene.h"
#include "render/march/march.h"

namespace tyndall::render {

// Of segments: what each lets through, and the integral of transmittance over it [m].
struct IntegralScratch {
  std::vector<double> through, reach;
};

void begin_sums(March& march);
// Segments [march.count, end); march.count is then `end`.
void add_segments(const compile::CompiledScene& world, std::uint32_t end, IntegralScratch& scratch,
                  March& march);
// Russian roulette on the transmittance after the segments so far. False when the march ends there: nothing
// passes. When it goes on, all behind counts the more, so that no mean changes. `seed` is that of the march's
// jitter.
bool survives_roulette(std::uint32_t seed, std::uint32_t round, March& march);
// The crossings behind the last segment, and the sums' colours.
void finish_sums(March& march);

}  // namespace tyndall::render
