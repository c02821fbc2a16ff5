// The CIE 1931 observer: what a spectrum looks like.
#pragma once

#include "base/vec.h"

namespace tyndall {

// The wavelengths that it sees [nm].
inline constexpr int shortest_nm = 360, longest_nm = 830;

// Its colour matching functions. Wyman, Sloan, Shirley, "Simple Analytic Approximations to the CIE XYZ Color
// Matching Functions", JCGT 2013, the multi-lobe fits.
Vec3d observer(double nanometres);

// Linear Rec. 709 primaries, white D65 (IEC 61966-2-1); components may be below zero.
Vec3d rec709_of_xyz(const Vec3d& xyz);

}  // namespace tyndall
