// The reference of the language, made of the tables of the code: what the manual lists and `tyndall help`
// prints.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tyndall::tools {

struct ReferenceParameter {
  std::string name, documentation;
  std::string standard{};  // its default as a scene would write it; empty where there is none to write
  bool required = false, one_of_several = false;
};

// A statement of a scene, or a value with braces.
struct ReferenceStatement {
  std::string name;  // "light point", or "mesh \"file\"" where it takes the name of a file
  std::string documentation;
  std::vector<ReferenceParameter> parameters;
};
const std::vector<ReferenceStatement>& reference_statements();

struct ReferenceFunction {
  std::string name;
  std::string call;  // "fbm(p, octaves = 6, …)"
  std::string result, documentation, example;
};
const std::vector<ReferenceFunction>& reference_functions();
// The path, below the program's own folder, of a small picture of what a function looks like, made by
// scripts/pictures; empty where there is none.
std::string picture_of(const ReferenceFunction& function);

// What a body may set.
struct ReferenceOutput {
  std::string name, documentation, standard;
};
const std::vector<ReferenceOutput>& reference_medium_outputs();
const std::vector<ReferenceOutput>& reference_material_outputs();

// A reserved word, an input of bodies, or a name that has a value.
struct ReferenceWord {
  std::string_view word, meaning, example;
};
std::span<const ReferenceWord> reference_words();

// One page with every statement, parameter and function, in Markdown.
std::string cheat_sheet();

}  // namespace tyndall::tools
