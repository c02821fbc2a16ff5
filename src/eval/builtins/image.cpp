// image("wood.exr"), and lookups in what it gives.
#include <fmt/format.h>

#include "eval/calls.h"
#include "eval/operators.h"
#include "vm/run/machine.h"

namespace tyndall::eval {

namespace {

bool read_encoding(CallSite& site, std::string_view word, Image::Encoding& encoding) {
  const bool linear = word == "linear";
  if (linear || word == "srgb") {
    encoding = linear ? Image::Encoding::linear : Image::Encoding::srgb;
    return true;
  }
  const std::string guess = did_you_mean(word, {"srgb", "linear"});
  site.ev.error(site.spans[2], fmt::format("there is no encoding '{}'", word),
                guess.empty() ? "encoding is srgb or linear" : guess);
  return false;
}

Value image(CallSite& site) {
  bool ok = true;
  const Value file = site.as(Type::string, 0, ok);
  Image image;
  image.span = site.span;
  if (site.given[1]) {
    const Value channel = site.as(Type::string, 1, ok);
    if (ok) image.channel = channel.as_string();
  }
  if (site.given[2]) {
    const Value encoding = site.as(Type::string, 2, ok);
    if (ok && !read_encoding(site, encoding.as_string(), image.encoding)) return {};
  }
  if (!ok) return {};
  ImageReader* const reader = site.ev.context().images;
  if (!reader) return site.ev.error(site.span, "pictures cannot be read here");
  const int errors = site.ev.context().diagnostics->error_count();
  image.path = reader->find(file.as_string(), site.spans[0]);
  if (image.path.empty() || site.ev.context().diagnostics->error_count() > errors) return {};
  return Value::of_heavy(Type::image, std::move(image));
}

}  // namespace

Scalar texel_at(Evaluator& ev, const PlanePointer& plane, const Scalar& u, const Scalar& v, Span span) {
  if (u.known() && v.known()) {
    const std::array<float, 2> place{static_cast<float>(u.value), static_cast<float>(v.value)};
    return Scalar{vm::evaluate_lane(vm::Op::plane, place, 0, 0, {.planes = {plane}, .voxels = {}})};
  }
  vm::Builder& builder = *ev.builder();
  return Scalar{0, builder.emit(vm::Op::plane, {ev.node(u), ev.node(v)}, span, 0, builder.plane(plane))};
}

Value look_up(Evaluator& ev, const Image& image, const syntax::SyntaxTree& tree, const syntax::CallExpr& call,
              std::string_view name, Span span, const std::shared_ptr<Scope>& scope) {
  const auto arguments = tree.list_of_arguments(call.arguments);
  if (arguments.size() != 1 || arguments[0].name.symbol.valid()) {
    for (const syntax::Argument& argument : arguments) ev.check_names(tree, argument.value, scope);
    return ev.error(span, fmt::format("'{}' is an image: it takes one pair", name),
                    fmt::format("write {}(uv), or {}((0.5, 0.5)) for its centre", name, name));
  }
  const Value uv = ev.evaluate_as(Type::pair, tree, arguments[0].value, scope, "the place in an image");
  if (uv.is_error()) return {};
  const std::vector<PlanePointer> planes = ev.context().images->planes(image);
  if (planes.empty()) return {};
  Value result = Value::of(planes.size() == 1 ? Type::number : Type::vec, {});
  for (std::size_t i = 0; i < planes.size(); ++i)
    result.scalars[i] = product(ev, texel_at(ev, planes[i], uv.scalars[0], uv.scalars[1], span),
                                Scalar{image.factor[i]}, span);
  return result;
}

Value scaled_image(Evaluator& ev, const Value& image, const Value& factor, Span span) {
  if (!is_numeric(factor.type) || factor.type == Type::pair || !factor.known() ||
      factor.unit != syntax::Unit::none)
    return ev.error(span, "an image is multiplied by a known number or colour",
                    "or multiply what it gives: 0.5 * wood(uv)");
  Image result = *image.get<Image>();
  result.factor = result.factor * widened(Type::vec, factor).as_vec();
  return Value::of_heavy(Type::image, std::move(result));
}

Handlers image_handler(std::string_view name) {
  if (name == "image") return {image};
  return {};
}

}  // namespace tyndall::eval
