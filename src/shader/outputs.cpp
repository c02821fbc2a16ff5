// The outputs that a body sets.
#include "shader/outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.h"

namespace tyndall::shader {

using eval::Value;

// What the renderer takes for infinite.
constexpr double largest = scene::largest_coefficient;

// The way out of a share that is too large: colours that count to 255, percents without their sign.
static std::string help_for_share(const OutputRule& rule, const Value& value) {
  if (rule.lowest != 0 || rule.highest != 1 || !value.known()) return {};
  std::array<double, 3> parts{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(value.width()); ++i) {
    parts[i] = value.scalars[i].value;
    if (parts[i] < 0 || parts[i] > 255) return {};
  }
  if (value.type == eval::Type::vec)
    return fmt::format(
        "a colour that counts to 255 is written #{:02x}{:02x}{:02x}, and (r, g, b) counts to 1",
        std::lround(parts[0]), std::lround(parts[1]), std::lround(parts[2]));
  return parts[0] <= 100 ? fmt::format("{0} percent is written {0}%", eval::text_of(value)) : std::string{};
}

// Reports a known number that the rule does not allow.
static bool in_range(eval::Evaluator& evaluator, const OutputRule& rule, const Value& value, Span span) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(value.width()); ++i) {
    const eval::Scalar& s = value.scalars[i];
    if (!s.known()) continue;
    if (!std::isfinite(s.value)) {
      const bool infinite = std::isinf(s.value);
      evaluator.error(span, fmt::format("'{}' is not a finite number here", rule.name),
                      infinite ? "look for a division by zero"
                               : "look for 0/0, or a root or logarithm of a negative number");
      return false;
    }
    if (s.value >= rule.lowest && s.value <= rule.highest && std::abs(s.value) <= largest) continue;
    if (s.value > largest) {
      evaluator.error(span, fmt::format("'{}' must be at most {}, found {}", rule.name, largest, s.value));
      return false;
    }
    evaluator.error(span,
                    fmt::format("'{}' must be {}, found {}", rule.name, rule.range,
                                value.known() ? eval::text_of(value) : eval::text_of(Value::number(s.value))),
                    help_for_share(rule, value));
    return false;
  }
  return true;
}

namespace {

std::vector<std::string_view> names_of(std::span<const OutputRule> rules) {
  std::vector<std::string_view> names;
  for (const OutputRule& rule : rules) names.push_back(rule.name);
  return names;
}

// Reports what a block sets that is no output, nor a variable of the body.
void check_block(eval::Evaluator& ev, const syntax::SyntaxTree& tree, syntax::BlockId block,
                 const eval::Evaluator::Outputs& outputs, std::vector<std::string_view>& variables) {
  const std::size_t outside = variables.size();
  for (const syntax::ItemId id : tree.list_of_items(tree[block].items)) {
    const auto& node = tree[id].node;
    if (const auto* var = std::get_if<syntax::VarItem>(&node)) variables.push_back(ev.text(var->name.symbol));
    if (const auto* loop = std::get_if<syntax::ForItem>(&node))
      check_block(ev, tree, loop->body, outputs, variables);
    if (const auto* choice = std::get_if<syntax::IfItem>(&node)) {
      check_block(ev, tree, choice->then_block, outputs, variables);
      if (choice->else_block.valid()) check_block(ev, tree, choice->else_block, outputs, variables);
    }
    const auto* assign = std::get_if<syntax::AssignItem>(&node);
    if (!assign) continue;
    const auto is = [&](std::string_view name) { return name == ev.text(assign->name.symbol); };
    if (std::none_of(variables.begin(), variables.end(), is) &&
        std::none_of(outputs.names.begin(), outputs.names.end(), is))
      ev.report_no_output(outputs, assign->name, variables);
  }
  variables.resize(outside);
}

}  // namespace

void check_outputs(eval::Context& context, const syntax::SyntaxTree& tree, syntax::BlockId body,
                   syntax::BodyKind kind, std::string_view name) {
  eval::Evaluator ev(context);
  eval::Evaluator::Outputs outputs;
  outputs.owner = name;
  outputs.names = names_of(kind == syntax::BodyKind::medium ? medium_outputs() : material_outputs());
  std::vector<std::string_view> variables;
  check_block(ev, tree, body, outputs, variables);
}

std::vector<std::optional<Output>> run_body(eval::Evaluator& evaluator, const eval::Body& body,
                                            std::span<const OutputRule> rules, bool& failed) {
  auto scope = std::make_shared<eval::Scope>();
  scope->parent = body.scope;
  return run_body(evaluator, body, scope, rules, failed);
}

std::vector<std::optional<Output>> run_body(eval::Evaluator& evaluator, const eval::Body& body,
                                            const std::shared_ptr<eval::Scope>& scope,
                                            std::span<const OutputRule> rules, bool& failed) {
  std::vector<std::optional<Output>> outputs(rules.size());
  const int errors = evaluator.errors_reported();
  eval::Evaluator::Outputs settable;
  settable.owner = body.name;
  settable.names = names_of(rules);
  const auto rule_of = [&](const syntax::AssignItem& assign) {
    const std::string_view name = evaluator.text(assign.name.symbol);
    const auto rule =
        std::find_if(rules.begin(), rules.end(), [&](const OutputRule& r) { return r.name == name; });
    CHECK(rule != rules.end());
    return static_cast<std::size_t>(rule - rules.begin());
  };
  settable.read = [&](const syntax::AssignItem& assign, const Value& value) {
    const OutputRule& rule = rules[rule_of(assign)];
    const Span span = body.tree->exprs[assign.value.index].span;
    const Value converted =
        evaluator.convert(rule.type, value, span, fmt::format("'{}'", rule.name), rule.widens);
    if (converted.width() > 0) in_range(evaluator, rule, converted, span);
    return converted;
  };
  settable.assign = [&](const syntax::Item& item, const syntax::AssignItem& assign, const Value& value,
                        const eval::Evaluator::Branches& branches) {
    const std::string_view name = evaluator.text(assign.name.symbol);
    std::optional<Output>& output = outputs[rule_of(assign)];
    if (output) {
      evaluator.error(assign.name.span, fmt::format("'{}' is set twice", name),
                      "gather the value in a var and set the output once",
                      {{output->span, "the first is here"}});
      return;
    }
    output = Output{value, item.span, branches};
  };
  evaluator.run_steps(*body.tree, body.block, scope, &settable);
  // An output may also be poisoned by a mistake that was reported elsewhere.
  failed |= evaluator.errors_reported() > errors;
  for (const std::optional<Output>& output : outputs) failed |= output && output->value.is_error();
  return outputs;
}

scene::LatticePlaces lattice_places_of(const vm::Builder& builder, std::span<const vm::NodeId> outputs) {
  scene::LatticePlaces out;
  std::vector<vm::NodeId> nodes;
  for (const vm::Builder::LatticeField& field : builder.lattice_fields(outputs)) {
    const std::string_view op = vm::op_info(field.op).name;
    out.fields.push_back(
        {std::string(op.substr(0, op.find_first_of("34"))), field.span, nodes.size(), field.place.size()});
    nodes.insert(nodes.end(), field.place.begin(), field.place.end());
  }
  if (nodes.empty()) return {};
  const auto program = builder.finish(nodes);
  if (!program) return {};
  out.program = *program;
  return out;
}

std::uint8_t OutputList::index(const eval::Scalar& scalar, Span span) {
  const vm::NodeId node = evaluator_.node(scalar);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i] == node && (sharing_ == Sharing::any || spans[i] == span))
      return static_cast<std::uint8_t>(i);
  nodes.push_back(node);
  spans.push_back(span);
  return static_cast<std::uint8_t>(nodes.size() - 1);
}

std::array<std::uint8_t, 3> OutputList::indices(const std::array<eval::Scalar, 3>& scalars, Span span) {
  return {index(scalars[0], span), index(scalars[1], span), index(scalars[2], span)};
}

}  // namespace tyndall::shader
