// Closed shapes combined: difference, intersection and union. Their braces hold statements like those of a
// group, so loops, templates and groups make parts, too.
#include <fmt/format.h>

#include "resolve/resolve_context.h"

namespace tyndall::resolve {

namespace {

// What parts may be: "sphere, box".
std::string words_of_parts(const Run& run) {
  std::vector<std::string_view> names;
  for (const Statement& row : run.statements.rows())
    if (row.combines) names.push_back(row.name);
  return fmt::format("parts are: {}", fmt::join(names, ", "));
}

// Whether there is room for so many more parts.
bool may_add_parts(Run& run, std::size_t count, Span span) {
  run.combining->count += count;
  if (run.combining->count <= max_combined_parts) return true;
  run.diagnostics.error(span,
                        fmt::format("more than {} parts of '{}'", max_combined_parts, run.combining->keyword),
                        "every ray asks each of them: a mesh may have as many faces as you like");
  run.stopped = true;
  return false;
}

// Once for each place in the text.
void warn_of_nothing(Run& run, std::string_view word, Span header) {
  std::string message = fmt::format("the parts of this '{}' have no place in common", word);
  for (const Diagnostic& told : run.diagnostics.all())
    if (told.span == header && told.message == message) return;
  run.diagnostics.warning(header, std::move(message),
                          "the whole is empty: it is what all of them have in common");
}

}  // namespace

bool may_stand(Run& run, const syntax::ThingItem& thing, const Statement& row) {
  if (!run.combining || row.combines || row.run == run_group) return true;
  run.combining->complete = false;
  const std::string_view whole = run.combining->keyword;
  const bool open = row.read_shape && !row.closed;
  run.diagnostics.error(header(thing),
                        open ? fmt::format("'{}' needs closed shapes: a '{}' is open", whole, row.name)
                             : fmt::format("a '{}' cannot be a part of '{}'", row.name, whole),
                        words_of_parts(run));
  return false;
}

void refuse_of_part(Run& run, Reader& reader, bool given, std::string_view name) {
  if (!run.combining || !given) return;
  run.combining->complete = false;
  const std::string_view whole = run.combining->keyword;
  reader.error(reader.place(name), fmt::format("a part of '{}' has no '{}' of its own", whole, name),
               fmt::format("give it to the '{}'", whole));
}

void add_part(Run& run, const Site& site, Reader& reader, const scene::Shape& shape,
              const ShapePlacement& placement, Span header) {
  refuse_of_part(run, reader, placement.material.given(), "material");
  refuse_of_part(run, reader, !placement.visible, "visible");
  refuse_of_part(run, reader, placement.priority != 0, "priority");
  const auto whole_from_part = placed(reader, site, placement.transform);
  run.combining->complete &= whole_from_part.has_value();
  const shapes::CombinedParts* const inner = shapes::parts_of(shape);
  if (!reader.ok() || !whole_from_part || !may_add_parts(run, inner ? inner->count : 1, header)) return;
  run.combining->parts.emplace_back(shape, *whole_from_part);
}

template <class T>
std::optional<scene::Shape> read_combination(Run& run, Reader& reader, const ShapeSite& at) {
  reader.read<T>();
  Combination made{T::keyword};
  Site inside = at.site;
  inside.world_from_local = {};
  std::unordered_set<std::string> included;
  inside.included = &included;
  const int errors = run.diagnostics.error_count();
  Combination* const outer = std::exchange(run.combining, &made);
  run_inner_block(run, inside, at.block, Parameters::read);
  run.combining = outer;
  if (!made.complete || run.stopped) return std::nullopt;
  if (made.parts.empty()) {
    if (run.diagnostics.error_count() == errors)
      reader.error(
          at.header, fmt::format("this '{}' holds no shape", T::keyword),
          fmt::format("write closed shapes in its braces: {} {{ sphere {{ … }} box {{ … }} }}", T::keyword));
    return std::nullopt;
  }
  T shape;
  shape.parts = std::make_shared<const shapes::CombinedParts>(T::combining, std::move(made.parts));
  if (shape.parts->depth > max_combined_depth) {
    reader.error(at.header, fmt::format("combinations nested more than {} deep", max_combined_depth));
    return std::nullopt;
  }
  if (shape.parts->empty) warn_of_nothing(run, T::keyword, at.header);
  run.written.combinations.push_back({shape.parts, at.header});
  return shape;
}

template std::optional<scene::Shape> read_combination<scene::Difference>(Run&, Reader&, const ShapeSite&);
template std::optional<scene::Shape> read_combination<scene::Intersection>(Run&, Reader&, const ShapeSite&);
template std::optional<scene::Shape> read_combination<scene::Union>(Run&, Reader&, const ShapeSite&);

}  // namespace tyndall::resolve
