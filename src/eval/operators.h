// Operators on values: arithmetic, comparisons, choice. Shared by expressions, steps and built-ins.
#pragma once

#include "eval/evaluator.h"

namespace tyndall::eval {

// The places of an operation and of its two operands.
struct OperatorSpans {
  Span whole, left, right;
};

// A unit with its article, for messages: "a length".
std::string_view describe_unit(syntax::Unit unit);

Value negated(Evaluator& evaluator, const Value& value, Span span);
Value inverted(Evaluator& evaluator, const Value& value, Span span);
// Any operator; `and` and `or` of operands that are both evaluated already.
Value binary(Evaluator& evaluator, syntax::BinaryOp op, const Value& a, const Value& b,
             const OperatorSpans& spans);

// condition != 0 ? a : b for a condition that is not known; a number beside a pair or vec widens.
Value select(Evaluator& evaluator, const Scalar& condition, const Value& a, const Value& b, Span span);

// The value's scalars as one of `type`: the same, or a number in every component.
Value widened(Type type, const Value& value);
// The wider of two numeric types; nothing when one is not numeric or they are a pair and a vec.
std::optional<Type> common_type(Type a, Type b);

constexpr bool is_numeric(Type type) {
  return type == Type::number || type == Type::pair || type == Type::vec;
}

// t applied to a point (`translates`) or a direction, known or not.
Value transformed(Evaluator& evaluator, const Transform& t, const Value& v, bool translates, Span span);

// A product of scalars that skips known zeros and ones, and a sum.
Scalar product(Evaluator& evaluator, const Scalar& a, const Scalar& b, Span span);
Scalar sum(Evaluator& evaluator, const Scalar& a, const Scalar& b, Span span);
Scalar difference(Evaluator& evaluator, const Scalar& a, const Scalar& b, Span span);

// An image times a number or colour (builtins_image.cpp).
Value scaled_image(Evaluator& evaluator, const Value& image, const Value& factor, Span span);

// Mixes of phase functions: the lobes of both, weighted 1 - w and w.
Value mixed_phases(Evaluator& evaluator, const Value& a, const Value& b, const Scalar& weight_of_b,
                   Span span);

}  // namespace tyndall::eval
