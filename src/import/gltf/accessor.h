// Accessors: lists of numbers or vectors in a glTF file's buffers, of any component type, stride, normalised
// or sparse. Every claim is checked against the bytes that are there. All throw Malformed.
#pragma once

#include <cstdint>
#include <vector>

#include "base/transform.h"
#include "base/vec.h"
#include "import/gltf/document.h"

namespace tyndall::gltf {

std::size_t count_of(const Document& document, std::uint32_t accessor);
// How many numbers an element has: 3 of a VEC3.
int width_of(const Document& document, std::uint32_t accessor);

// Its elements of `width` numbers each, one after the other; whole ones made fractions where it is
// normalised.
std::vector<float> read_floats(Document& document, std::uint32_t accessor, int width);
// Whole numbers, one an element.
std::vector<std::uint32_t> read_counts(Document& document, std::uint32_t accessor, int width = 1);
std::vector<Vec3d> read_vecs(Document& document, std::uint32_t accessor);
// Affine 4 x 4 matrices.
std::vector<Transform> read_matrices(Document& document, std::uint32_t accessor);

}  // namespace tyndall::gltf
