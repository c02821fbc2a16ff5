// The outputs that a body sets.
#include "shader/outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tyndall::shader {

using eval::Value;

// Reports a known number that the rule does not allow.
static bool in_range(eval::Evaluator& evaluator, const OutputRule& rule, const Value& value, Span span) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(value.width()); ++i) {
    const eval::Scalar& s = value.scalars[i];
    if (!s.known()) continue;
    if (!std::isfinite(s.value)) {
      evaluator.error(span, fmt::format("'{}' is not a finite number here", rule.name),
                      "look for a division by zero");
      return false;
    }
    if (s.value >= rule.lowest && s.value <= rule.highest) continue;
    evaluator.error(
        span, fmt::format("'{}' must be {}, found {}", rule.name, rule.range,
                          value.known() ? eval::text_of(value) : eval::text_of(Value::number(s.value))));
    return false;
  }
  return true;
}

std::vector<std::optional<Output>> run_body(eval::Evaluator& evaluator, const eval::Body& body,
                                            std::span<const OutputRule> rules, bool& failed) {
  std::vector<std::optional<Output>> outputs(rules.size());
  const int errors = evaluator.errors_reported();
  const auto set = [&](const syntax::Item& item, const syntax::AssignItem& assign, const Value& value) {
    const std::string_view name = evaluator.text(assign.name.symbol);
    const auto rule =
        std::find_if(rules.begin(), rules.end(), [&](const OutputRule& r) { return r.name == name; });
    if (rule == rules.end()) {
      std::vector<std::string_view> names;
      for (const OutputRule& r : rules) names.push_back(r.name);
      const std::string guess = did_you_mean(name, names);
      evaluator.error(assign.name.span, fmt::format("'{}' has no output '{}'", body.name, name),
                      guess.empty() ? fmt::format("outputs are {}; let {} = … defines a name",
                                                  fmt::join(names, ", "), name)
                                    : guess);
      return;
    }
    std::optional<Output>& output = outputs[static_cast<std::size_t>(rule - rules.begin())];
    if (output) {
      evaluator.error(assign.name.span, fmt::format("'{}' is set twice", name),
                      "gather the value in a var and set the output once",
                      {{output->span, "the first is here"}});
      return;
    }
    const Span span = body.tree->exprs[assign.value.index].span;
    const Value converted =
        evaluator.convert(rule->type, value, span, fmt::format("'{}'", name), rule->widens);
    if (converted.width() > 0) in_range(evaluator, *rule, converted, span);
    output = Output{converted, item.span};
  };
  auto scope = std::make_shared<eval::Scope>();
  scope->parent = body.scope;
  evaluator.run_steps(*body.tree, body.block, scope, set);
  // An output may also be poisoned by a mistake that was reported elsewhere.
  failed |= evaluator.errors_reported() > errors;
  for (const std::optional<Output>& output : outputs) failed |= output && output->value.is_error();
  return outputs;
}

std::uint8_t OutputList::index(const eval::Scalar& scalar, Span span) {
  const vm::NodeId node = evaluator_.node(scalar);
  const auto found = std::find(nodes.begin(), nodes.end(), node);
  if (found != nodes.end()) return static_cast<std::uint8_t>(found - nodes.begin());
  nodes.push_back(node);
  spans.push_back(span);
  return static_cast<std::uint8_t>(nodes.size() - 1);
}

std::array<std::uint8_t, 3> OutputList::indices(const std::array<eval::Scalar, 3>& scalars, Span span) {
  return {index(scalars[0], span), index(scalars[1], span), index(scalars[2], span)};
}

}  // namespace tyndall::shader
