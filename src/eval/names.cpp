// The table of the language's own names.
#include "eval/names.h"

#include "base/check.h"
#include "eval/calls.h"

namespace tyndall::eval {

static Handlers handlers_of(const vm::Builtin& row) {
  switch (row.shape) {
    case vm::Shape::componentwise:
      return {call_componentwise};
    case vm::Shape::angle_to_number:
      return {call_angle_to_number};
    case vm::Shape::number_to_angle:
      return {call_number_to_angle};
    case vm::Shape::length:
      return {call_length};
    case vm::Shape::field:
      return {call_field};
    case vm::Shape::vector_field:
      return {call_vector_field};
    case vm::Shape::custom:
      break;
  }
  for (const auto find :
       {vector_handler, transform_handler, phase_handler, keys_handler, image_handler, grid_handler,
        list_handler, solid_handler, field_handler, sky_handler, print_handler})
    if (const Handlers handlers = find(row.name); handlers.bound || handlers.free) return handlers;
  return {};
}

Names::Names(syntax::Symbols& symbols) {
  const auto place = [](auto& table, syntax::SymbolId symbol, auto value) {
    if (table.size() <= symbol.index) table.resize(symbol.index + 1);
    table[symbol.index] = value;
  };
  constexpr std::pair<std::string_view, Special> words[] = {
      {"time", Special::time}, {"frame", Special::frame}, {"pi", Special::pi}, {"p", Special::p},
      {"P", Special::P},       {"n", Special::n},         {"N", Special::N},   {"uv", Special::uv}};
  for (const auto& [word, special] : words) place(specials, symbols.intern(word), special);
  ease = symbols.intern("ease");
  filter = symbols.intern("filter");
  nearest = symbols.intern("nearest");
  linear = symbols.intern("linear");
  cubic = symbols.intern("cubic");
  encoding = symbols.intern("encoding");
  srgb = symbols.intern("srgb");
  automatic = symbols.intern("auto");
  step = symbols.intern("step");
  adaptive = symbols.intern("adaptive");
  multiple_scattering = symbols.intern("multiple_scattering");
  full = symbols.intern("full");
  approximate = symbols.intern("approximate");
  clamp = symbols.intern("clamp");
  off = symbols.intern("off");
  for (const auto rows : {vm::builtins(), phase_builtins()})
    for (const vm::Builtin& row : rows) {
      const Handlers handlers = handlers_of(row);
      CHECK(handlers.bound || handlers.free);
      auto entry = std::make_unique<BuiltinEntry>(BuiltinEntry{&row, handlers.bound, handlers.free, {}});
      for (const vm::BuiltinParameter& parameter : row.parameters)
        entry->parameters.push_back(symbols.intern(parameter.name));
      place(builtins_by_symbol, symbols.intern(row.name), static_cast<const BuiltinEntry*>(entry.get()));
      builtins.push_back(std::move(entry));
    }
}

Names::~Names() {
  for (const auto& scope : scopes_with_definitions)
    for (const Binding& binding : scope->bindings) {
      binding.value = {};
      binding.timed = nullptr;
    }
}

}  // namespace tyndall::eval
