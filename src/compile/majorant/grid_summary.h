// A majorant grid in numbers, for listings.
#pragma once

#include <cstddef>

#include "compile/majorant/majorant_grid.h"

namespace tyndall::compile {

struct GridSummary {
  std::size_t cells = 0, empty = 0, uniform = 0;
  // Sum of the majorants over the sum of the largest of some samples a cell, over evenly chosen cells where
  // any sample is above 0; 0 when there are none. At least 1 but for the sparseness of the samples.
  double tightness = 0;
};

// Makes every cell.
GridSummary summarize(const MajorantGrid& grid);

}  // namespace tyndall::compile
