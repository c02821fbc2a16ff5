// The rows of the statement table, and what is said when no row fits.
#include "resolve/statements/statements.h"

#include <fmt/format.h>

#include <algorithm>

#include "resolve/reading/reader.h"
#include "resolve/resolve_context.h"
#include "syntax/foreign_words.h"

namespace tyndall::resolve {

namespace {

template <class T>
std::optional<scene::Shape> read_shape(Run&, Reader& reader, const ShapeSite&) {
  return reader.read_valid<T>();
}

template <class T>
Statement shape() {
  constexpr bool combination = std::is_base_of_v<scene::CombinedShape, T>;
  Statement row{T::keyword, {}, {}, run_shape};
  if constexpr (combination)
    row.read_shape = read_combination<T>;
  else
    row.read_shape = read_shape<T>;
  row.closed = T::closed;
  row.list_names = list_names<T, ShapePlacement>;
  row.list_shape_names = list_names<T, Placement>;
  row.combines = T::closed;
  row.holds_parts = combination;
  return row;
}
template <>
Statement shape<scene::Mesh>() {
  return {scene::Mesh::keyword,
          {},
          {},
          run_shape,
          read_mesh,
          scene::Mesh::closed,
          list_names<MeshParameters, ShapePlacement>,
          list_names<MeshParameters, Placement>};
}
template <>
Statement shape<scene::Curves>() {
  return {scene::Curves::keyword,
          {},
          {},
          run_shape,
          read_curves,
          scene::Curves::closed,
          list_names<CurvesParameters, ShapePlacement>,
          list_names<CurvesParameters, Placement>};
}
template <class T>
Statement camera() {
  return {T::keyword, {}, {}, run_camera<T>, nullptr, false, list_names<T, Placement>};
}

// Of a file that holds shapes.
template <class T, class ShapeT>
Statement file(decltype(Statement::run) run, decltype(Statement::read_file_shape) read_shape) {
  return {T::keyword, {},        {}, run, nullptr, false, list_names<T>, list_names<ShapeT, Placement>,
          true,       read_shape};
}

template <class T>
Statement statement(decltype(Statement::run) run) {
  return {T::keyword, {}, {}, run, nullptr, false, list_names<T>};
}

// Those of the shapes, in the order of the family.
template <class... Shape>
void add_shapes(std::vector<Statement>& rows, const std::variant<Shape...>*) {
  (rows.push_back(shape<Shape>()), ...);
}

}  // namespace

std::vector<Statement> all_statements() {
  std::vector<Statement> rows{
      statement<scene::RenderSettings>(run_render),
      statement<AnimationParameters>(run_animation),
      camera<scene::PerspectiveCamera>(),
      camera<scene::OrthographicCamera>(),
      camera<scene::SphericalCamera>(),
  };
  const std::vector<Statement> lights = light_statements();
  rows.insert(rows.end(), lights.begin(), lights.end());
  add_shapes(rows, static_cast<const scene::Shape*>(nullptr));
  const std::vector<Statement> generated = generated_statements();
  rows.insert(rows.end(), generated.begin(), generated.end());
  rows.push_back(file<MeshFileParameters, MeshFileShapeParameters>(run_mesh_file, read_mesh_file_shape));
  rows.push_back(file<GltfParameters, GltfShapeParameters>(run_gltf, read_gltf_shape));
  rows.push_back({GltfCameraParameters::keyword,
                  {},
                  {},
                  run_gltf_camera,
                  nullptr,
                  false,
                  list_names<GltfCameraParameters, Placement>,
                  nullptr,
                  true});
  rows.push_back(statement<VolumeParameters>(run_volume));
  rows.push_back(statement<GroupParameters>(run_group));
  return rows;
}

namespace {

// The words after which a kind stands.
std::vector<std::string_view> kinds_of(const Statements& statements, std::string_view keyword) {
  std::vector<std::string_view> kinds;
  for (const Statement& row : statements.rows())
    if (row.name.size() > keyword.size() && row.name.starts_with(keyword) && row.name[keyword.size()] == ' ')
      kinds.push_back(row.name.substr(keyword.size() + 1));
  return kinds;
}

// The way out for a word that is no statement: what the scene itself defines under it, or what resembles it.
std::string help_for(Run& run, const Site& site, const syntax::ThingItem& thing) {
  const std::string_view word = run.symbols.text(thing.keyword.symbol);
  if (const eval::Binding* binding = site.scope->find(thing.keyword.symbol)) {
    if (binding->value.type == eval::Type::object) return fmt::format("write `place {} {{ … }}`", word);
    if (binding->value.type == eval::Type::function)
      return fmt::format("a template is called: `{}(…)`", word);
  }
  const std::string_view foreign = syntax::help_for_foreign_word(syntax::ForeignUse::statement, word);
  if (!foreign.empty()) return std::string(foreign);
  std::vector<std::string_view> words;
  for (const Statement& row : run.statements.rows()) words.push_back(row.name.substr(0, row.name.find(' ')));
  for (const eval::Scope* scope = site.scope.get(); scope; scope = scope->parent.get())
    for (const eval::Binding& binding : scope->bindings)
      if (binding.value.type == eval::Type::function || binding.value.type == eval::Type::object)
        words.push_back(run.symbols.text(binding.symbol));
  return did_you_mean(word, words);
}

// `foo` on a line of its own, before the statement `sphere { … }` on the next: no kind was meant.
bool stands_alone(const Run& run, const syntax::ThingItem& thing) {
  if (!thing.kind.symbol.valid() || !run.statements.find(thing.kind.symbol, {})) return false;
  const Span word = thing.keyword.span, next = thing.kind.span;
  const std::string_view text = run.sources[word.source].text();
  return text.substr(word.end, next.begin - word.end).find('\n') != std::string_view::npos;
}

}  // namespace

std::optional<syntax::ThingItem> statement_behind(const Run& run, const syntax::ThingItem& thing) {
  if (!stands_alone(run, thing)) return std::nullopt;
  syntax::ThingItem behind = thing;
  behind.keyword = thing.kind;
  behind.kind = {};
  return behind;
}

void report_unknown_statement(Run& run, const Site& site, const syntax::ThingItem& thing) {
  const std::string_view word = run.symbols.text(thing.keyword.symbol);
  const std::vector<std::string_view> kinds = kinds_of(run.statements, word);
  if (kinds.empty() && stands_alone(run, thing)) {
    const std::string help = help_for(run, site, thing);
    return run.diagnostics.error(
        thing.keyword.span,
        fmt::format(
            "'{}' does nothing here: expected '{{', '(', ':' or '=' after it, found the end of the line",
            word),
        help.empty() ? fmt::format("write {} {{ … }}, or leave it out", word) : help);
  }
  if (!kinds.empty()) {
    const std::string list = fmt::format("{}", fmt::join(kinds, ", "));
    if (!thing.kind.symbol.valid())
      return run.diagnostics.error(thing.keyword.span, fmt::format("'{}' needs a kind", word),
                                   fmt::format("one of: {}", list));
    const std::string_view kind = run.symbols.text(thing.kind.symbol);
    std::string help(syntax::help_for_foreign_word(
        word == "light" ? syntax::ForeignUse::light : syntax::ForeignUse::camera, kind));
    if (help.empty()) help = did_you_mean(kind, kinds);
    if (help.empty()) help = fmt::format("one of: {}", list);
    return run.diagnostics.error(thing.kind.span, fmt::format("no kind of '{}' called '{}'", word, kind),
                                 std::move(help));
  }
  if (thing.kind.symbol.valid() && run.statements.find(thing.keyword.symbol, {}))
    return run.diagnostics.error(thing.kind.span, fmt::format("'{}' has no kinds", word),
                                 fmt::format("write `{} {{ … }}`", word));
  run.diagnostics.error_once(thing.keyword.span, fmt::format("no statement '{}'", word),
                             help_for(run, site, thing));
}

Span header(const syntax::ThingItem& thing) {
  return thing.kind.symbol.valid() ? join(thing.keyword.span, thing.kind.span) : thing.keyword.span;
}

Reader reader_of(Run& run, const Site& site, const syntax::ThingItem& thing, const Statement& row,
                 Reader::Others others) {
  return Reader(run.evaluator, run.schemas, {site.tree, &site.scope, &run.statements}, thing.block, row.name,
                header(thing), others);
}

void run_thing(Run& run, const Site& site, const syntax::ThingItem& thing) {
  const Statement* row = run.statements.find(thing.keyword.symbol, thing.kind.symbol);
  if (!row) {
    report_unknown_statement(run, site, thing);
    if (const auto behind = statement_behind(run, thing)) run_thing(run, site, *behind);
    return;
  }
  const Statement* const of_file = run.statements.of_file(*row);
  if (thing.file.valid() && !of_file)
    return run.diagnostics.error((*site.tree)[thing.file].span, fmt::format("'{}' takes no file", row->name));
  if (!thing.file.valid() && row->of_file)
    return run.diagnostics.error(header(thing), fmt::format("'{}' needs a file", row->name),
                                 fmt::format("write {} \"model.glb\" {{ … }}", row->name));
  if (thing.file.valid()) row = of_file;
  if (may_stand(run, thing, *row)) row->run(run, site, thing, *row);
}

}  // namespace tyndall::resolve
