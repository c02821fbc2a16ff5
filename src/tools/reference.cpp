#include "tools/reference.h"

#include <fmt/format.h>

#include <tuple>
#include <variant>

#include "eval/names.h"
#include "generate/generated.h"
#include "resolve/reading/parameters.h"
#include "shader/material_outputs.h"

namespace tyndall::tools {

namespace {

// A default as it would be written; empty where there is none to write.
std::string shown(double value) { return fmt::format("{}", value); }
std::string shown(int value) { return fmt::format("{}", value); }
std::string shown(std::uint64_t value) { return fmt::format("{}", value); }
std::string shown(bool value) { return value ? "true" : "false"; }
std::string shown(const image::Exposure& value) { return describe(value); }
std::string shown(image::Tonemap value) { return std::string(describe(value)); }
std::string shown(const scene::Step& value) { return scene::describe(value); }
std::string shown(const scene::MultipleScattering& value) { return scene::describe(value); }
std::string shown(const scene::Clamp& value) { return scene::describe(value); }
std::string shown(Angle value) { return fmt::format("{:.4g}deg", value.radians * 180 / 3.14159265358979); }
std::string shown(const scene::ShutterCurve& value) { return scene::describe(value); }
std::string shown(const resolve::ShutterTimes& value) { return shown(value.closes.angle(24)); }
std::string shown(generate::Align value) {
  return std::string(generate::alignments[static_cast<std::size_t>(value)].name);
}
std::string shown(const Vec3d& v) { return fmt::format("({}, {}, {})", v.x, v.y, v.z); }
std::string shown(const scene::Resolution& size) { return fmt::format("({}, {})", size.width, size.height); }
template <class T>
std::string shown(const T&) {
  return {};
}

std::string documentation(const FieldInfo& info) { return std::string(info.documentation); }
std::string documentation(const scene::SettingInfo& info) {
  return fmt::format("{}{}", info.documentation,
                     info.range ? fmt::format(", {} to {}", info.range->least, info.range->most) : "");
}

template <class T>
void add_parameters(std::vector<ReferenceParameter>& out) {
  T::fields([&](auto member, const auto& info) {
    const T given{};
    out.push_back({std::string(info.name), documentation(info), shown(given.*member),
                   info.presence == required, !info.one_of.empty()});
  });
}

// The parameters of a shape as a scene gives them.
template <class T>
struct AsWritten {
  using Type = T;
};
template <>
struct AsWritten<scene::Mesh> {
  using Type = resolve::MeshParameters;
};
template <>
struct AsWritten<scene::Curves> {
  using Type = resolve::CurvesParameters;
};

template <class T>
std::string_view documentation_of() {
  if constexpr (requires { T::documentation; })
    return T::documentation;
  else
    return {};
}

class StatementList {
 public:
  std::vector<ReferenceStatement> list;

  template <class T, class... Others>
  void add(std::string_view documentation = {}, std::string_view after_name = {}) {
    ReferenceStatement statement{fmt::format("{}{}", T::keyword, after_name), std::string(documentation), {}};
    add_parameters<T>(statement.parameters);
    (add_parameters<Others>(statement.parameters), ...);
    list.push_back(std::move(statement));
  }
  // Of a statement that takes a file's name.
  template <class T, class... Others>
  void add_file() {
    add<T, Others...>({}, " \"file\"");
  }
  template <class... Ts, class... Others>
  void add_each(const std::variant<Ts...>*, const std::tuple<Others...>*) {
    (add<typename AsWritten<Ts>::Type, Others...>(documentation_of<Ts>()), ...);
  }
  template <class... Ts>
  void add_lights(const std::variant<Ts...>*) {
    (add_light<Ts>(), ...);
  }

 private:
  template <class T>
  void add_light() {
    if constexpr (std::is_same_v<T, scene::AreaLight>) {
      add_shape_lights(static_cast<const scene::LightShapes*>(nullptr));
      add<resolve::MeshLightParameters, scene::AreaLight, resolve::Placement>();
      add<resolve::SkyLightParameters, resolve::Placement>();
    } else {
      add<T, resolve::Placement>();
    }
  }
  template <class... S>
  void add_shape_lights(const std::variant<S...>*) {
    (add<resolve::LightShapeParameters<S>, scene::AreaLight, resolve::Placement>(), ...);
  }
};

std::vector<ReferenceStatement> made_statements() {
  using namespace resolve;
  StatementList statements;
  statements.add<scene::RenderSettings>();
  statements.add<AnimationParameters>();
  statements.add<scene::TrapezoidCurve>("A value of `shutter_curve`.");
  statements.add_each(static_cast<const scene::Camera*>(nullptr),
                      static_cast<const std::tuple<Placement>*>(nullptr));
  statements.add_lights(static_cast<const scene::Light*>(nullptr));
  statements.add_each(static_cast<const scene::Shape*>(nullptr),
                      static_cast<const std::tuple<ShapePlacement>*>(nullptr));
  statements.add_each(static_cast<const generate::Generated*>(nullptr),
                      static_cast<const std::tuple<ShapePlacement>*>(nullptr));
  statements.add_file<MeshFileParameters>();
  statements.add_file<GltfParameters>();
  statements.add_file<GltfCameraParameters, Placement>();
  statements.add<VolumeParameters>();
  statements.add<GroupParameters>();
  statements.add<PlaceParameters>();
  return std::move(statements.list);
}

std::string call_of(const vm::Builtin& row) {
  std::string call(row.name);
  const char* before = "(";
  for (const vm::BuiltinParameter& parameter : row.parameters) {
    call += before + std::string(parameter.name);
    const bool optional = !parameter.default_value.empty();
    if (parameter.named)
      call += fmt::format(": {}", optional ? parameter.default_value : "…");
    else if (optional)
      call += fmt::format(" = {}", parameter.default_value);
    before = ", ";
  }
  return call + (row.parameters.empty() ? "()" : ")");
}

std::vector<ReferenceOutput> made_outputs(std::span<const shader::OutputRule> rules) {
  std::vector<ReferenceOutput> list;
  for (const shader::OutputRule& rule : rules)
    list.push_back(
        {std::string(rule.name),
         fmt::format("{}{}", rule.documentation,
                     rule.range.empty() || rule.range == "a direction" ? std::string{}
                                                                       : fmt::format(", {}", rule.range)),
         std::string(rule.standard)});
  return list;
}

}  // namespace

const std::vector<ReferenceStatement>& reference_statements() {
  static const std::vector<ReferenceStatement> statements = made_statements();
  return statements;
}

const std::vector<ReferenceFunction>& reference_functions() {
  static const std::vector<ReferenceFunction> functions = [] {
    std::vector<ReferenceFunction> list;
    for (const auto rows : {vm::builtins(), eval::phase_builtins()})
      for (const vm::Builtin& row : rows)
        list.push_back({std::string(row.name), call_of(row), std::string(row.result),
                        std::string(row.documentation), std::string(row.example)});
    return list;
  }();
  return functions;
}

const std::vector<ReferenceOutput>& reference_medium_outputs() {
  static const std::vector<ReferenceOutput> outputs = made_outputs(shader::medium_outputs());
  return outputs;
}

const std::vector<ReferenceOutput>& reference_material_outputs() {
  static const std::vector<ReferenceOutput> outputs = made_outputs(shader::material_outputs());
  return outputs;
}

}  // namespace tyndall::tools
