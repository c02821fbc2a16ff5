#include "compile/majorant/majorant_grid.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/numerics.h"
#include "base/rounding.h"

namespace tyndall::compile {

namespace {

// Boxes are made larger than their cells by this share, for the rounding of the points on rays: they are
// computed in double, and then rounded to float, which is monotone.
constexpr double padding = 1e-4;

// A cell whose bounds lie further apart than this share of the majorant is bounded again in eight parts.
constexpr float loose_share = 0.25f;

// After clamping: NaN counts as 0.
struct Clamped {
  float lo, hi;
};
Clamped clamped(const vm::ValueBounds& v) {
  const float lo = std::clamp(v.lo, 0.0f, largest_coefficient);
  const float hi = std::clamp(v.hi, 0.0f, largest_coefficient);
  return {v.may_be_nan ? 0.0f : lo, hi};
}

// Cells as cubes, as many as allowed, in whole bricks.
std::array<std::uint32_t, 3> bricks_for(const Vec3d& extent, std::uint32_t most_cells) {
  const double longest = std::max({extent.x, extent.y, extent.z});
  const auto along = [&](double e, double brick) { return std::max(1.0, std::round(e / brick)); };
  const double most = std::max(1.0, static_cast<double>(most_cells) / MajorantGrid::brick_cells);
  double brick = longest / std::floor(std::max(1.0, std::min(most, 512.0)));
  for (; along(extent.x, brick) * along(extent.y, brick) * along(extent.z, brick) > most; brick *= 1.02) {
  }
  return {static_cast<std::uint32_t>(along(extent.x, brick)),
          static_cast<std::uint32_t>(along(extent.y, brick)),
          static_cast<std::uint32_t>(along(extent.z, brick))};
}

std::array<bool, 8> empty_blocks(const std::array<CellKind, MajorantGrid::brick_cells>& kinds) {
  std::array<bool, 8> empty{};
  empty.fill(true);
  for (std::uint32_t i = 0; i < MajorantGrid::brick_cells; ++i)
    empty[MajorantGrid::block_of(i)] &= kinds[i] == CellKind::empty;
  return empty;
}

std::uint32_t place_in_brick(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  constexpr std::uint32_t n = MajorantGrid::brick_side;
  return (z % n * n + y % n) * n + x % n;
}

void add_unique(std::vector<std::uint8_t>& list, const scene::RgbOutputs& outputs) {
  for (const std::uint8_t k : outputs)
    if (std::find(list.begin(), list.end(), k) == list.end()) list.push_back(k);
}

}  // namespace

MajorantGrid::MajorantGrid(const scene::Medium& medium, const Domain& domain)
    : medium_(&medium), domain_(domain), occupied_(domain.box) {
  const Vec3d extent = domain.box.hi - domain.box.lo;
  CHECK(extent.x >= 0 && extent.y >= 0 && extent.z >= 0);
  bricks_ = bricks_for(extent, domain.cells);
  for (std::size_t axis = 0; axis < 3; ++axis) cell_size_[axis] = extent[axis] / (bricks_[axis] * brick_side);
  add_unique(coefficients_, medium.sigma_t);
  add_unique(coefficients_, medium.sigma_s);
  if (medium.emission) add_unique(coefficients_, *medium.emission);
  for (std::size_t k = 0; k < medium.full.outputs.size(); ++k)
    if (std::none_of(medium.given.begin(), medium.given.end(), [k](const scene::GivenNumber& given) {
          return !given.branches.empty() && given.branch_output == k;
        }))
      quantities_.push_back(k);
  made_ = std::vector<std::atomic<Brick*>>(brick_count());
  for (int level = 0; level < levels; ++level) {
    const std::array<std::uint32_t, 3> n = groups(level);
    auto& kinds = kinds_[static_cast<std::size_t>(level)];
    kinds = std::vector<std::atomic<std::uint8_t>>(std::size_t{n[0]} * n[1] * n[2]);
    for (auto& kind : kinds) kind.store(unknown, std::memory_order_relaxed);
  }
}

MajorantGrid::~MajorantGrid() {
  for (const std::atomic<Brick*>& brick : made_) delete brick.load();
}

CellBounds MajorantGrid::at(const Vec3d& p, BoundsScratch& scratch) const {
  std::array<std::uint32_t, 3> cell{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double place = std::floor((p[axis] - domain_.box.lo[axis]) / cell_size_[axis]);
    cell[axis] =
        place > 0 ? static_cast<std::uint32_t>(std::min(place, bricks_[axis] * brick_side - 1.0)) : 0;
  }
  const Brick& b = brick(cell[0] / brick_side, cell[1] / brick_side, cell[2] / brick_side, scratch);
  return b.cell(place_in_brick(cell[0], cell[1], cell[2]));
}

void MajorantGrid::survey(BoundsScratch& scratch) {
  constexpr std::uint32_t along = brick_side / block_side;  // blocks of a brick
  const Vec3d size = cell_size_ * double{block_side};
  std::size_t plain = 0;
  majorant_ = 0;
  Bounds occupied{Vec3d(infinity), Vec3d(-infinity)};
  // In slices of one layer of blocks.
  const std::uint32_t nx = bricks_[0] * along, ny = bricks_[1] * along, nz = bricks_[2] * along;
  const auto corner = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return domain_.box.lo + Vec3d{x * size.x, y * size.y, z * size.z};
  };
  for (std::uint32_t z = 0; z < nz; ++z) {
    for (std::uint32_t y = 0; y < ny; ++y)
      for (std::uint32_t x = 0; x < nx; ++x) add_box(corner(x, y, z), corner(x + 1, y + 1, z + 1), scratch);
    const std::size_t boxes = std::size_t{nx} * ny;
    evaluate(boxes, scratch);
    for (std::uint32_t y = 0; y < ny; ++y)
      for (std::uint32_t x = 0; x < nx; ++x) {
        const CellBounds block = summary(std::size_t{y} * nx + x, 1, boxes, scratch);
        plain += block.kind != CellKind::varying;
        majorant_ = std::max(majorant_, block.majorant);
        if (block.kind == CellKind::empty) continue;
        const Vec3d lo = corner(x, y, z), hi = corner(x + 1, y + 1, z + 1);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          occupied.lo[axis] = std::min(occupied.lo[axis], lo[axis]);
          occupied.hi[axis] = std::max(occupied.hi[axis], hi[axis]);
        }
      }
  }
  plain_share_ = static_cast<double>(plain) / static_cast<double>(std::size_t{nx} * ny * nz);
  // Within what the blocks were bounded with around them.
  const Vec3d room = size * (padding / 2);
  occupied_ = {occupied.lo - room, occupied.hi + room};
}

// Whoever is first publishes; another's copy is the same and is dropped.
const MajorantGrid::Brick& MajorantGrid::make(std::size_t index, const std::array<std::uint32_t, 3>& at,
                                              BoundsScratch& scratch) const {
  std::unique_ptr<Brick> brick = computed(at, scratch);
  note_kinds(at, *brick);
  Brick* expected = nullptr;
  if (made_[index].compare_exchange_strong(expected, brick.get(), std::memory_order_acq_rel))
    return *brick.release();
  return *expected;
}

std::array<std::uint32_t, 3> MajorantGrid::cell_of(int level, std::size_t group) const {
  const std::array<std::uint32_t, 3> n = groups(level);
  return {static_cast<std::uint32_t>(group % n[0]) << level,
          static_cast<std::uint32_t>(group / n[0] % n[1]) << level,
          static_cast<std::uint32_t>(group / n[0] / n[1]) << level};
}

CellKind MajorantGrid::make_kind(int level, std::size_t group, BoundsScratch& scratch) const {
  const std::array<std::uint32_t, 3> cell = cell_of(level, group);
  brick(cell[0] / brick_side, cell[1] / brick_side, cell[2] / brick_side, scratch);
  return static_cast<CellKind>(
      kinds_[static_cast<std::size_t>(level)][group].load(std::memory_order_relaxed));
}

bool MajorantGrid::same_values(int level, std::size_t a, std::size_t b, BoundsScratch& scratch) const {
  const auto bounds = [&](std::size_t group) {
    const std::array<std::uint32_t, 3> c = cell_of(level, group);
    return brick(c[0] / brick_side, c[1] / brick_side, c[2] / brick_side, scratch)
        .cell(place_in_brick(c[0], c[1], c[2]));
  };
  return bounds(a) == bounds(b);
}

// Level by level, each from the one below.
void MajorantGrid::note_kinds(const std::array<std::uint32_t, 3>& at, const Brick& brick) const {
  std::array<CellBounds, brick_cells> bounds;  // of the groups; of uniform ones, those of every cell
  for (std::uint32_t i = 0; i < brick_cells; ++i) bounds[i] = brick.cell(i);
  for (int level = 0; level < levels; ++level) {
    const std::uint32_t across = brick_side >> level;
    const std::array<std::uint32_t, 3> n = groups(level);
    for (std::uint32_t z = 0, i = 0; z < across; ++z)
      for (std::uint32_t y = 0; y < across; ++y)
        for (std::uint32_t x = 0; x < across; ++x, ++i) {
          if (level > 0) {
            // Written before it is read: a group's place is not above those of its parts.
            CellBounds whole = bounds[(2 * z * 2 * across + 2 * y) * 2 * across + 2 * x];
            for (std::uint32_t part = 1; part < 8; ++part) {
              const std::uint32_t px = 2 * x + (part & 1), py = 2 * y + (part >> 1 & 1),
                                  pz = 2 * z + (part >> 2);
              const CellBounds& other = bounds[(pz * 2 * across + py) * 2 * across + px];
              if (whole.kind != other.kind || (whole.kind == CellKind::uniform && whole != other))
                whole.kind = CellKind::varying;
            }
            bounds[i] = whole;
          }
          kinds_[static_cast<std::size_t>(level)]
                [(std::size_t{at[2] * across + z} * n[1] + at[1] * across + y) * n[0] + at[0] * across + x]
                    .store(static_cast<std::uint8_t>(bounds[i].kind), std::memory_order_relaxed);
        }
  }
}

// Adds a box of p, and where it is in the world.
void MajorantGrid::add_box(const Vec3d& lo, const Vec3d& hi, BoundsScratch& scratch) const {
  const Vec3d pad = (hi - lo) * padding, low = lo - pad, high = hi + pad;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    scratch.p[axis].push_back(float_below(low[axis]));
    scratch.p[axis + 3].push_back(float_above(high[axis]));
  }
  if (domain_.world_from_medium.empty()) return;
  Vec3d lowest(infinity), highest(-infinity);
  for (const Transform& m : domain_.world_from_medium) {
    const Vec3d center = m.point((low + high) * 0.5), half = (high - low) * 0.5;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double reach =
          std::abs(m.x[axis]) * half.x + std::abs(m.y[axis]) * half.y + std::abs(m.z[axis]) * half.z;
      lowest[axis] = std::min(lowest[axis], center[axis] - reach);
      highest[axis] = std::max(highest[axis], center[axis] + reach);
    }
  }
  const double off =
      domain_.bend > 0
          ? domain_.bend * (length((low + high) * 0.5 - domain_.pivot) + length(high - low) * 0.5)
          : 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    scratch.world[axis].push_back(float_below(lowest[axis] - off));
    scratch.world[axis + 3].push_back(float_above(highest[axis] + off));
  }
}

// Runs the program over the boxes added so far, and forgets them.
void MajorantGrid::evaluate(std::size_t boxes, BoundsScratch& scratch) const {
  vm::BoxInputs inputs;
  const auto set = [&](vm::Input first, const std::array<std::vector<float>, 6>& rows) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      inputs.set(static_cast<vm::Input>(static_cast<std::size_t>(first) + axis), rows[axis].data(),
                 rows[axis + 3].data());
  };
  set(vm::Input::p_x, scratch.p);
  if (!domain_.world_from_medium.empty()) set(vm::Input::P_x, scratch.world);
  inputs.set(vm::Input::time, &domain_.time.lo, &domain_.time.hi);
  scratch.values.resize(boxes * medium_->full.outputs.size());
  scratch.machine.run(medium_->full, inputs, boxes, scratch.values);
  for (auto* rows : {&scratch.p, &scratch.world})
    for (std::vector<float>& row : *rows) row.clear();
}

// What is proven about boxes [first, first + count) of the last evaluation together.
CellBounds MajorantGrid::summary(std::size_t first, std::size_t count, std::size_t boxes,
                                 const BoundsScratch& scratch) const {
  const auto whole = [&](std::size_t output) {
    vm::ValueBounds sum = scratch.values[output * boxes + first];
    for (std::size_t i = 1; i < count; ++i) {
      const vm::ValueBounds& b = scratch.values[output * boxes + first + i];
      sum = {std::min(sum.lo, b.lo), std::max(sum.hi, b.hi), sum.may_be_nan || b.may_be_nan};
    }
    return sum;
  };
  CellBounds cell;
  bool empty = true, uniform = true;
  for (const std::uint8_t k : coefficients_) {
    const vm::ValueBounds v = whole(k);
    empty &= !v.may_be_nan && v.lo == 0 && v.hi == 0;
  }
  // What is limited to 0 is told, so it is not skipped.
  for (const scene::GivenNumber& given : medium_->given) {
    if (!empty) break;
    if (!given.scales) continue;
    const vm::ValueBounds v = whole(given.output);
    empty &= !v.may_be_nan && (v.lo >= 0 || v.hi > 0);
  }
  cell.minorant = largest_coefficient;
  for (std::size_t c = 0; c < 3; ++c) {
    const Clamped v = clamped(whole(medium_->sigma_t[c]));
    cell.minorant = std::min(cell.minorant, v.lo);
    cell.majorant = std::max(cell.majorant, v.hi);
    cell.spread = std::max(cell.spread, v.hi - v.lo);
  }
  for (const std::size_t k : quantities_) {
    if (!uniform || empty) break;
    const vm::ValueBounds v = whole(k);
    const bool coefficient = std::find(coefficients_.begin(), coefficients_.end(), k) != coefficients_.end();
    uniform = !v.may_be_nan && v.hi - v.lo <= 1e-6f * std::abs(v.hi) && v.hi <= largest_coefficient &&
              (v.lo >= 0 || !coefficient);
  }
  cell.kind = empty ? CellKind::empty : uniform ? CellKind::uniform : CellKind::varying;
  return cell;
}

std::unique_ptr<MajorantGrid::Brick> MajorantGrid::computed(const std::array<std::uint32_t, 3>& at,
                                                            BoundsScratch& scratch) const {
  const auto corner = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return domain_.box.lo + Vec3d{(at[0] * brick_side + x) * cell_size_.x,
                                  (at[1] * brick_side + y) * cell_size_.y,
                                  (at[2] * brick_side + z) * cell_size_.z};
  };
  auto brick = std::make_unique<Brick>();
  add_box(corner(0, 0, 0), corner(brick_side, brick_side, brick_side), scratch);
  evaluate(1, scratch);
  brick->whole = summary(0, 1, 1, scratch);
  if (brick->whole.kind != CellKind::varying) return brick;

  for (std::uint32_t z = 0; z < brick_side; ++z)
    for (std::uint32_t y = 0; y < brick_side; ++y)
      for (std::uint32_t x = 0; x < brick_side; ++x)
        add_box(corner(x, y, z), corner(x + 1, y + 1, z + 1), scratch);
  evaluate(brick_cells, scratch);
  auto cells = std::make_unique<Brick::Cells>();
  scratch.loose.clear();
  const auto set = [&](std::uint32_t i, const CellBounds& b) {
    cells->minorant[i] = b.minorant;
    cells->majorant[i] = b.majorant;
    cells->spread[i] = b.spread;
    cells->kind[i] = b.kind;
  };
  for (std::uint32_t i = 0; i < brick_cells; ++i) {
    const CellBounds b = summary(i, 1, brick_cells, scratch);
    set(i, b);
    if (b.kind == CellKind::varying && b.majorant - b.minorant > loose_share * b.majorant)
      scratch.loose.push_back(i);
  }
  // Once more, in halves along each axis. A cell's bounds are those of its eight parts together.
  for (const std::uint32_t i : scratch.loose) {
    const Vec3d lo = corner(i % brick_side, i / brick_side % brick_side, i / (brick_side * brick_side));
    const Vec3d half = cell_size_ * 0.5;
    for (unsigned part = 0; part < 8; ++part) {
      const Vec3d low = lo + Vec3d{part & 1 ? half.x : 0, part & 2 ? half.y : 0, part & 4 ? half.z : 0};
      add_box(low, low + half, scratch);
    }
  }
  const std::size_t boxes = scratch.loose.size() * 8;
  evaluate(boxes, scratch);
  for (std::size_t k = 0; k < scratch.loose.size(); ++k)
    set(scratch.loose[k], summary(k * 8, 8, boxes, scratch));
  cells->empty_block = empty_blocks(cells->kind);
  if (!std::all_of(cells->kind.begin(), cells->kind.end(), [](CellKind k) { return k == CellKind::empty; }))
    brick->cells = std::move(cells);
  else
    brick->whole = {0, 0, 0, CellKind::empty};
  return brick;
}

}  // namespace tyndall::compile
