// The rows of the statement table, and what is said when no row fits.
#include "resolve/statements.h"

#include <fmt/format.h>

#include <algorithm>

#include "resolve/reader.h"
#include "resolve/run.h"
#include "syntax/foreign_words.h"

namespace tyndall::resolve {

namespace {

template <class T>
scene::Shape read_shape(Run&, Reader& reader) {
  return reader.read_valid<T>();
}

template <class T>
Statement shape(bool closed) {
  return {T::keyword,
          {},
          {},
          run_shape,
          read_shape<T>,
          closed,
          list_names<T, ShapePlacement>,
          list_names<T, Placement>};
}
template <class T>
Statement light() {
  return {T::keyword, {}, {}, run_light<T>, nullptr, false, list_names<T, Placement>};
}
template <class T>
Statement camera() {
  return {T::keyword, {}, {}, run_camera<T>, nullptr, false, list_names<T, Placement>};
}

template <class T>
Statement statement(decltype(Statement::run) run) {
  return {T::keyword, {}, {}, run, nullptr, false, list_names<T>};
}

std::vector<Statement> all_statements() {
  return {
      statement<RenderParameters>(run_render),
      statement<AnimationParameters>(run_animation),
      camera<scene::PerspectiveCamera>(),
      camera<scene::OrthographicCamera>(),
      camera<scene::SphericalCamera>(),
      light<optics::PointLight>(),
      light<optics::SpotLight>(),
      light<optics::DistantLight>(),
      light<optics::SphereLight>(),
      light<optics::QuadLight>(),
      light<optics::DiskLight>(),
      {optics::MeshLight::keyword, {}, {}, run_mesh_light},
      light<optics::EnvironmentLight>(),
      shape<scene::Sphere>(true),
      shape<scene::Box>(true),
      shape<scene::Plane>(false),
      shape<scene::Quad>(false),
      shape<scene::Disk>(false),
      shape<scene::Cylinder>(true),
      {scene::Mesh::keyword,
       {},
       {},
       run_shape,
       read_mesh,
       true,
       list_names<MeshParameters, ShapePlacement>,
       list_names<MeshParameters, Placement>},
      {scene::Curves::keyword,
       {},
       {},
       run_shape,
       read_curves,
       false,
       list_names<CurvesParameters, ShapePlacement>,
       list_names<CurvesParameters, Placement>},
      {"gltf"},
      statement<VolumeParameters>(run_volume),
      statement<GroupParameters>(run_group),
  };
}

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

}  // namespace

void report_unknown_statement(Run& run, const Site& site, const syntax::ThingItem& thing) {
  const std::string_view word = run.symbols.text(thing.keyword.symbol);
  const std::vector<std::string_view> kinds = kinds_of(run.statements, word);
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

Statements::Statements(syntax::Symbols& symbols) : rows_(all_statements()) {
  for (Statement& row : rows_) {
    const std::size_t space = row.name.find(' ');
    row.keyword = symbols.intern(row.name.substr(0, space));
    if (space != std::string_view::npos) row.kind = symbols.intern(row.name.substr(space + 1));
  }
}

const Statement* Statements::find(syntax::SymbolId keyword, syntax::SymbolId kind) const {
  const auto row = std::find_if(rows_.begin(), rows_.end(),
                                [&](const Statement& s) { return s.keyword == keyword && s.kind == kind; });
  return row == rows_.end() ? nullptr : &*row;
}

Span header(const syntax::ThingItem& thing) {
  return thing.kind.symbol.valid() ? join(thing.keyword.span, thing.kind.span) : thing.keyword.span;
}

void run_thing(Run& run, const Site& site, const syntax::ThingItem& thing) {
  const Statement* row = run.statements.find(thing.keyword.symbol, thing.kind.symbol);
  if (!row) return report_unknown_statement(run, site, thing);
  if (!row->run)
    return run.diagnostics.error(header(thing), fmt::format("'{}' is not available yet", row->name));
  if (thing.file.valid())
    return run.diagnostics.error((*site.tree)[thing.file].span, fmt::format("'{}' takes no file", row->name));
  row->run(run, site, thing, *row);
}

}  // namespace tyndall::resolve
