// What kept.h keeps. Internal to this layer.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "resolve/grids.h"
#include "resolve/images.h"
#include "resolve/imported_files.h"
#include "resolve/kept.h"
#include "resolve/resolve_context.h"

namespace tyndall::resolve {

struct KeptParts {
  std::vector<Override> overrides;
  std::map<std::string, std::shared_ptr<const syntax::SyntaxTree>> trees;  // by canonical path
  Images::Known images;
  std::shared_ptr<TileMemory> tiles;  // of images in temporary files
  Grids::Known grids;
  ImportedFiles imported;
};

// What the run has of the frame before; null when nothing is kept.
KeptParts* kept_parts(const Run& run);
// Keeps for the next frame what this one used.
void keep_parts(Run& run);

}  // namespace tyndall::resolve
