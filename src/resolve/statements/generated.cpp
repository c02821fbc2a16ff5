// Shapes that are made into meshes from a few parameters (generate/generated.h).
#include "resolve/resolve_context.h"

namespace tyndall::resolve {

namespace {

// Finds the file that a shape names.
template <class T>
void find_files(Run&, Reader&, T&) {}
void find_files(Run& run, Reader& reader, generate::Text& text) {
  if (!text.names_file()) return;
  const auto file = find_file(run, "font", *text.font, reader.place("font"));
  if (!file) return reader.refuse();
  text.font_file = *file;
  std::error_code failed;
  const std::uintmax_t bytes = std::filesystem::file_size(*file, failed);
  note_asset(run, {file->string(), "font", ""}, failed ? 0 : bytes);
}

template <class T>
std::optional<scene::Shape> read_generated(Run& run, Reader& reader, const ShapeSite&) {
  auto given = reader.read<T>();
  scene::Mesh shape;
  if (!reader.ok()) return shape;
  reader.report(given.validate());
  if (reader.ok()) find_files(run, reader, given);
  if (reader.ok() && !run.may_repeat(given.facets(), reader.place({}))) reader.refuse();
  if (!reader.ok()) return shape;
  generate::Made made = given.make();
  reader.report(made.problems);
  if (!reader.ok()) return shape;
  reader.report(scene::validate(made.mesh));
  if (!reader.ok()) return shape;
  shape.mesh = scene::MeshId(run.scene.meshes.size());
  run.scene.meshes.push_back(std::move(made.mesh));
  const Span place = reader.place({});
  run.written.meshes.push_back({shape.mesh, place, place, {}});
  return shape;
}

template <class T>
Statement generated() {
  return {T::keyword,
          {},
          {},
          run_shape,
          read_generated<T>,
          T::closed,
          list_names<T, ShapePlacement>,
          list_names<T, Placement>};
}

template <class... T>
std::vector<Statement> statements_of(const std::variant<T...>*) {
  return {generated<T>()...};
}

template <class... T>
std::string_view way_to_close_of(std::string_view keyword, const std::variant<T...>*) {
  std::string_view way;
  ((keyword == T::keyword ? void(way = T::way_to_close) : void()), ...);
  return way;
}

constexpr const generate::Generated* family = nullptr;

}  // namespace

std::vector<Statement> generated_statements() { return statements_of(family); }

std::string_view way_to_close(std::string_view keyword) { return way_to_close_of(keyword, family); }

}  // namespace tyndall::resolve
