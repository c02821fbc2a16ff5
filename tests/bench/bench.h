// The benchmarks of tyndall-bench.
#pragma once

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

// What `--error` reaches and tells in 20 renders of each scene, tame ones and those with rare bright paths.
// False when a scene cannot be read.
bool bench_errors();

// Fire sampled as light against fire that is met by chance, at equal time. False when a scene cannot be read.
bool bench_fire();

// Hair with opacity in smoke: all crossings in one march's distance pdf against one decision at each, at
// equal time. False when a scene cannot be read.
bool bench_hair();

// `multiple_scattering: approximate` against the full solution: error and time on clouds and smoke. False
// when a scene cannot be read.
bool bench_scattering();

// Rays towards the sun on media that scatter forward, at equal time. False when a scene cannot be read.
bool bench_sunward();

// The estimators of transmittance on known densities: bias and error at each cost.
void bench_transmittance();

// The tables of docs/sampling.md, and its pictures, which are written where they belong. False when a scene
// cannot be read or a picture not written.
bool bench_sampling();
bool bench_steps();
bool write_sampling_pictures();

// Prints docs/verification.md. False when a line fails.
bool print_verification();

// What scenes cost before the first ray, against the targets. False when one is missed; the process must
// have one thread.
bool bench_language();

}  // namespace tyndall

namespace tyndall::vm {

// The VM against the same shaders in scalar C++ and in hand-written Highway, alternated in one process. False
// when a row misses its target.
bool bench(double seconds_a_row);
// Every operation by itself.
void bench_ops(double seconds_a_row);

}  // namespace tyndall::vm
