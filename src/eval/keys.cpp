// Keys of values: see keys.h.
#include "eval/keys.h"

#include <fmt/format.h>

#include <bit>
#include <iterator>

#include "eval/scope.h"

namespace tyndall::eval {

namespace {

// Longer contents are numbered, so that what holds them stays short.
constexpr std::size_t short_key = 64;

void append_number(std::string& key, double number) {
  fmt::format_to(std::back_inserter(key), "{:x},", std::bit_cast<std::uint64_t>(number + 0.0));
}

void append_vec(std::string& key, const Vec3d& v) {
  for (std::size_t i = 0; i < 3; ++i) append_number(key, v[i]);
}

void append_grid(std::string& key, const Grid& grid) {
  fmt::format_to(std::back_inserter(key), "{}:{}{}:{},{},{}:{},", grid.path.size(), grid.path,
                 grid.name.size(), grid.name, static_cast<int>(grid.filter), grid.velocity.size(),
                 grid.velocity);
  append_number(key, grid.max_speed);
}

// A definition and the scope it stands in. Definitions keep their scopes for the whole run (Evaluator::bind),
// so equal addresses are the same scope.
void append_definition(std::string& key, const Span& span, const Scope* scope) {
  fmt::format_to(std::back_inserter(key), "{}:{}@{},", span.source.index, span.begin,
                 fmt::ptr(static_cast<const void*>(scope)));
}

}  // namespace

std::string Keys::shortened(std::string key) {
  if (key.size() <= short_key) return key;
  const auto number = static_cast<std::uint32_t>(numbers_.size());
  return fmt::format("#{}", numbers_.try_emplace(std::move(key), number).first->second);
}

// A string or list: in full when it is short, else by its number, which is looked for once.
void Keys::append_content(std::string& key, const Value& value) {
  if (const auto known = known_.find(value.heavy.get()); known != known_.end()) {
    key += known->second.key;
    return;
  }
  std::string content;
  if (const auto* text = value.get<std::string>()) {
    content = fmt::format("{}:{},", text->size(), *text);
  } else {
    const std::vector<Value>& list = value.as_list();
    content = fmt::format("{}[", list.size());
    for (const Value& element : list) append(content, element);
  }
  const bool numbered = content.size() > short_key;
  content = shortened(std::move(content));
  key += content;
  if (numbered) known_.try_emplace(value.heavy.get(), Known{value.heavy, content});
}

void Keys::append(std::string& key, const Value& value) {
  fmt::format_to(std::back_inserter(key), "{}~", static_cast<int>(value.type));
  for (int i = 0; i < value.width(); ++i)
    append_number(key, value.scalars[static_cast<std::size_t>(i)].value);
  if (!value.heavy) return;
  if (value.type == Type::string || value.type == Type::list) {
    append_content(key, value);
  } else if (const auto* t = value.get<Transform>()) {
    for (const Vec3d& column : {t->x, t->y, t->z, t->t}) append_vec(key, column);
  } else if (const auto* range = value.get<RangeValue>()) {
    append_vec(key, {range->first, range->last, range->step});
    key += range->excludes_last ? '<' : '.';
  } else if (const auto* function = value.get<Function>()) {
    append_definition(key, function->item->span, function->scope.get());
  } else if (const auto* body = value.get<Body>()) {
    key += body->key;
  } else if (const auto* lobes = value.get<std::vector<PhaseLobe>>()) {
    for (const PhaseLobe& lobe : *lobes) {
      key += static_cast<char>('a' + static_cast<int>(lobe.kind));
      for (const Scalar& parameter : lobe.parameters) append_number(key, parameter.value);
      append_number(key, lobe.weight.value);
    }
  } else if (const auto* shape = value.get<ShapeLiteral>()) {
    append_definition(key, shape->span, shape->scope.get());
  } else if (const auto* object = value.get<ObjectDefinition>()) {
    append_definition(key, object->item->name.span, object->scope.get());
  } else if (const auto* image = value.get<Image>()) {
    fmt::format_to(std::back_inserter(key), "{}:{}:{},{},", image->path.size(), image->path, image->channel,
                   static_cast<int>(image->encoding));
    append_vec(key, image->factor);
  } else if (const auto* grid = value.get<Grid>()) {
    append_grid(key, *grid);
  } else if (const auto* bounds = value.get<GridBounds>()) {
    append_grid(key, bounds->grid);
  }
}

}  // namespace tyndall::eval
