// The benchmarks of tyndall-bench.
#pragma once

#include <string_view>

namespace tyndall {

// Samples per second of the project's first scenes, each rendered for at least `seconds` three times. False
// when a scene cannot be read.
bool bench_scenes(double seconds);

// Time of a shader for each segment of a march inside of renders of the scenes, against the same points in
// batches of 256. False when a scene cannot be read or a target is missed.
bool bench_batches();

// Bounds against points, grids of a cloud, and what skipping empty space saves. False when a target is
// missed.
bool bench_bounds(double seconds_a_row);

// Ten lights against a thousand, at equal error. False when a thousand cost more than three times as much.
bool bench_lights();

// What `--error` reaches and tells in 20 renders of each scene, tame ones and those with rare bright paths,
// or of those whose names have `part` in them, with a line for each. False when a scene cannot be read.
bool bench_errors(std::string_view part);

// What denoising makes of the scenes of `scenes`, or of those whose names have `part` in them: error before
// and after, at 16, 64 and 256 samples. False when a scene cannot be read.
bool bench_denoise(std::string_view part);

// Fire sampled as light against fire that is met by chance, at equal time. False when a scene cannot be read.
bool bench_fire();

// Hair with opacity in smoke: all crossings in one march's distance pdf against one decision at each, at
// equal time. False when a scene cannot be read.
bool bench_hair();

// Moving clouds against still ones, and an open shutter against a closed one where nothing moves. False when
// a ratio of times misses its target.
bool bench_motion();

// `multiple_scattering: approximate` against the full solution: error and time on clouds and smoke. False
// when a scene cannot be read.
bool bench_scattering();

// Rays towards the sun on media that scatter forward, at equal time. False when a scene cannot be read.
bool bench_distant_guiding();

// The share of outlying pixels in each scene of the gallery and in those of tests/bench/pepper; of the scenes
// whose paths have `part` in them also through what the heaviest samples of such pixels came. False when a
// scene cannot be read.
bool bench_pepper(std::string_view part);

// Prints docs/quality.md: what the gallery's scenes give as they are, with a clamp, and denoised; or its rows
// of those scenes whose names have `part` in them. False when a scene cannot be read.
bool bench_quality(std::string_view part);

// The estimators of transmittance on known densities: bias and error at each cost.
void bench_transmittance();

// The tables of docs/sampling.md, the first one's rows those whose names have `part` in them; and its
// pictures, which are written where they belong. False when a scene cannot be read or a picture not written.
bool bench_sampling(std::string_view part);
bool bench_steps();
bool write_sampling_pictures();

// The step that a scene has when it says nothing, in scenes from a millimetre to 100 km, or those whose names
// have `part` in them. False when a scene cannot be read.
bool bench_default_steps(std::string_view part);

// Prints docs/extremes.md, or the tables of those scenes of tests/extremes whose names have `part` in them.
// False when a case is not as it should be.
bool bench_extremes(std::string_view part);

// Prints docs/verification.md. False when a line fails.
bool print_verification();

// What scenes cost before the first ray, against the targets. False when one is missed; the process must
// have one thread.
bool bench_language();
// What files of grids and meshes cost before the first ray, likewise.
bool bench_inputs();

}  // namespace tyndall

namespace tyndall::vm {

// The VM against the same shaders in scalar C++ and in hand-written Highway, alternated in one process. False
// when a row misses its target.
bool bench(double seconds_a_row);
// Every operation by itself.
void bench_ops(double seconds_a_row);

}  // namespace tyndall::vm
