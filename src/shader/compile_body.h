// Medium and material bodies to programs.
#pragma once

#include <optional>
#include <string>

#include "eval/evaluator.h"
#include "eval/value.h"
#include "scene/scene.h"

namespace tyndall::shader {

// Reports what a body sets that is no output, without running it: for one that nothing gives its arguments.
void check_outputs(eval::Context& context, const syntax::SyntaxTree& tree, syntax::BlockId body,
                   syntax::BodyKind kind, std::string_view name);

struct Options {
  bool fold = true;     // off: constants stay computations, for tests that compare
  bool guards = true;   // off: every lane computes every branch
  std::string watch{};  // a name whose value every medium also gets as a program of its own (scene::Watched)
};

// Runs the body with p, P, time as inputs, checks which outputs it sets (language.md "Medium": either albedo
// with optional extinction, or scattering and absorption; an output set in one branch must be set in all),
// multiplies by density, and compiles the two programs. Nothing after an error.
std::optional<scene::Medium> compile_medium(eval::Context& context, const eval::Body& body,
                                            const Options& options);

// The same for a material, by the table of its outputs; inputs p n P N uv time. Outputs that are not set, or
// set to their defaults, are left out of the program.
std::optional<scene::Material> compile_material(eval::Context& context, const eval::Body& body,
                                                const Options& options);

}  // namespace tyndall::shader
