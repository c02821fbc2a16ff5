// The table of scene statements: a row for each keyword and kind. Its rows are made by the statements
// (all_statements); readers of blocks look up where a parameter belongs that stands in the wrong one.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "base/fields.h"
#include "scene/scene.h"
#include "syntax/tree.h"

namespace tyndall::resolve {

struct Run;
struct Site;
class Reader;
struct PlacedShape;
struct NamedFile;
struct ShapeSite;

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
  // Shapes only: reads the shape's own parameters. Nothing after an error that the reader does not know of.
  std::optional<scene::Shape> (*read_shape)(Run& run, Reader& reader, const ShapeSite& site) = nullptr;
  bool closed = false;  // shapes only: has an inside
  // The statement's parameters, and those of a shape where it stands as a value; null where `run` is.
  ListNames list_names = nullptr, list_shape_names = nullptr;
  // A file's name stands between the words and the braces.
  bool of_file = false;
  // Of files with shapes in them: reads what it is as a value. Nothing after an error.
  std::optional<PlacedShape> (*read_file_shape)(Run& run, Reader& reader, const NamedFile& file) = nullptr;
  // Shapes only: may stand in a combination, and is one, which holds statements.
  bool combines = false, holds_parts = false;

  bool is_shape() const { return read_shape || read_file_shape; }
};

class Statements {
 public:
  Statements(std::vector<Statement> rows, syntax::Symbols& symbols);

  // The row of `keyword kind { … }`, or null.
  const Statement* find(syntax::SymbolId keyword, syntax::SymbolId kind) const;
  // The row of the same words that takes a file, or null.
  const Statement* of_file(const Statement& row) const;
  const std::vector<Statement>& rows() const { return rows_; }

 private:
  std::vector<Statement> rows_;
};

}  // namespace tyndall::resolve
