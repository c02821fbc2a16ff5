#include "import/pbr/material_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "import/malformed.h"
#include "vm/builder/builder.h"

namespace tyndall::pbr {

namespace {

using image::Encoding;
using vm::Input;
using vm::NodeId;
using vm::Op;
using Color = std::array<NodeId, 3>;

class MaterialProgram {
 public:
  MaterialProgram(const Material& material, Textures& textures, bool colors, Span span)
      : m_(material), textures_(textures), colors_(colors), span_(span) {}

  scene::Material result() {
    scene::Material out;
    out.name = m_.name;
    out.definition = span_;
    const Color base = base_color();
    if (m_.unlit) {
      const NodeId black = constant(0);
      out.base_color = color({black, black, black}, "base_color", 1);
      out.emission = color(base, "emission", scene::largest_coefficient);
    } else {
      out.base_color = color(base, "base_color", 1);
      layers(out);
      if (!is_black(m_.emissive))
        out.emission = color(times(m_.emissive, m_.emissive_texture), "emission", scene::largest_coefficient);
    }
    out.opacity = unless(opacity(), 1, "opacity");
    if (m_.normal_texture && !m_.unlit) out.normal = color(mapped_normal(), "normal", infinity, -infinity);
    auto program = builder_.finish(outputs_);
    if (!program)
      throw Malformed{"materials", fmt::format("hold '{}', which is too large to compile", m_.name)};
    out.program = std::move(*program);
    out.given = std::move(given_);
    return out;
  }

 private:
  void layers(scene::Material& out) {
    NodeId metallic = constant(m_.metallic), roughness = constant(m_.roughness);
    if (const auto& texture = m_.metallic_roughness_texture) {
      metallic = multiply(metallic, channel(*texture, 2, Encoding::linear));
      roughness = multiply(roughness, channel(*texture, 1, Encoding::linear));
    }
    out.metallic = unless(metallic, 0, "metallic");
    out.roughness = output(roughness, "roughness", 0, 1);
    out.specular = unless(scalar(m_.specular, m_.specular_texture, 3), 0, "specular");
    out.transmission = unless(scalar(m_.transmission, m_.transmission_texture, 0), 0, "transmission");
    if (!(m_.specular_color == Rgb(1.0f)) || m_.specular_color_texture)
      out.specular_color = color(times(m_.specular_color, m_.specular_color_texture), "specular_color",
                                 scene::largest_coefficient);
    out.coat = unless(scalar(m_.coat, m_.coat_texture, 0), 0, "coat");
    if (out.coat) coat_roughness(out);
    if (m_.ior != 1.5f) out.ior = output(constant(m_.ior), "ior", 1, 1000);
    if (!is_black(m_.sheen)) out.sheen = color(times(m_.sheen, m_.sheen_texture), "sheen", 1);
  }

  // A polished lacquer is nearly polished here.
  void coat_roughness(scene::Material& out) {
    const NodeId given = scalar(m_.coat_roughness, m_.coat_roughness_texture, 1);
    const NodeId roughness = emit(Op::max, {given, constant(optics::nearly_polished)});
    out.coat_roughness = unless(roughness, optics::nearly_polished, "coat_roughness");
  }

  Color base_color() {
    Color c = times(m_.base_color, m_.base_texture);
    if (!colors_) return c;
    const std::array<Input, 3> of_mesh{Input::red, Input::green, Input::blue};
    for (std::size_t k = 0; k < 3; ++k)
      c[k] = emit(Op::saturate, {multiply(c[k], builder_.input(of_mesh[k]))});
    return c;
  }

  NodeId opacity() {
    if (m_.alpha_mode == Material::Alpha::opaque) return constant(1);
    NodeId alpha = scalar(m_.alpha, m_.base_texture, 3, Encoding::srgb);
    if (colors_) alpha = emit(Op::saturate, {multiply(alpha, builder_.input(Input::alpha))});
    return m_.alpha_mode == Material::Alpha::mask ? emit(Op::step, {constant(m_.cutoff), alpha}) : alpha;
  }

  // From the space of the tangent, the bitangent and the normal.
  Color mapped_normal() {
    const std::array<Input, 3> n_input{Input::n_x, Input::n_y, Input::n_z},
        t_input{Input::t_x, Input::t_y, Input::t_z};
    Color n, t, map;
    const std::array<float, 3> scale{m_.normal_scale, m_.normal_scale, 1};
    for (std::size_t k = 0; k < 3; ++k) {
      n[k] = builder_.input(n_input[k]);
      t[k] = builder_.input(t_input[k]);
      const NodeId texel = channel(*m_.normal_texture, k, Encoding::linear);
      map[k] = multiply(constant(scale[k]), emit(Op::sub, {multiply(constant(2), texel), constant(1)}));
    }
    const NodeId sign = builder_.input(Input::t_sign);
    Color out;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      const NodeId bitangent = multiply(sign, emit(Op::sub, {multiply(n[i], t[j]), multiply(n[j], t[i])}));
      out[k] = add(add(multiply(map[0], t[k]), multiply(map[1], bitangent)), multiply(map[2], n[k]));
    }
    return out;
  }

  // A texel of a picture, 1 where it does not have the channel.
  NodeId channel(const Texture& texture, std::size_t which, Encoding encoding) {
    const PlanePointer& plane = textures_.channels(texture.image, encoding)[which];
    if (!plane) return constant(1);
    const auto [u, v] = place(texture, *plane);
    return builder_.emit(Op::plane, {u, v}, span_, 0, builder_.plane(plane));
  }

  // Where a picture is looked up, v running up.
  Pair<NodeId> place(const Texture& texture, const Plane& plane) {
    const bool first = texture.uv_set == 0;
    NodeId u = builder_.input(first ? Input::u : Input::second_u);
    NodeId v = builder_.input(first ? Input::v : Input::second_v);
    if (texture.rotation != 0 || texture.offset != Pair<double>{0, 0} ||
        texture.scale != Pair<double>{1, 1}) {
      const double c = std::cos(texture.rotation), s = std::sin(texture.rotation);
      const auto number = [&](double x) { return constant(static_cast<float>(x)); };
      const NodeId down = emit(Op::sub, {constant(1), v});
      const NodeId across =
          add(multiply(number(c * texture.scale.x), u), multiply(number(s * texture.scale.y), down));
      const NodeId along =
          add(multiply(number(-s * texture.scale.x), u), multiply(number(c * texture.scale.y), down));
      u = add(across, number(texture.offset.x));
      v = emit(Op::sub, {number(1 - texture.offset.y), along});
    }
    return {wrapped(u, texture.wrap_u, texture.nearest, plane.width),
            wrapped(v, texture.wrap_v, texture.nearest, plane.height)};
  }

  // A coordinate as the operation takes it, which repeats and goes linearly between the middles of texels.
  NodeId wrapped(NodeId x, Wrap wrap, bool nearest, int texels) {
    const auto n = static_cast<float>(texels);
    if (wrap == Wrap::mirror) {
      const NodeId round = emit(Op::mod, {x, constant(2)});
      x = emit(Op::sub, {constant(1), emit(Op::abs, {emit(Op::sub, {constant(1), round})})});
    }
    if (nearest)
      x = multiply(add(emit(Op::floor, {multiply(x, constant(n))}), constant(0.5f)), constant(1 / n));
    if (wrap != Wrap::repeat) x = emit(Op::clamp, {x, constant(0.5f / n), constant(1 - 0.5f / n)});
    return x;
  }

  Color times(const Rgb& factor, const std::optional<Texture>& texture) {
    Color out;
    for (std::size_t k = 0; k < 3; ++k) {
      out[k] = constant(factor[k]);
      if (texture) out[k] = multiply(out[k], channel(*texture, k, Encoding::srgb));
    }
    return out;
  }
  NodeId scalar(float factor, const std::optional<Texture>& texture, std::size_t which,
                Encoding encoding = Encoding::linear) {
    return texture && factor > 0 ? multiply(constant(factor), channel(*texture, which, encoding))
                                 : constant(factor);
  }

  NodeId constant(float value) { return builder_.constant(value); }
  NodeId emit(Op op, std::initializer_list<NodeId> operands) { return builder_.emit(op, operands, span_); }
  NodeId multiply(NodeId a, NodeId b) { return emit(Op::mul, {a, b}); }
  NodeId add(NodeId a, NodeId b) { return emit(Op::add, {a, b}); }

  std::uint8_t output(NodeId node, std::string_view name, double lowest, double highest) {
    outputs_.push_back(node);
    given_.push_back({fmt::format("{} of '{}'", name, m_.name), span_, lowest, highest});
    return static_cast<std::uint8_t>(outputs_.size() - 1);
  }
  scene::RgbOutputs color(const Color& c, std::string_view name, double highest, double lowest = 0) {
    return {output(c[0], name, lowest, highest), output(c[1], name, lowest, highest),
            output(c[2], name, lowest, highest)};
  }
  // No output where the number is the one that stands for it anyway.
  std::optional<std::uint8_t> unless(NodeId node, float standard, std::string_view name) {
    if (builder_.is_constant(node) && builder_.constant_value(node) == standard) return std::nullopt;
    return output(node, name, 0, 1);
  }

  const Material& m_;
  Textures& textures_;
  bool colors_;
  Span span_;
  vm::Builder builder_;
  std::vector<NodeId> outputs_;
  std::vector<scene::GivenNumber> given_;
};

}  // namespace

scene::Material compiled(const Material& material, Textures& textures, bool colors, Span span) {
  return MaterialProgram(material, textures, colors, span).result();
}

std::optional<scene::ConstantMedium> inside_of(const Material& m) {
  if (!m.volume || !(m.transmission > 0) || m.attenuation_color == Rgb(1.0f) ||
      std::isinf(m.attenuation_distance))
    return std::nullopt;
  constexpr double least = 1e-4;  // what is left of a channel that a file calls black
  scene::ConstantMedium medium;
  for (std::size_t k = 0; k < 3; ++k) {
    const double left = std::clamp(double{m.attenuation_color[k]}, least, 1.0);
    medium.sigma_t[k] = static_cast<float>(-std::log(left) / m.attenuation_distance);
  }
  return medium;
}

}  // namespace tyndall::pbr
