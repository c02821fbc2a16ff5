// What scene statements do: the rows of the table, and their functions.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "resolve/reading/parameters.h"
#include "resolve/reading/statement_table.h"
#include "scene/scene.h"
#include "syntax/tree.h"

namespace tyndall::resolve {

struct PlacedShape;
struct NamedFile;

// Where a shape is written.
struct ShapeSite {
  const Site& site;
  syntax::BlockId block;
  Span header;
};

// The rows of the table, in the order of the manual.
std::vector<Statement> all_statements();

// Runs a scene statement, or says that there is none of that name.
void run_thing(Run& run, const Site& site, const syntax::ThingItem& thing);

void report_unknown_statement(Run& run, const Site& site, const syntax::ThingItem& thing);
// The statement of the next line that an unknown word alone on its line took for its kind.
std::optional<syntax::ThingItem> statement_behind(const Run& run, const syntax::ThingItem& thing);

// The rows' functions.
void run_render(Run&, const Site&, const syntax::ThingItem&, const Statement&);
void run_animation(Run&, const Site&, const syntax::ThingItem&, const Statement&);
template <class Camera>
void run_camera(Run&, const Site&, const syntax::ThingItem&, const Statement&);
std::vector<Statement> light_statements();
void run_shape(Run&, const Site&, const syntax::ThingItem&, const Statement&);
// Reads a mesh into the scene.
std::optional<scene::Shape> read_mesh(Run& run, Reader& reader, const ShapeSite&);
std::optional<scene::Shape> read_curves(Run& run, Reader& reader, const ShapeSite&);
// Runs the statements in the braces of a combination, of which each shape becomes a part.
template <class Combination>
std::optional<scene::Shape> read_combination(Run& run, Reader& reader, const ShapeSite& at);
// Adds a shape to the combination whose braces are being run.
void add_part(Run& run, const Site& site, Reader& reader, const scene::Shape& shape,
              const ShapePlacement& placement, Span header);
// Reports a parameter that is the combination's alone, where one is being made.
void refuse_of_part(Run& run, Reader& reader, bool given, std::string_view name);
// Whether a statement may stand where the run is: in a combination closed shapes may, otherwise all. False
// after an error.
bool may_stand(Run& run, const syntax::ThingItem& thing, const Statement& row);
// Of those that are made into meshes: read them into the scene.
std::vector<Statement> generated_statements();
// How an open one is closed; empty for other shapes.
std::string_view way_to_close(std::string_view keyword);
void run_volume(Run&, const Site&, const syntax::ThingItem&, const Statement&);
void run_gltf(Run&, const Site&, const syntax::ThingItem&, const Statement&);
void run_gltf_camera(Run&, const Site&, const syntax::ThingItem&, const Statement&);
std::optional<PlacedShape> read_gltf_shape(Run& run, Reader& reader, const NamedFile& file);
void run_mesh_file(Run&, const Site&, const syntax::ThingItem&, const Statement&);
std::optional<PlacedShape> read_mesh_file_shape(Run& run, Reader& reader, const NamedFile& file);
void run_group(Run&, const Site&, const syntax::ThingItem&, const Statement&);

// The place of a statement's words: `light point`.
Span header(const syntax::ThingItem& thing);

}  // namespace tyndall::resolve
