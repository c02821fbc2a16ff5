// Parts of a picture (.tynpart) put together.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/film/film.h"
#include "tools/coverage.h"
#include "tools/part_facts.h"

namespace tyndall::tools {

struct MergeRequest {
  std::vector<std::string> parts;  // paths
  bool incomplete = false;         // takes what there is of a picture that is not whole
};

struct Merged {
  PartFacts facts;              // of the whole: what a render of it would tell
  std::vector<SampleBox> gaps;  // that `incomplete` allowed
  render::Film film;
  double mean_samples = 0;  // of a pixel of the film
};

struct MergeResult {
  std::optional<Merged> merged{};
  std::vector<std::string> warnings{};
  std::string error{};  // fit for the user; empty when they are merged
};
// Reads the parts and adds them up. An error when one cannot be read, has another scene or other settings
// than the first, has samples that another one has, or when together they are not the whole picture.
MergeResult merge(const MergeRequest& request);

// Whether these parts have been merged before, and perhaps removed: the picture is there, and has each of
// them that is there.
bool is_merged_already(const std::vector<std::string>& parts, const std::string& picture);

}  // namespace tyndall::tools
