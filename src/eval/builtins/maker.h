// Values made of operations (internal to the built-ins).
#pragma once

#include "eval/calls.h"

namespace tyndall::eval {

// Short names for the operations that these built-ins are made of.
struct Maker {
  Evaluator& ev;
  Span span;

  Scalar op(vm::Op o, std::initializer_list<Scalar> operands) const { return ev.emit(o, operands, span); }
  Scalar add(const Scalar& a, const Scalar& b) const { return op(vm::Op::add, {a, b}); }
  Scalar sub(const Scalar& a, const Scalar& b) const { return op(vm::Op::sub, {a, b}); }
  Scalar mul(const Scalar& a, const Scalar& b) const { return op(vm::Op::mul, {a, b}); }
  Scalar div(const Scalar& a, const Scalar& b) const { return op(vm::Op::div, {a, b}); }
  Scalar min(const Scalar& a, const Scalar& b) const { return op(vm::Op::min, {a, b}); }
  Scalar max(const Scalar& a, const Scalar& b) const { return op(vm::Op::max, {a, b}); }

  Scalar dot(const Value& a, const Value& b) const {
    Scalar result = mul(a.scalars[0], b.scalars[0]);
    for (std::size_t i = 1; i < static_cast<std::size_t>(a.width()); ++i)
      result = add(result, mul(a.scalars[i], b.scalars[i]));
    return result;
  }
  Value subtract(const Value& a, const Value& b) const {
    Value result = a;
    for (std::size_t i = 0; i < static_cast<std::size_t>(a.width()); ++i)
      result.scalars[i] = sub(a.scalars[i], b.scalars[i]);
    return result;
  }
  Value scaled(const Value& v, const Scalar& s) const {
    Value result = v;
    for (std::size_t i = 0; i < static_cast<std::size_t>(v.width()); ++i)
      result.scalars[i] = mul(v.scalars[i], s);
    return result;
  }
  Scalar length(const Value& v) const {
    if (v.type == Type::pair) return op(vm::Op::length2, {v.scalars[0], v.scalars[1]});
    return op(vm::Op::length3, {v.scalars[0], v.scalars[1], v.scalars[2]});
  }
};

inline Value number(const Scalar& s) { return Value::of(Type::number, {s}); }
inline Maker maker(CallSite& site) { return {site.ev, site.span}; }

}  // namespace tyndall::eval
