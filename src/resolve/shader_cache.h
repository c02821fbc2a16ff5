// Media and materials: compiled once for each different body, checked when nothing uses them.
#pragma once

#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "eval/value.h"
#include "resolve/reading/parameters.h"
#include "scene/scene.h"

namespace tyndall::resolve {

struct Run;

struct Bodies {
  // By eval::Body::key; an invalid id has been reported.
  std::unordered_map<std::string, scene::MediumId> media;
  std::unordered_map<std::string, scene::MaterialId> materials;
  // The same by the address of a value, which `kept` keeps from being used again: no key is built for each
  // thing.
  std::unordered_map<const eval::Heavy*, scene::MaterialId> material_of_value;
  std::unordered_set<std::uint32_t> may_let_through;  // materials that set transmission or opacity
  std::vector<eval::Value> kept;
  scene::MaterialId default_material;
  // By index: those that it looks up at its own p. None where one is looked up elsewhere.
  std::unordered_map<std::uint32_t, std::vector<eval::Grid>> grids_of_medium;

  struct Definition {
    const syntax::SyntaxTree* tree;
    const syntax::BodyItem* item;
    eval::Value value;
  };
  std::vector<Definition> definitions;
  std::unordered_set<const syntax::BodyItem*> defined, compiled;
};

// The compiled medium or material that a parameter names; invalid after an error.
scene::MediumId medium_of(Run& run, const Thing& thing);
scene::MaterialId material_of(Run& run, const Thing& thing);
// Grey 0.8.
scene::MaterialId default_material(Run& run);

// Remembers a definition that has just been bound to `value`.
void note_definition(Run& run, const syntax::SyntaxTree& tree, const syntax::BodyItem& item,
                     const eval::Value& value);
// Compiles the definitions that nothing used, if their parameters all have defaults, for their errors alone.
void check_unused_bodies(Run& run);

}  // namespace tyndall::resolve
