// Where things stand in a NanoVDB file of version 32, as nanovdb/NanoVDB.h and nanovdb/io of the OpenVDB
// project have it: all little-endian, a grid's parts aligned to 32 bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tyndall::import::nano {

inline constexpr std::uint32_t major_version = 32;
constexpr std::uint32_t major_of(std::uint32_t version) { return version >> 21; }

// "NanoVDB", and a digit that is 0, or 2 for files since 32.6.
inline constexpr std::uint64_t magic = 0x004244566f6e614e, magic_mask = 0x00ffffffffffffff;

enum class Codec : std::uint16_t { none, zip, blosc };

enum class Kind : std::uint8_t { f32, f64, i16, i32, i64, u32, bit, quantised, quantised_by_leaf };

// Types of grids that can be read, by their numbers.
struct Type {
  std::uint32_t number;
  std::string_view name;
  Kind kind;
  int components = 1;
  std::size_t leaf_values = 96;  // where the voxels begin in a leaf
  std::size_t leaf_bits = 0;     // of a voxel
};
inline constexpr Type types[] = {
    {1, "float", Kind::f32, 1, 96, 32},       {2, "double", Kind::f64, 1, 128, 64},
    {3, "int16", Kind::i16, 1, 96, 16},       {4, "int32", Kind::i32, 1, 96, 32},
    {5, "int64", Kind::i64, 1, 128, 64},      {6, "Vec3f", Kind::f32, 3, 128, 96},
    {7, "Vec3d", Kind::f64, 3, 160, 192},     {8, "Mask", Kind::bit, 1, 16, 1},
    {10, "uint32", Kind::u32, 1, 96, 32},     {11, "bool", Kind::bit, 1, 80, 1},
    {13, "Fp4", Kind::quantised, 1, 96, 4},   {14, "Fp8", Kind::quantised, 1, 96, 8},
    {15, "Fp16", Kind::quantised, 1, 96, 16}, {16, "FpN", Kind::quantised_by_leaf, 1, 96, 0},
};
inline constexpr std::uint32_t mask_type = 8;  // has no values but which are active
constexpr const Type* type_of(std::uint32_t number) {
  for (const Type& type : types)
    if (type.number == number) return &type;
  return nullptr;
}

// A file: a header, of each grid its metadata and its name, then the grids; and so on.
inline constexpr std::size_t file_header_bytes = 16, metadata_bytes = 176;

// Fields of a grid, from its begin; those of its tree, which follows, from the tree's.
inline constexpr std::size_t grid_bytes = 672, tree_bytes = 64, version_at = 16, matrix_at = 384,
                             vec_at = 528, class_at = 632, type_at = 636;
inline constexpr std::uint32_t level_set_class = 1;
inline constexpr std::size_t node_offsets_at = 0, node_counts_at = 32;
enum Level { leaf, lower, upper, root };

// Of a root: its box of active voxels, the number of its tiles, the background; of its tiles: a key, the
// place of a child or 0, whether the value is active, the value.
inline constexpr std::size_t root_tiles_at = 24, root_background_after = 28, tile_child_at = 8,
                             tile_value_after = 20;
// Of an internal node: its box, flags, which children are active values and which are nodes, values or
// places.
inline constexpr std::size_t node_masks_at = 32;
// Of a leaf: a voxel within it, the extent of its active ones, flags, which are active; of quantised ones the
// least value and the step.
inline constexpr std::size_t leaf_flags_at = 15, leaf_mask_at = 16, leaf_minimum_at = 80, leaf_step_at = 84;

constexpr std::size_t aligned(std::size_t bytes, std::size_t to = 32) { return (bytes + to - 1) / to * to; }

}  // namespace tyndall::import::nano
