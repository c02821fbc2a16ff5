// Which settings are measured: the grid of the values of `--sweep NAME=VALUE,VALUE,…`.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tools/render_arguments.h"

namespace tyndall::tools {

struct Sweep {
  std::string name;  // "light_samples"
  std::vector<std::string> values;
};

// Reads "step=0.1,auto,adaptive(1%)", or complains: misuse of the command line.
Sweep read_sweep(const std::string& text);

// A point of the grid.
struct MeasuredSetting {
  std::vector<std::pair<std::string, std::string>> swept;  // names and values, in the order of the sweeps
  RenderArguments arguments;

  // "step 0.1, light_samples 4"; "as the scene is" where nothing is swept.
  std::string name() const;
  // The value of a swept parameter; null where it is not swept.
  const std::string* value(const std::string& parameter) const;
};

// Every combination of the values, in the place of what `base` gives. Complains about values that the
// parameters do not take, about names given twice and about grids that are too large.
std::vector<MeasuredSetting> grid_of(const RenderArguments& base, const std::vector<Sweep>& sweeps);

// What can be swept, by name.
std::vector<std::string> swept_names();

}  // namespace tyndall::tools
