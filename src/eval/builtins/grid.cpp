// grid("smoke.vdb", "density"), lookups in what it gives, and bounds(smoke).
#include <fmt/format.h>

#include <cmath>

#include "eval/calls.h"
#include "eval/operators.h"
#include "vm/run/machine.h"

namespace tyndall::eval {

namespace {

constexpr std::pair<std::string_view, Filter> filters[] = {
    {"nearest", Filter::nearest}, {"linear", Filter::linear}, {"cubic", Filter::cubic}};

bool read_filter(CallSite& site, std::size_t i, Filter& filter) {
  if (!site.given[i]) return true;
  bool ok = true;
  const Value value = site.as(Type::string, i, ok);
  if (!ok) return false;
  std::vector<std::string_view> known;
  for (const auto& [word, meaning] : filters) {
    known.push_back(word);
    if (word != value.as_string()) continue;
    filter = meaning;
    return true;
  }
  const std::string guess = did_you_mean(value.as_string(), known);
  site.ev.error(site.spans[i], fmt::format("there is no filter '{}'", value.as_string()),
                guess.empty() ? "filter is nearest, linear or cubic" : guess);
  return false;
}

// The name of one file of a sequence: the marks # stand for the digits of the frame.
std::optional<std::string> file_of_frame(CallSite& site, std::size_t i, const std::string& pattern) {
  const std::size_t first = pattern.find('#');
  const std::size_t count = first == std::string::npos
                                ? 0
                                : std::min(pattern.find_first_not_of('#', first), pattern.size()) - first;
  if (!site.given[i]) {
    if (count == 0) return pattern;
    site.ev.error(site.spans[0], "the name has # for the digits of a frame, but there is no frame",
                  "write grid(\"smoke.####.vdb\", frame: frame)");
    return std::nullopt;
  }
  bool ok = true;
  const Value frame = site.as(Type::number, i, ok);
  if (!ok) return std::nullopt;
  if (count == 0) {
    site.ev.error(site.spans[0], "a file for each frame has # in its name, for the frame's digits",
                  "write grid(\"smoke.####.vdb\", frame: frame)");
    return std::nullopt;
  }
  const double number = frame.as_number();
  if (!frame.known() || number != std::floor(number) || std::fabs(number) > 1e9) {
    site.ev.error(site.spans[i], fmt::format("'frame' wants a whole number, found {}", text_of(frame)),
                  "write frame: frame, or frame: floor(…)");
    return std::nullopt;
  }
  return pattern.substr(0, first) + fmt::format("{:0{}d}", static_cast<long>(number), count) +
         pattern.substr(first + count);
}

// The name of the grid of velocities, and their limit.
bool read_velocity(CallSite& site, Grid& grid) {
  constexpr std::size_t velocity = 4, max_speed = 5;
  bool ok = true;
  if (site.given[velocity]) {
    const Value name = site.as(Type::string, velocity, ok);
    if (!ok) return false;
    grid.velocity = name.as_string();
    if (grid.velocity.empty())
      return site.ev.error(site.spans[velocity], "'velocity' is the name of a grid, found \"\"",
                           "write velocity: \"v\", or leave it out"),
             false;
  }
  if (!site.given[max_speed]) return true;
  const Value speed = site.as(Type::number, max_speed, ok);
  if (!ok) return false;
  grid.max_speed = speed.as_number();
  const bool good = speed.known() && grid.max_speed > 0 && std::isfinite(grid.max_speed);
  if (!good)
    site.ev.error(site.spans[max_speed], fmt::format("'max_speed' must be > 0, found {}", text_of(speed)),
                  "it is in metres of the file a second");
  else if (grid.velocity.empty())
    site.ev.error(site.spans[max_speed], "'max_speed' limits velocities, but there are none",
                  "name their grid: velocity: \"v\"");
  return good && !grid.velocity.empty();
}

Value grid(CallSite& site) {
  bool ok = true;
  const Value file = site.as(Type::string, 0, ok);
  Grid grid;
  grid.span = site.span;
  grid.name = "density";
  Span name_span = site.span;
  if (site.given[1]) {
    const Value name = site.as(Type::string, 1, ok);
    if (ok) grid.name = name.as_string();
    name_span = site.spans[1];
  }
  if (!ok || !read_filter(site, 3, grid.filter) || !read_velocity(site, grid)) return {};
  GridReader* const reader = site.ev.context().grids;
  if (!reader) return site.ev.error(site.span, "grids cannot be read here");
  const std::optional<std::string> name = file_of_frame(site, 2, file.as_string());
  if (!name) return {};
  grid.path = reader->find(*name, site.spans[0], grid.name, name_span, Holding::any);
  if (grid.path.empty()) return {};
  if (!grid.velocity.empty() &&
      reader->find(*name, site.spans[0], grid.velocity, site.spans[4], Holding::vecs).empty())
    return {};
  return Value::of_heavy(Type::grid, std::move(grid));
}

Value bounds(CallSite& site) {
  const Value& value = site.arguments[0];
  const auto* grid = value.get<Grid>();
  if (!grid)
    return site.ev.error(site.spans[0],
                         fmt::format("bounds are those of a grid, found {}", describe(value.type)),
                         "write bounds(smoke), where smoke is grid(\"smoke.vdb\")");
  return Value::of_heavy(Type::shape, GridBounds{*grid});
}

vm::Op op_of(Filter filter) {
  switch (filter) {
    case Filter::nearest:
      return vm::Op::voxels_nearest;
    case Filter::linear:
      return vm::Op::voxels;
    case Filter::cubic:
      return vm::Op::voxels_cubic;
  }
  return vm::Op::voxels;
}

LookedUpAt place_of(Evaluator& ev, const Value& p) {
  if (p.known()) return LookedUpAt::known;
  constexpr vm::Input axes[] = {vm::Input::p_x, vm::Input::p_y, vm::Input::p_z};
  for (std::size_t k = 0; k < 3; ++k)
    if (p.scalars[k].known() || p.scalars[k].node != ev.builder()->input(axes[k]))
      return LookedUpAt::elsewhere;
  return LookedUpAt::p;
}

// What the grid holds at a place of its file's space.
Value value_at(Evaluator& ev, const VoxelGrid& data, Filter filter, const Value& p, Span span) {
  const Value at = transformed(ev, data.voxels_from_local, p, true, span);
  Value result = Value::of(data.components.size() == 1 ? Type::number : Type::vec, {});
  for (std::size_t i = 0; i < data.components.size(); ++i) {
    const VoxelsPointer& voxels = data.components[i];
    if (at.known()) {
      std::array<float, 3> place{};
      for (std::size_t k = 0; k < 3; ++k) place[k] = static_cast<float>(at.scalars[k].value);
      result.scalars[i] =
          Scalar{vm::evaluate_lane(op_of(filter), place, 0, 0, {.planes = {}, .voxels = {voxels}})};
    } else {
      vm::Builder& builder = *ev.builder();
      result.scalars[i] =
          Scalar{0, builder.emit(op_of(filter),
                                 {ev.node(at.scalars[0]), ev.node(at.scalars[1]), ev.node(at.scalars[2])},
                                 span, 0, builder.voxels(voxels))};
    }
  }
  return result;
}

// Where what is at p now was at the time of the frame, which is when the grid was stored: one step back along
// the velocity that was stored with it at p. An error value after an error.
Value carried_back(Evaluator& ev, const Grid& grid, const Value& p, Span span) {
  Context& context = ev.context();
  if (grid.velocity.empty() || !(context.shutter_seconds > 0)) return p;
  if (!ev.builder()) ++context.time_reads;
  const Scalar time = ev.builder() ? Scalar{0, ev.builder()->input(vm::Input::time)} : Scalar{context.time};
  const Scalar since = difference(ev, time, Scalar{context.frame_time}, span);
  const VoxelGridPointer data = context.grids->read_velocity(grid);
  if (!data) return {};
  const Value velocity = value_at(ev, *data, Filter::linear, p, span);
  Value result = Value::of(Type::vec, {});
  for (std::size_t i = 0; i < 3; ++i)
    result.scalars[i] = difference(ev, p.scalars[i], product(ev, velocity.scalars[i], since, span), span);
  return result;
}

}  // namespace

Value look_up(Evaluator& ev, const Grid& grid, const syntax::SyntaxTree& tree, const syntax::CallExpr& call,
              std::string_view name, Span span, const std::shared_ptr<Scope>& scope) {
  const auto arguments = tree.list_of_arguments(call.arguments);
  if (arguments.size() != 1 || arguments[0].name.symbol.valid()) {
    for (const syntax::Argument& argument : arguments) ev.check_names(tree, argument.value, scope);
    return ev.error(span, fmt::format("'{}' is a grid: it takes one place", name),
                    fmt::format("write {}(p), or {}((0, 1, 0))", name, name));
  }
  const Value p = ev.evaluate_as(Type::vec, tree, arguments[0].value, scope, "the place in a grid");
  if (p.is_error()) return {};
  const VoxelGridPointer data = ev.context().grids->read(grid, place_of(ev, p));
  if (!data) return {};
  const Value then = carried_back(ev, grid, p, span);
  return then.is_error() ? Value{} : value_at(ev, *data, grid.filter, then, span);
}

Handlers grid_handler(std::string_view name) {
  if (name == "grid") return {grid};
  if (name == "bounds") return {bounds};
  return {};
}

}  // namespace tyndall::eval
