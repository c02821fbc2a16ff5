// All rows of docs/verification.md.
#pragma once

#include "support/verification_phase.h"
#include "support/verification_scenes.h"
#include "support/verification_slabs.h"

namespace tyndall::support {

inline std::vector<VerificationRow> verification_rows() {
  std::vector<VerificationRow> rows;
  for (const auto add : {add_phase_rows, add_transmittance_rows, add_emission_rows, add_airlight_rows,
                         add_distant_light_rows, add_slab_rows, add_diffuse_rows, add_half_space_rows,
                         add_sphere_rows, add_mean_path_rows, add_white_rows})
    add(rows);
  return rows;
}

}  // namespace tyndall::support
