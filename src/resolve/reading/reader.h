// Reads the parameters of a thing's block into structs that state them in fields() (base/fields.h).
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <variant>
#include <vector>

#include "base/diagnostics.h"
#include "base/fields.h"
#include "eval/evaluator.h"
#include "generate/generated.h"
#include "resolve/reading/parameters.h"
#include "resolve/reading/statement_table.h"
#include "scene/scene.h"
#include "scene/validate.h"
#include "syntax/tree.h"

namespace tyndall::resolve {

// The interned names of T's fields, in order: names are compared as numbers.
template <class T>
struct Schema {
  explicit Schema(syntax::Symbols& symbols) {
    T::fields([&](auto, const FieldInfo& info) { names.push_back(symbols.intern(info.name)); });
  }
  std::vector<syntax::SymbolId> names;
};

// One schema for each struct that is read.
template <class... T>
struct SchemasOf {
  explicit SchemasOf(syntax::Symbols& symbols) : all(Schema<T>(symbols)...) {}
  template <class U>
  const Schema<U>& of() const {
    return std::get<Schema<U>>(all);
  }
  std::tuple<Schema<T>...> all;
};
// With the alternatives of a variant, each as it is or as the parameters of a light of that shape.
template <class Schemas, class Variant>
struct WithAlternatives;
template <class... T, class... U>
struct WithAlternatives<SchemasOf<T...>, std::variant<U...>> {
  using Type = SchemasOf<T..., U...>;
  using AsLights = SchemasOf<T..., LightShapeParameters<U>...>;
};
using SchemasBesideFamilies =
    SchemasOf<scene::RenderSettings, AnimationParameters, MeshParameters, CurvesParameters,
              MeshLightParameters, SkyLightParameters, ShapePlacement, Placement, VolumeParameters,
              GroupParameters, PlaceParameters, GltfParameters, GltfShapeParameters, GltfCameraParameters,
              MeshFileParameters, MeshFileShapeParameters, scene::PerspectiveCamera,
              scene::OrthographicCamera, scene::SphericalCamera>;
using SchemasOfGenerated = WithAlternatives<SchemasBesideFamilies, generate::Generated>::Type;
using SchemasOfShapes = WithAlternatives<SchemasOfGenerated, scene::Shape>::Type;
using Schemas =
    WithAlternatives<WithAlternatives<SchemasOfShapes, scene::Light>::Type, scene::LightShapes>::AsLights;

// As in messages: "a length".
std::string_view unit_name(syntax::Unit unit);

// The text a block belongs to, the names in force where its values stand, and the table that tells where a
// parameter belongs that is given in the wrong block.
struct ReaderSite {
  const syntax::SyntaxTree* tree = nullptr;
  const std::shared_ptr<eval::Scope>* scope = nullptr;
  const Statements* statements = nullptr;
};

// The message for a parameter that a thing does not have.
std::string no_parameter(std::string_view name, std::string_view keyword);

// The parameters of one block: read<T>() takes those of T, finish() reports what nothing took.
class Reader {
 public:
  // What else may stand in the block: nothing, or (group) statements, which are left alone.
  enum class Others : bool { refused, allowed };

  // `keyword` names the thing in messages; `header` is the place of its word.
  Reader(eval::Evaluator& evaluator, const Schemas& schemas, ReaderSite site, syntax::BlockId block,
         std::string_view keyword, Span header, Others others = Others::refused);

  // The struct, with defaults for what is not given or was wrong (see ok()).
  template <class T>
  T read();
  // The same; finish() shows the problems of scene::validate at their parameters.
  template <class T>
  T read_valid();

  // Reports what nothing took, and what is missing: a name that resembles a missing one is taken for it, and
  // reported alone. `hint` is shown when no name resembles it. `outer` reads the block around, which may be
  // meant.
  void finish(std::string_view hint = {}, Reader* outer = nullptr);
  // Shows problems at their parameters (at the header when the parameter was not given).
  void report(const scene::Problems& problems);

  // Whether all that was read is there and right.
  bool ok() const { return ok_ && missing_.empty(); }
  // A required parameter is not missing: what it would say is known otherwise.
  void settle(std::string_view name);
  // The place of a parameter's value, or of the header.
  Span place(std::string_view field) const;
  void error(Span span, std::string message, std::string help = {});
  // Something is wrong with a value, which has been told.
  void refuse() { ok_ = false; }

 private:
  struct Given {
    const syntax::ParameterItem* item;
    bool taken;
  };
  Given* find(syntax::SymbolId name) {
    constexpr std::size_t few = 16;  // are looked through faster than a table is asked
    if (given_.size() <= few) {
      for (Given& given : given_)
        if (given.item->name.symbol == name) return &given;
      return nullptr;
    }
    for (std::size_t i = places_.size(); i < given_.size(); ++i) places_[given_[i].item->name.symbol] = i;
    const auto found = places_.find(name);
    return found == places_.end() ? nullptr : &given_[found->second];
  }
  Span value_span(const Given& given) const { return (*site_.tree)[given.item->value].span; }
  eval::Value evaluate(eval::Type type, const FieldInfo& info, const Given& given);
  void to_color(const FieldInfo& info, const eval::Value& value, Span span, std::string_view wanted_type,
                Rgb& to);
  void error_unit(const FieldInfo& info, const eval::Value& value, Span span);

  void read_value(const FieldInfo& info, const Given& given, double& to);
  void read_value(const FieldInfo& info, const Given& given, int& to);
  void read_value(const FieldInfo& info, const Given& given, std::uint64_t& to);
  void read_value(const FieldInfo& info, const Given& given, bool& to);
  void read_value(const FieldInfo& info, const Given& given, Angle& to);
  void read_value(const FieldInfo& info, const Given& given, Vec3d& to);
  void read_value(const FieldInfo& info, const Given& given, Rgb& to);
  void read_value(const FieldInfo& info, const Given& given, optics::SkyRadiance& to);
  void read_value(const FieldInfo& info, const Given& given, scene::Resolution& to);
  void read_value(const FieldInfo& info, const Given& given, Transform& to);
  void read_value(const FieldInfo& info, const Given& given, eval::RangeValue& to);
  // Values with words of their own (reader_choices.cpp).
  void read_value(const FieldInfo& info, const Given& given, scene::Step& to);
  void read_value(const FieldInfo& info, const Given& given, scene::MultipleScattering& to);
  void read_value(const FieldInfo& info, const Given& given, scene::ShutterCurve& to);
  void read_value(const FieldInfo& info, const Given& given, scene::Clamp& to);
  void read_limit(const FieldInfo& info, syntax::ExprId written, double& to);
  void read_value(const FieldInfo& info, const Given& given, ShutterTimes& to);
  void read_value(const FieldInfo& info, const Given& given, image::Exposure& to);
  void read_value(const FieldInfo& info, const Given& given, image::Tonemap& to);
  void read_end(const FieldInfo& info, const Given& given, syntax::ExprId written, ShutterTime& to);
  // A choice between a word and T, called or not, whose absence the word stands for. `example` is shown when
  // it is neither.
  template <class T>
  void read_choice(const FieldInfo& info, const Given& given, std::string_view without,
                   std::string_view example, std::optional<T>& to);
  // The word that an expression is, or empty.
  std::string_view word(syntax::ExprId id) const;
  // Reports a word, called or not, that is nothing's name but nearly one of these.
  bool is_misspelt(syntax::ExprId written, const std::vector<std::string_view>& choices);
  // The arguments of a choice that is called, into the fields of T.
  template <class T>
  void read_arguments(const syntax::CallExpr& call, T& to);
  void read_value(const FieldInfo& info, const Given& given, Thing& to);
  void read_value(const FieldInfo& info, const Given& given, std::string& to);
  void read_value(const FieldInfo& info, const Given& given, MaterialOverrides& to);
  void read_value(const FieldInfo& info, const Given& given, std::vector<Vec3d>& to);
  void read_value(const FieldInfo& info, const Given& given, std::vector<Pair<double>>& to);
  void read_value(const FieldInfo& info, const Given& given, StrandPoints& to);
  void read_value(const FieldInfo& info, const Given& given, generate::Radii& to);
  // What generated shapes take (reader_generated.cpp).
  void read_value(const FieldInfo& info, const Given& given, Pair<double>& to);
  void read_value(const FieldInfo& info, const Given& given, generate::Outlines& to);
  void read_value(const FieldInfo& info, const Given& given, generate::Align& to);
  // Errors in the function are reported as it is called, by this reader.
  void read_value(const FieldInfo& info, const Given& given, generate::HeightFunction& to);
  // A value, or an element of a list, as `type` with the parameter's unit; an error after reporting one.
  eval::Value converted(eval::Type type, const FieldInfo& info, const Given& given, const eval::Value& value,
                        std::string_view what);
  eval::Value element(eval::Type type, const FieldInfo& info, const Given& given, const eval::Value& value);
  // The elements of a list, each of `type`; none after an error.
  std::vector<eval::Value> read_list(eval::Type type, const FieldInfo& info, const Given& given);
  template <class T>
  void read_value(const FieldInfo& info, const Given& given, std::optional<T>& to) {
    T value{};
    read_value(info, given, value);
    to = value;
  }
  bool to_whole(std::string_view name, double number, Span span, double least, double greatest);
  // A required parameter, or a group of which exactly one must be given, and none was.
  struct Missing {
    std::vector<std::string_view> names;
    std::string_view documentation;  // empty for a group
  };
  void report_missing(const Missing& missing);
  // More than one of a group was given.
  void report_one_of(const std::vector<std::string_view>& names);
  void report_unknown(const Given& given, std::string_view hint, Reader* outer);
  void check_names_of_unknown(syntax::ExprId value);
  // reader_strays.cpp: what stands in the wrong block.
  void report_other(const syntax::Item& item);
  bool report_call(const syntax::Item& item, const syntax::NameExpr& called);
  std::string help_elsewhere(std::string_view name, Reader* outer);
  std::string help_for_output(std::string_view name);
  std::string help_of_others(std::string_view name) const;
  bool has(std::string_view parameter) const;
  std::vector<std::string_view> known_names() const;

  eval::Evaluator& evaluator_;
  const Schemas& schemas_;
  Diagnostics& diagnostics_;
  syntax::Symbols& symbols_;
  ReaderSite site_;
  std::string_view keyword_;
  Span header_;
  std::vector<Given> given_;                                  // each name once
  std::unordered_map<syntax::SymbolId, std::size_t> places_;  // in it, when there are many
  std::vector<const syntax::Item*> others_;                   // what is no parameter
  // Names given in a wrong way, which has been told: they are not missing.
  std::vector<syntax::SymbolId> meant_;
  bool transforms_told_ = false, outputs_told_ = false;  // several of them are one mistake
  std::array<ListNames, 3> known_{};  // of the structs read so far: candidates for "did you mean"
  std::size_t known_count_ = 0;
  std::vector<Missing> missing_;
  scene::Problems problems_;
  bool ok_ = true;
};

template <class T>
T Reader::read() {
  T result{};
  known_[known_count_++] = &list_names<T>;
  const Schema<T>& schema = schemas_.of<T>();
  std::size_t i = 0;
  std::string_view group;  // our structs have at most one
  int group_given = 0;
  T::fields([&](auto member, const FieldInfo& info) {
    Given* given = find(schema.names[i++]);
    if (!info.one_of.empty()) {
      group = info.one_of;
      if (given) ++group_given;
    }
    if (!given) {
      if (info.presence == Presence::required) missing_.push_back({{info.name}, info.documentation});
    } else if (!given->taken) {
      given->taken = true;
      read_value(info, *given, result.*member);
    }
  });
  if (!group.empty() && group_given != 1) {
    std::vector<std::string_view> names;
    T::fields([&](auto, const FieldInfo& info) {
      if (info.one_of == group) names.push_back(info.name);
    });
    if (group_given > 1)
      report_one_of(names);
    else
      missing_.push_back({std::move(names), {}});
  }
  return result;
}

template <class T>
T Reader::read_valid() {
  const T result = read<T>();
  if (ok()) problems_ = scene::validate(result);
  return result;
}

}  // namespace tyndall::resolve
