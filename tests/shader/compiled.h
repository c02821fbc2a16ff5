// Compiles bodies from text and runs them at points, for the tests of this folder.
#pragma once

#include <array>
#include <memory>
#include <string>

#include "eval/evaluator.h"
#include "shader/compile_body.h"
#include "syntax/parser.h"
#include "vm/run/machine.h"

namespace tyndall::shader {

// Where a body is run.
struct Point {
  Vec3f p{}, P{}, n{0, 1, 0}, N{0, 1, 0};
  float u = 0, v = 0, time = 0;
};

class BodyText {
 public:
  explicit BodyText(std::string text) {
    const SourceId source = sources.add("test.tyn", std::move(text));
    context.sources = &sources;
    context.symbols = &symbols;
    context.diagnostics = &diagnostics;
    tree = syntax::parse(sources, source, syntax::lex(sources, source, diagnostics), symbols, diagnostics);
    eval::Evaluator evaluator(context);
    for (const syntax::ItemId id : tree.list_of_items(tree[tree.file].items))
      evaluator.define(tree, tree[id], scope);
  }

  // The body of that name: a definition, or a let of one with arguments.
  const eval::Body* body(std::string_view name) {
    const eval::Binding* binding = scope->find(symbols.intern(name));
    return binding ? binding->value.get<eval::Body>() : nullptr;
  }
  std::optional<scene::Medium> medium(std::string_view name = "m", bool fold = true) {
    return compile_medium(context, *body(name), {fold});
  }
  std::optional<scene::Material> material(std::string_view name = "m") {
    return compile_material(context, *body(name), {});
  }
  std::string messages() const { return render_text(diagnostics, sources, false); }

  Sources sources;
  syntax::Symbols symbols;
  Diagnostics diagnostics;
  eval::Context context;
  syntax::SyntaxTree tree;
  std::shared_ptr<eval::Scope> scope = std::make_shared<eval::Scope>();
};

// All outputs of a program at one point.
inline std::vector<float> run(const vm::Program& program, const Point& at) {
  std::vector<float> values(program.outputs.size());
  std::vector<float*> rows;
  for (float& value : values) rows.push_back(&value);
  vm::BatchInputs inputs;
  // In the order of vm::Input; a body has no tangents, vertex colours or second coordinates here.
  const std::array<float, vm::input_count> all = {at.p.x, at.p.y, at.p.z, at.P.x, at.P.y,
                                                  at.P.z, at.n.x, at.n.y, at.n.z, at.N.x,
                                                  at.N.y, at.N.z, at.u,   at.v,   at.time};
  for (std::size_t i = 0; i < all.size(); ++i) inputs.lanes[i] = &all[i];
  vm::Machine().run(program, inputs, 1, rows);
  return values;
}

// The three components that a quantity's outputs name.
inline Rgb rgb(const std::vector<float>& outputs, const std::array<std::uint8_t, 3>& indices) {
  return {outputs[indices[0]], outputs[indices[1]], outputs[indices[2]]};
}

}  // namespace tyndall::shader
