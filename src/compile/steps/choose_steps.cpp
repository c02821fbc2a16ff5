#include "compile/steps/choose_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "compile/steps/pilot_group.h"

namespace tyndall::compile {

namespace {

constexpr std::size_t lines_of_a_kind = 48;
// Places on a line: at first, and at most.
constexpr std::size_t first_places = 256, most_places = 4096;
// For graded steps so many times as many, at as many times fewer lines, until there are the most.
constexpr std::size_t closer = 8, most_graded_places = 64 * most_places;
// Of the shortest segments that so many places tell about.
constexpr std::size_t places_a_segment = 4;
// A ray is cut into no more (render/march/segment_limit.h).
constexpr double most_segments = 4096;

// Evenly chosen ones of many.
void thin_out(std::vector<PilotLine>& lines, std::size_t most) {
  if (lines.size() <= most) return;
  for (std::size_t i = 0; i < most; ++i) lines[i] = lines[i * lines.size() / most];
  lines.resize(most);
}

// How far a step is from what is wanted, in the measure of the bias that is tolerated: fire that is bright in
// few places is marched without noise that samples would have to remove.
double excess_of(const PilotEstimate& estimate, double tolerance) {
  constexpr double most_noise = 0.02;
  return std::max(estimate.bias, tolerance * estimate.noise / most_noise);
}

// A step of a group [m], or the most spread of a graded one, and how far off it is.
struct EstimatedStep {
  double size = 0, bias = 0;
};

// The power of the step that its bias goes with, from the biases of a step and of half of it.
double order_of(double coarse, double fine) {
  return fine > 0 && coarse > fine ? std::clamp(std::log2(coarse / fine), 1.0, 3.0) : 1.0;
}

// Of steps, each half of the one before, the coarsest from which on the bias is below the tolerance; between
// it and the one before, the place where a power of the step would reach the tolerance. Nothing when even the
// last is too coarse.
std::optional<EstimatedStep> coarsest_within(const std::vector<EstimatedStep>& steps, double tolerance) {
  std::size_t k = steps.size();
  while (k > 0 && steps[k - 1].bias <= tolerance) --k;
  if (k == steps.size()) return std::nullopt;
  if (k == 0 || steps[k].bias == 0) return steps[k];
  const EstimatedStep &coarse = steps[k - 1], &fine = steps[k];
  const double share = std::log(tolerance / fine.bias) / std::log(coarse.bias / fine.bias);
  return EstimatedStep{fine.size * std::pow(coarse.size / fine.size, share), tolerance};
}

// Looks closer until the coarsest step within the tolerance is among those that it tells about. Where even
// the shortest of them are too long, what they tell is carried on, to the finest step that there is.
EstimatedStep step_within(Pilot& pilot, double tolerance, PilotGroup& group) {
  const double longest = group.longest();
  std::vector<EstimatedStep> steps;
  for (std::size_t places = first_places; places <= most_places; places *= 4) {
    if (places > first_places) {
      thin_out(group.seen, (group.seen.size() + 1) / 2);
      thin_out(group.paths, (group.paths.size() + 1) / 2);
    }
    group.look(pilot, places);
    const double shortest = longest * places_a_segment / static_cast<double>(places);
    steps.clear();
    for (double step = group.widest; steps.empty() || step >= shortest; step /= 2)
      steps.push_back({step, excess_of(group.estimate(step), tolerance)});
    if (const auto chosen = coarsest_within(steps, tolerance))
      return {chosen->size, group.estimate(chosen->size).bias};
  }
  const EstimatedStep finest = steps.back();  // further off than is tolerated
  const double order = order_of(steps.size() > 1 ? steps[steps.size() - 2].bias : finest.bias, finest.bias);
  const double metres =
      std::max(finest.size * std::pow(tolerance / finest.bias, 1 / order), longest / most_segments);
  return {metres, finest.bias * std::pow(metres / finest.size, order)};
}

// The coarsest graded step within the tolerance, by what the group's lines tell, if it takes fewer segments.
std::optional<EstimatedStep> coarsest_graded(double tolerance, double segments, const PilotGroup& group) {
  float most = 0;
  for (const auto* lines : {&group.seen_cells, &group.path_cells})
    for (const std::vector<LineCell>& cells : *lines)
      for (const LineCell& cell : cells) most = std::max(most, cell.bounds.spread);
  std::vector<EstimatedStep> steps;
  double spread = group.widest * double{most};
  for (; spread > 0 && group.graded_segments(spread) < segments; spread /= 2)
    steps.push_back({spread, excess_of(group.graded_estimate(spread), tolerance)});
  return coarsest_within(steps, tolerance);
}

// Steps that change from cell to cell, where they keep the tolerance with half the segments of a step that
// does not: where a medium is rough in few places.
std::optional<EstimatedStep> graded_within(const CompiledScene& world, Pilot& pilot, double tolerance,
                                           double metres, PilotGroup& group) {
  // Below, walks through the grid would take what they save.
  constexpr double least_segments = 128;
  const double segments = group.segments(metres);
  if (segments < least_segments) return std::nullopt;
  BoundsScratch scratch;
  group.find_cells(world, scratch);
  std::optional<EstimatedStep> chosen = coarsest_graded(tolerance, segments / 2, group);
  // What is thinner than places are apart takes a closer look, at fewer lines.
  for (std::size_t places = most_places; places < most_graded_places;) {
    const double shortest = chosen ? group.shortest_graded(chosen->size) : metres;
    if (shortest >= group.longest() * places_a_segment / static_cast<double>(places)) break;
    places *= closer;
    for (auto* lines : {&group.seen, &group.paths}) thin_out(*lines, (lines->size() + closer - 1) / closer);
    group.look(pilot, places);
    group.find_cells(world, scratch);
    chosen = coarsest_graded(tolerance, segments / 2, group);
  }
  if (chosen) chosen->bias = group.graded_estimate(chosen->size).bias;
  return chosen;
}

// Of a step that is given.
double bias_of_given(Pilot& pilot, PilotGroup& group) {
  group.look(pilot, first_places);
  const double longest = group.longest(),
               shortest = longest * places_a_segment / static_cast<double>(first_places),
               step = std::max(group.step.metres, longest / most_segments);
  if (step >= shortest) return group.estimate(step).bias;
  const double bias = group.estimate(shortest).bias;
  return bias * std::pow(step / shortest, order_of(group.estimate(2 * shortest).bias, bias));
}

std::vector<PilotGroup> groups_of(const CompiledScene& world) {
  // The grid, and how the volume is turned and scaled; its step.
  using Key = std::array<double, 13>;
  std::map<Key, std::size_t> known;
  std::vector<PilotGroup> groups;
  for (std::uint32_t v = 0; v < world.volumes.size(); ++v) {
    const CompiledVolume& volume = world.volumes[v];
    if (volume.grid == no_index) continue;
    const Transform& t = volume.medium_from_render;
    const double unit = 1e-6 * (length(t.x) + length(t.y) + length(t.z));
    Key key{double(volume.grid), volume.step.metres, volume.step.tolerance, volume.step.proven ? 1.0 : 0.0};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      key[4 + axis] = std::round(t.x[axis] / unit);
      key[7 + axis] = std::round(t.y[axis] / unit);
      key[10 + axis] = std::round(t.z[axis] / unit);
    }
    const auto [at, added] = known.emplace(key, groups.size());
    if (added) groups.push_back({volume.step});
    PilotGroup& group = groups[at->second];
    group.volumes.push_back(v);
    group.widest = std::min(group.widest, volume.widest_step);
    group.scatters = world.media[volume.medium].scatters();
  }
  return groups;
}

// Its lines. Where light is scattered is known when the camera's lines are.
void lay_lines(const CompiledScene& world, const SeenLines& seen, Pilot& pilot, PilotGroup& group) {
  for (const std::uint32_t v : group.volumes)
    group.seen.insert(group.seen.end(), seen.of_volume[v].begin(), seen.of_volume[v].end());
  group.seen_share = std::min(1.0, static_cast<double>(group.seen.size()) / static_cast<double>(seen.rays));
  thin_out(group.seen, lines_of_a_kind);
  if (group.seen.size() < lines_of_a_kind / 4)
    for (std::uint64_t k = 0; k < 2 * lines_of_a_kind && group.seen.size() < lines_of_a_kind; ++k) {
      const PilotLine line = line_through(world, group.volumes[k % group.volumes.size()], k);
      if (line.t1 > line.t0) group.seen.push_back(line);
    }
  const std::vector<LineProfile> profiles = pilot.profiles(group.seen, first_places / 4);
  for (std::size_t i = 0; i < group.seen.size(); ++i) {
    const PilotLine& from = group.seen[i];
    const double t = from.t0 + profiles[i].place_of_share(pilot_random(i, 5));
    const PilotLine line =
        line_from(world, from.ray.origin + from.ray.direction * t, from.ray.time, from.volume, i);
    if (line.t1 > line.t0) group.paths.push_back(line);
  }
}

// Gives the group's volumes a step; tells which, and how far off it is.
EstimatedStep choose(CompiledScene& world, Pilot& pilot, PilotGroup& group) {
  EstimatedStep step{group.widest};  // where nothing is
  std::optional<EstimatedStep> graded;
  if (!group.seen.empty()) {
    step = step_within(pilot, group.step.tolerance, group);
    graded = graded_within(world, pilot, group.step.tolerance, step.size, group);
  }
  if (graded) step = {group.widest, graded->bias};
  for (const std::uint32_t v : group.volumes) {
    world.volumes[v].step.metres = step.size;
    world.volumes[v].most_spread = graded ? graded->size : 0;
  }
  return step;
}

}  // namespace

void choose_steps(CompiledScene& world) {
  std::vector<PilotGroup> groups = groups_of(world);
  for (const PilotGroup& group : groups)
    if (group.step.proven) world.step_bias.proven = std::max(world.step_bias.proven, group.step.tolerance);
  std::erase_if(groups, [](const PilotGroup& group) { return group.step.proven; });
  if (groups.empty()) return;
  const SeenLines seen = seen_lines(world);
  Pilot pilot(world);
  StepBias& told = world.step_bias;
  told.known = true;
  for (PilotGroup& group : groups) {
    lay_lines(world, seen, pilot, group);
    EstimatedStep step{group.step.metres};
    if (!group.step.fixed())
      step = choose(world, pilot, group);
    else if (!group.seen.empty())
      step.bias = bias_of_given(pilot, group);
    const double share = group.seen_share * step.bias;
    told.share += share;
    if (!(share > told.worst_share)) continue;
    told.worst_share = share;
    told.worst = told.enough = step.size;
    if (group.step.fixed() && step.bias > scene::Step::usual_tolerance)
      told.enough = step_within(pilot, scene::Step::usual_tolerance, group).size;
  }
}

}  // namespace tyndall::compile
