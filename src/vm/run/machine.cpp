// Cuts a batch into chunks, says where their values are, and runs the program's steps over them.
#include "vm/run/machine.h"

#include <algorithm>
#include <chrono>
#include <unordered_map>

#include "base/check.h"
#include "vm/run/bound_program.h"

namespace tyndall::vm {

// What the machine knows of the programs that it has run.
struct Machine::Memory {
  Rows rows;
  std::unordered_map<std::uint64_t, Prepared> programs;  // by fingerprint
  std::uint64_t last_fingerprint = 0;
  Prepared* last = nullptr;

  // The program's layout for the SIMD class in use.
  Prepared& prepared(const Program& program) {
    const auto current = [](const Prepared& p) { return p.functions().data() == step_functions().data(); };
    if (program.fingerprint != 0) {
      if (program.fingerprint == last_fingerprint && current(*last)) return *last;
      const auto found = programs.find(program.fingerprint);
      if (found != programs.end() && current(found->second)) return remember(program, found->second);
    }
    return remember(program,
                    programs.insert_or_assign(program.fingerprint, Prepared(program, rows)).first->second);
  }
  Prepared& remember(const Program& program, Prepared& prepared) {
    last_fingerprint = program.fingerprint;
    last = &prepared;
    return prepared;
  }
};

Machine::Machine() : memory_(std::make_unique<Memory>()) {}
Machine::~Machine() = default;

namespace {

// The first `lanes` values, and the last of them again up to `padded`: what fills up a vector is ordinary,
// too.
void copy_padded(const float* from, std::size_t lanes, std::size_t padded, float* to) {
  std::copy_n(from, lanes, to);
  std::fill(to + lanes, to + padded, from[lanes - 1]);
}

// One chunk of a batch: lanes [begin, begin + used), computed in `issued` lanes. Whole vectors are read and
// written where the caller has them; otherwise there are copies.
struct Chunk {
  Prepared& prepared;
  const Program& program;
  const BatchInputs& inputs;
  std::span<float* const> outputs;
  std::size_t begin, used, issued;

  void read_inputs() const {
    for (std::size_t k = 0; k < program.inputs.size(); ++k) {
      const Input input = program.inputs[k];
      if (is_uniform(input)) continue;
      CHECK(inputs[input] != nullptr);
      const float* const from = inputs[input] + begin;
      if (issued != used) copy_padded(from, used, issued, prepared.input_row(k));
      prepared.read_input(k, issued == used ? from : nullptr);
    }
  }
  void place_outputs() const {
    for (std::size_t k = 0; k < outputs.size(); ++k)
      if (prepared.outputs()[k].row) prepared.write_output(k, issued == used ? outputs[k] + begin : nullptr);
  }
  void finish_outputs() const {
    if (issued == used && prepared.outputs_are_rows()) return;
    for (std::size_t k = 0; k < outputs.size(); ++k) {
      const Prepared::Output& output = prepared.outputs()[k];
      float* const to = outputs[k] + begin;
      if (output.uniform)
        std::fill_n(to, used, *output.uniform);
      else if (output.input >= 0)
        std::copy_n(inputs[program.inputs[static_cast<std::size_t>(output.input)]] + begin, used, to);
      else if (output.same_as >= 0)
        std::copy_n(outputs[static_cast<std::size_t>(output.same_as)] + begin, used, to);
      else if (issued != used)
        std::copy_n(output.row, used, to);
    }
  }
};

// Guards skip whole groups of lanes.
constexpr std::size_t guard_group = widest_vector;

// Runs steps over lanes of a chunk, and counts them.
struct Runner {
  Prepared& prepared;
  std::uint64_t instructions = 0;

  // Steps [begin, end) over lanes [first, first + lanes); `guard` is the first one in there.
  void run(std::uint32_t begin, std::uint32_t end, std::uint32_t guard, std::size_t first,
           std::size_t lanes) {
    auto& guards = prepared.guards();
    while (begin < end) {
      const bool guarded = guard < guards.size() && guards[guard].first < end;
      const std::uint32_t stop = guarded ? guards[guard].first : end;
      instructions += stop - begin;
      const Step* const steps = prepared.steps().data();
      for (const Step *step = steps + begin, *last = steps + stop; step != last; ++step)
        step->run(*step, first, lanes);
      if (!guarded) return;
      run_guarded(guard, first, lanes);
      begin = guards[guard].last;
      guard = guards[guard].next;
    }
  }

  // The guard's steps, over runs of groups in which it lets some lane pass.
  void run_guarded(std::uint32_t index, std::size_t first, std::size_t lanes) {
    Prepared::Guard& guard = prepared.guards()[index];
    const std::size_t end = first + lanes;
    for (std::size_t at = first; at < end;) {
      std::size_t interval = at;
      while (interval < end && passes(guard, interval, std::min(end - interval, guard_group)))
        interval += std::min(end - interval, guard_group);
      if (interval > at) {
        guard.lanes_run += interval - at;
        run(guard.first, guard.last, index + 1, at, interval - at);
      }
      at = interval + guard_group;
    }
  }

  static bool passes(const Prepared::Guard& guard, std::size_t first, std::size_t lanes) {
    const float* const condition = guard.condition + (first & guard.lane_mask);
    unsigned set = 0, clear = 0;
    if (guard.lane_mask == 0) lanes = 1;
    for (std::size_t i = 0; i < lanes; ++i) {
      set |= condition[i] != 0;
      clear |= condition[i] == 0;
    }
    return (guard.when ? set : clear) != 0;
  }
};

}  // namespace

void Machine::run(const Program& program, const BatchInputs& inputs, std::size_t lanes,
                  std::span<float* const> outputs) {
  CHECK_EQ(outputs.size(), program.outputs.size());
  ++counters_.runs;
  if (lanes == 0) return;
  if (!observer_) return run_chunks(program, inputs, lanes, outputs);
  const auto begin = std::chrono::steady_clock::now();
  run_chunks(program, inputs, lanes, outputs);
  observer_->ran(program, inputs, lanes,
                 std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
}

void Machine::run_chunks(const Program& program, const BatchInputs& inputs, std::size_t lanes,
                         std::span<float* const> outputs) {
  Prepared& prepared = memory_->prepared(program);
  prepared.set_uniform_inputs(program, inputs);
  const std::size_t vector = prepared.vector_lanes();
  for (std::size_t begin = 0; begin < lanes; begin += max_lanes) {
    const std::size_t used = std::min(max_lanes, lanes - begin),
                      issued = (used + vector - 1) / vector * vector;
    const Chunk chunk{prepared, program, inputs, outputs, begin, used, issued};
    chunk.read_inputs();
    chunk.place_outputs();
    Runner runner{prepared};
    runner.run(0, static_cast<std::uint32_t>(prepared.steps().size()), 0, 0, issued);
    chunk.finish_outputs();
    counters_.lanes_used += used;
    counters_.lanes_issued += issued;
    prepared.lanes_run += issued;
    counters_.instructions += runner.instructions;
  }
}

std::vector<std::uint64_t> Machine::lanes_run(const Program& program) const {
  std::vector<std::uint64_t> lanes(program.lane_code.size(), 0);
  const auto found = memory_->programs.find(program.fingerprint);
  if (program.fingerprint == 0 || found == memory_->programs.end()) return lanes;
  std::fill(lanes.begin(), lanes.end(), found->second.lanes_run);
  for (const Prepared::Guard& guard : found->second.guards())
    std::fill(lanes.begin() + guard.first, lanes.begin() + guard.last, guard.lanes_run);
  return lanes;
}

}  // namespace tyndall::vm
