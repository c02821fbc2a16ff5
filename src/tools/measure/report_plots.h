// What the plots of a report show.
#pragma once

#include <vector>

#include "tools/measure/plot.h"
#include "tools/measure/report.h"

namespace tyndall::tools {

// Error against time, bias against each swept number, noise against samples.
std::vector<Plot> plots_of(const MeasureReport& report);

}  // namespace tyndall::tools
