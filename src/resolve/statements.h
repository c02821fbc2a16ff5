// The table of scene statements: a row for each keyword and kind, and what it does.
#pragma once

#include <string_view>
#include <vector>

#include "base/fields.h"
#include "eval/value.h"
#include "scene/scene.h"
#include "syntax/tree.h"

namespace tyndall::resolve {

struct Run;
struct Site;
class Reader;

// Appends the names of parameters.
using ListNames = void (*)(std::vector<std::string_view>&);
template <class... T>
void list_names(std::vector<std::string_view>& names) {
  (T::fields([&](auto, const FieldInfo& info) { names.push_back(info.name); }), ...);
}

struct Statement {
  std::string_view name;               // "light point", "sphere"
  syntax::SymbolId keyword{}, kind{};  // kind is invalid for statements of one word
  // Does what the statement says; null: the language has it, this version does not.
  void (*run)(Run& run, const Site& site, const syntax::ThingItem& thing,
              const Statement& statement) = nullptr;
  // Shapes only: reads the shape's own parameters.
  scene::Shape (*read_shape)(Run& run, Reader& reader) = nullptr;
  bool closed = false;  // shapes only: has an inside
  // The statement's parameters, and those of a shape where it stands as a value; null where `run` is.
  ListNames list_names = nullptr, list_shape_names = nullptr;
};

class Statements {
 public:
  explicit Statements(syntax::Symbols& symbols);

  // The row of `keyword kind { … }`, or null.
  const Statement* find(syntax::SymbolId keyword, syntax::SymbolId kind) const;
  const std::vector<Statement>& rows() const { return rows_; }

 private:
  std::vector<Statement> rows_;
};

// Runs a scene statement, or says that there is none of that name.
void run_thing(Run& run, const Site& site, const syntax::ThingItem& thing);

void report_unknown_statement(Run& run, const Site& site, const syntax::ThingItem& thing);

// The rows' functions.
void run_render(Run&, const Site&, const syntax::ThingItem&, const Statement&);
void run_animation(Run&, const Site&, const syntax::ThingItem&, const Statement&);
template <class Camera>
void run_camera(Run&, const Site&, const syntax::ThingItem&, const Statement&);
void run_mesh_light(Run& run, const Site& site, const syntax::ThingItem& thing, const Statement& statement);
template <class Light>
void run_light(Run&, const Site&, const syntax::ThingItem&, const Statement&);
void run_shape(Run&, const Site&, const syntax::ThingItem&, const Statement&);
// Reads a mesh into the scene.
scene::Shape read_mesh(Run& run, Reader& reader);
scene::Shape read_curves(Run& run, Reader& reader);
void run_volume(Run&, const Site&, const syntax::ThingItem&, const Statement&);
void run_group(Run&, const Site&, const syntax::ThingItem&, const Statement&);

// The place of a statement's words: `light point`.
Span header(const syntax::ThingItem& thing);

}  // namespace tyndall::resolve
