#include "render/run_counts.h"

#include <cmath>
#include <set>

namespace tyndall::render {

namespace {

using compile::CompiledScene;

// Adds what a thread ran of each shader.
void sum_lanes(Statistics& total, const ThreadContext& thread, const CompiledScene& world) {
  const std::vector<scene::Material>& materials = world.scene.materials;
  total.medium_lanes.resize(2 * world.media.size());
  total.material_lanes.resize(materials.size());
  std::set<std::uint64_t> seen;
  const auto add = [&](std::vector<std::uint64_t>& sum, const vm::Program& program) {
    sum.resize(program.lane_code.size());
    if (!seen.insert(program.fingerprint).second) return;
    const std::vector<std::uint64_t> lanes = thread.machine.lanes_run(program);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += lanes[i];
  };
  for (std::size_t i = 0; i < world.media.size(); ++i) {
    add(total.medium_lanes[2 * i], world.media[i].full);
    add(total.medium_lanes[2 * i + 1], world.media[i].extinction);
  }
  for (std::size_t i = 0; i < materials.size(); ++i) add(total.material_lanes[i], materials[i].program);
}

// Indices of refraction are found out when the scene is compiled.
void note_bad_iors(const CompiledScene& world, BadValueCounts& counts) {
  for (std::uint32_t i = 0; i < world.materials.size(); ++i)
    if (const auto ior = world.materials[i].bad_ior)
      counts.add_material(i, *world.scene.materials[i].ior,
                          std::isnan(*ior) ? BadValue::Kind::undefined
                          : *ior < 1       ? BadValue::Kind::below
                                           : BadValue::Kind::above,
                          world.materials[i].bad_ior_branch);
}

// Calls f with each number that is a plain sum, of a and of b.
template <class A, class B, class F>
void each_sum(A& a, B& b, F&& f) {
  const auto each = [&](auto... member) { (f(a.*member, b.*member), ...); };
  using S = Statistics;
  each(&S::samples, &S::rays, &S::shadow_rays, &S::marches, &S::segments, &S::vm_runs, &S::lanes_issued,
       &S::lanes_used, &S::vm_instructions, &S::bad_samples, &S::cut_majorants, &S::clipped_samples,
       &S::light, &S::lost_light, &S::cut_paths, &S::cut_throughput);
}

// Calls f with each other number that is carried from run to run.
template <class S, class F>
void each_other(S& s, F&& f) {
  for (auto* shortfall : {&s.widened_steps, &s.missed_tolerances}) {
    f(shortfall->rays);
    f(shortfall->asked);
    f(shortfall->reached);
  }
  for (auto* color : {&s.cut_light.from, &s.cut_light.cut, &s.cut_light.found})
    for (double* number : {&color->x, &color->y, &color->z}) f(*number);
  f(s.seconds);
}

}  // namespace

void RunCounts::add(const ThreadContext& thread, const CompiledScene& world) {
  Statistics s = thread.statistics;
  s.vm_runs = thread.machine.counters().runs;
  s.lanes_issued = thread.machine.counters().lanes_issued;
  s.lanes_used = thread.machine.counters().lanes_used;
  s.vm_instructions = thread.machine.counters().instructions;
  each_sum(sums, s, [](auto& total, auto number) { total += number; });
  sums.widened_steps.add_all(s.widened_steps);
  sums.missed_tolerances.add_all(s.missed_tolerances);
  sums.cut_light.add_all(s.cut_light);
  sums.clamped_light.add_all(s.clamped_light);
  const auto& bad = s.first_bad_sample;
  if (bad && (!sums.first_bad_sample || *bad < *sums.first_bad_sample)) sums.first_bad_sample = bad;
  sum_lanes(sums, thread, world);
  bad_values.add_all(thread.bad_values);
}

Statistics RunCounts::finished(const CompiledScene& world) const {
  Statistics total = sums;
  if (total.samples > 0) total.cut_throughput /= static_cast<double>(total.samples);
  BadValueCounts all = bad_values;
  note_bad_iors(world, all);
  total.bad_values = all.list(world);
  total.step_bias = world.step_bias;
  for (const compile::CoarseField& field : world.coarse_fields)
    total.bad_values.push_back(
        {BadValue::Kind::coarse, field.span, field.shader, 0, field.name, 0, double{field.reach}});
  return total;
}

void RunCounts::save(ByteWriter& out) const {
  Statistics s = sums;
  each_sum(s, s, [&out](auto number, auto) { out.put(number); });
  each_other(s, [&out](auto number) { out.put(number); });
  s.clamped_light.each([&out](const FixedSum& sum) {
    const auto [upper, lower] = sum.halves();
    out.put(upper);
    out.put(lower);
  });
  out.put(s.first_bad_sample.has_value());
  const Statistics::BadSample bad = s.first_bad_sample.value_or(Statistics::BadSample{});
  out.put(bad.sample);
  out.put(bad.y);
  out.put(bad.x);
  bad_values.save(out);
}

bool RunCounts::restore(ByteReader& in, const CompiledScene& world) {
  each_sum(sums, sums, [&in](auto& number, auto&) { in.take(number); });
  each_other(sums, [&in](auto& number) { in.take(number); });
  sums.clamped_light.each([&in](FixedSum& sum) {
    const auto upper = in.take<std::uint64_t>();
    sum = FixedSum::of_halves(upper, in.take<std::uint64_t>());
  });
  bool any_bad = false;
  in.take(any_bad);
  Statistics::BadSample bad;
  in.take(bad.sample);
  in.take(bad.y);
  in.take(bad.x);
  if (any_bad) sums.first_bad_sample = bad;
  return bad_values.restore(in, world);
}

}  // namespace tyndall::render
