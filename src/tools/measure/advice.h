// Which setting reaches an error in the least time, by what was measured.
#pragma once

#include <vector>

#include "tools/measure/report.h"

namespace tyndall::tools {

inline constexpr double advised_errors[] = {0.05, 0.02, 0.01};

// Bias stays as samples grow, and noise falls as their inverse: the settings whose bias is proven (by its
// interval) to be below the error, each with the samples that leave the rest to noise; of those the fastest.
// Where several numbers of samples were measured the nearest one is gone from.
std::vector<Advice> advice_of(const std::vector<SettingRow>& rows);

// The `render {}` block of a scene with these settings; what is as usual is left out.
std::string render_block(const scene::RenderSettings& settings);

}  // namespace tyndall::tools
