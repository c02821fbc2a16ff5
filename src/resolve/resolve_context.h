// What one resolve shares, and where an item stands. Internal to this layer.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <variant>
#include <vector>

#include "eval/evaluator.h"
#include "resolve/limits.h"
#include "resolve/shader_cache.h"

#include "resolve/checks/unused_names.h"
#include "resolve/deforming.h"
#include "resolve/grids.h"
#include "resolve/images.h"
#include "resolve/imported_files.h"
#include "resolve/reading/reader.h"
#include "resolve/resolve.h"
#include "resolve/statements/statements.h"
#include "scene/scene.h"
#include "shapes/combined_parts.h"
#include "syntax/parser.h"

namespace tyndall::resolve {

// Where an item stands: its text, the names in force, the space, what surrounding groups settled.
struct Site {
  const syntax::SyntaxTree* tree = nullptr;
  std::shared_ptr<eval::Scope> scope;
  std::unordered_set<std::string>* included = nullptr;  // files brought into this scope
  Transform world_from_local{};
  scene::MaterialId material{};  // of groups and places around; invalid: none
  bool visible = true;
  bool in_object = false;  // settings and cameras are refused
};

// A value given by --set, waiting for its `let`.
struct Override {
  syntax::SymbolId symbol;
  syntax::ParsedExpression parsed;
  Span span;
  bool used = false;
};

// Files brought in by `include`.
struct Includes {
  std::map<std::string, std::shared_ptr<const syntax::SyntaxTree>>
      trees;                      // by canonical path; null: unreadable
  std::vector<std::string> open;  // being run, outermost first
};

// What is known of the files that a scene names (find_file).
struct Files {
  std::vector<std::filesystem::path> folders;                    // where they may lie, links followed
  std::unordered_map<std::string, std::filesystem::path> found;  // by naming folder and name
};

// A light in the space of the object that holds it, as read, and how it gets there.
struct ObjectLight {
  scene::Light light;
  Transform object_from_light;
  Span definition;
  std::string_view statement;
};

// The lights of an object in the order of its text: its own, and all those of objects in it, which are
// written out only where the outermost one stands in the scene.
struct ObjectLights {
  struct Placed {
    std::shared_ptr<const ObjectLights> lights;
    Transform object_from_inner;
  };
  std::vector<std::variant<ObjectLight, Placed>> list;
  double count = 0;
};

// What an object holds, while or after its body is run.
struct BuiltObject {
  scene::Prototype things;
  std::shared_ptr<ObjectLights> lights = std::make_shared<ObjectLights>();
  bool inherits_material = false;      // something in it names no material
  bool sets_variable = false;          // a variable from outside, so each placement must run the body again
  double placed = 0;                   // objects in it, and volumes in those: what Run::may_place counts
  double volumes = 0;                  // in it and in those
  const eval::Scope* scope = nullptr;  // of its body, while it is run
};

// A combination while its braces are run.
struct Combination {
  std::string_view keyword;
  std::vector<shapes::CombinedPart> parts{};
  std::size_t count = 0;  // of them, those of its parts in place of these
  bool complete = true;   // no part failed
};

// An object that is placed by its prototype from now on.
struct KnownObject {
  eval::Value value;  // keeps the address from being used again
  scene::PrototypeId prototype;
  std::shared_ptr<const ObjectLights> lights;
  bool inherits_material = false;
  double holds = 0;    // objects and volumes, those of the objects in it counted each time
  double volumes = 0;  // of those
};

// What decides how many things there are, as it was when the shutter opened: branches of `if`, ranges and
// lengths of `for`, in order. A run at a later moment takes them over.
class Structure {
 public:
  // `earlier`: that of the run when the shutter opened; null for that run itself.
  explicit Structure(const Structure* earlier = nullptr) : earlier_(earlier) {}

  bool settled(bool condition) { return settled(eval::RangeValue{condition ? 1.0 : 0.0}).first != 0; }
  std::size_t settled(std::size_t length) {
    return static_cast<std::size_t>(settled(eval::RangeValue{static_cast<double>(length)}).first);
  }
  eval::RangeValue settled(const eval::RangeValue& now);
  // Whether this is a later run, which is only compared with the first: what things are made of is not looked
  // into.
  bool later() const { return earlier_ != nullptr; }
  // Whether there will be later runs.
  void keep(bool keeps) { keeps_ = keeps; }

 private:
  const Structure* earlier_;
  bool keeps_ = false;
  std::size_t place_ = 0;
  std::vector<eval::RangeValue> kept_;
};

struct Run {
  Run(const syntax::SyntaxTree& tree, Sources& sources_, syntax::Symbols& symbols_, const Options& options_,
      Diagnostics& diagnostics_, const Structure* earlier = nullptr);

  Sources& sources;
  syntax::Symbols& symbols;
  const Options& options;
  Diagnostics& diagnostics;
  const syntax::SyntaxTree* main;
  Includes includes;  // before the context: values of the run point into the trees
  Files files;
  std::vector<Override> overrides;
  Images images;
  ImportedFiles imported;
  Grids grids;
  eval::Context context;
  eval::Evaluator evaluator;
  const Schemas schemas;
  const Statements statements;

  scene::Scene scene;
  Span render, animation, camera;            // where they stand, once met
  std::optional<scene::Animation> foreseen;  // as read before all else; decides frame and time
  std::shared_ptr<eval::Scope> file_scope;
  std::vector<syntax::SymbolId> file_lets;  // candidates for --set
  Bodies bodies;
  PassedOver passed_over;
  std::unordered_set<const syntax::ThingExpr*> warned_meshes;
  Structure structure;
  Written written;
  BuiltObject* building =
      nullptr;  // takes the things of the object whose body is being run; null: the scene does
  Combination* combining = nullptr;  // takes the shapes whose statements are run; null: the scene does
  std::unordered_map<const eval::Heavy*, KnownObject> objects;  // by their values' addresses
  // Of those with arguments, by their keys too: places in objects_of_arguments.
  std::map<std::pair<const eval::Heavy*, std::string>, std::size_t> argument_keys;
  std::vector<std::shared_ptr<const eval::Scope>> object_arguments;  // kept, for keys may hold addresses
  std::vector<KnownObject> objects_of_arguments;                     // in the order in which they were made

  int template_depth = 0, block_depth = 0;
  long repetitions = 0;
  std::unordered_map<const syntax::TemplateItem*, double> foreseen_calls;  // of each, with those in it
  double placed = 0;                    // objects and volumes in them, each time
  double lights = 0, volumes_made = 0;  // of the scene, those in objects each time
  bool stopped = false;                 // a limit was met: nothing more is run
  std::vector<bool> blocks_run;         // of the main file, by number: met once at least

  std::vector<scene::ShapeInstance>& shapes() { return building ? building->things.shapes : scene.shapes; }
  std::vector<scene::Volume>& volumes() { return building ? building->things.volumes : scene.volumes; }
  std::vector<scene::Instance>& instances() {
    return building ? building->things.instances : scene.instances;
  }

  // Counts rounds of a loop or calls; false, after an error at `span`, when they are too many.
  bool may_repeat(double rounds, Span span);
  // Whether so many more may be counted: an error as of may_repeat, when they may not.
  bool may_foresee(double rounds, Span span);
  // Counts what an object that is placed brings with it, before any of it is written out; false, after an
  // error at `span`, when the scene or the object being built would hold too much.
  bool may_place(const KnownObject& object, Span span);
  // Counts lights or volumes before they are made, likewise.
  bool may_add_lights(double count, Span span);
  bool may_add_volumes(double count, Span span);
  bool finished() const { return stopped || diagnostics.full(); }
};

// Tells who asks for it what is kept of files.
void note_asset(Run& run, const Asset& asset, std::uint64_t bytes);

// Whether a block's parameters (`transform: …`) have been read already, or have no business there.
enum class Parameters : bool { refused, read };

// An error at `animation`: a later run of the scene had other things than the first.
void report_other_things(Run& run);

// Reports, once for all uses, a name that is defined nowhere; silent when it may be in what could not be
// read.
void report_undefined(Run& run, syntax::SymbolId symbol, Span span, std::string message, std::string help);

// A thing as a value that is no shape.
void report_no_shape(Run& run, const syntax::ThingExpr& thing);

// Runs the items of a block where `site` stands, in order.
void run_block(Run& run, const Site& site, syntax::BlockId block,
               Parameters parameters = Parameters::refused);
// Runs them in a new scope below the site's.
void run_inner_block(Run& run, const Site& site, syntax::BlockId block,
                     Parameters parameters = Parameters::refused);

// items.cpp, calls.cpp, include.cpp
void run_item(Run& run, const Site& site, const syntax::Item& item);
void run_for(Run& run, const Site& site, const syntax::ForItem& loop);
void run_call(Run& run, const Site& site, const syntax::CallItem& call);
void run_place(Run& run, const Site& site, const syntax::PlaceItem& place);
void run_include(Run& run, const Site& site, const syntax::IncludeItem& include);

// Remembers what could not be read of a file.
void note_unread(Run& run, const syntax::SyntaxTree& tree);

// One name for a file however it is spelt, without links.
std::filesystem::path canonical_path(const std::filesystem::path& path);

// The file that the text at `span` names: beside the file of that text, or in an include directory. Nothing
// after an error: there is no such `noun` ("file", "picture"), or it lies outside of the folders of the scene
// and of --include, links followed, and that is not allowed.
std::optional<std::filesystem::path> find_file(Run& run, std::string_view noun, const std::string& name,
                                               Span span);

// A file that a statement names after its words.
struct NamedFile {
  std::filesystem::path path;
  std::string name;  // as written
  Span span;
};
std::optional<NamedFile> named_file(Run& run, const syntax::SyntaxTree& tree, syntax::ExprId file,
                                    const std::shared_ptr<const eval::Scope>& scope);
// A file that another one names, below whose folder it must lie unless that is not asked; nothing with the
// reason in `why`, as the rest of a sentence.
std::optional<std::filesystem::path> find_beside(const Options& options, const std::filesystem::path& file,
                                                 const std::string& name, std::string& why);

// The name of the main file among the included ones.
std::string main_file_key(const Run& run);

// Binds a `let` at the top level of a file: its value, or what --set says instead.
void define_file_let(Run& run, eval::Evaluator& evaluator, const syntax::SyntaxTree& tree,
                     const syntax::Item& item, const syntax::LetItem& let,
                     const std::shared_ptr<eval::Scope>& scope);

// A reader of the statement's block where `site` stands.
Reader reader_of(Run& run, const Site& site, const syntax::ThingItem& thing, const Statement& row,
                 Reader::Others others = Reader::Others::refused);

// The shape that a parameter holds, and its own transform; nothing after an error.
struct PlacedShape {
  scene::Shape shape;
  Transform outer_from_shape;
};
enum class Inside : bool { any, needed };  // whether open shapes will do
std::optional<PlacedShape> read_shape_value(Run& run, const Thing& in, Inside inside, Reader& outer);

// False, after an error, when a statement that occurs once was met before or stands in an object.
bool first_of_its_kind(Run& run, const Site& site, Span& met, Span here, std::string_view name);
// Makes the scene's camera of one that stands where `site` and the transform say.
void set_camera(Run& run, const Site& site, Reader& reader, Span here, scene::Camera camera,
                const Transform& transform);

// Places what an object holds, as `place` does.
void place_known(Run& run, const Site& site, const KnownObject& object, const Transform& world_from_object,
                 scene::MaterialId material, Span span);

// Adds a light to the scene or the object being built; an error when its shape does not survive the map to
// the world.
void add_light(Run& run, ObjectLight light, const Transform& world_from_light);

// The space of a thing with this transform where `site` stands; nothing, after an error, when the product
// flattens.
std::optional<Transform> placed(Reader& reader, const Site& site, const Transform& transform);

}  // namespace tyndall::resolve
