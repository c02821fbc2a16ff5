#include "tools/measure/measuring.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "tools/report.h"
#include "tools/stopwatch.h"

namespace tyndall::tools {
namespace {

// Seeds of the reference begin here, far from those of the settings.
constexpr std::uint64_t reference_seeds = std::uint64_t{1} << 32;

scene::RenderSettings settings_of(const scene::Scene& scene, const RenderArguments& arguments) {
  scene::RenderSettings settings = scene.settings;
  apply(arguments.settings, settings);
  return settings;
}

std::vector<std::string> options_in(const RenderArguments& arguments) {
  const RenderArguments usual;
  std::vector<std::string> options;
  if (arguments.method != usual.method) options.push_back(fmt::format("--method {}", name(arguments.method)));
  if (arguments.distance != usual.distance)
    options.push_back(fmt::format("--distance {}", name(arguments.distance)));
  if (arguments.transmittance != usual.transmittance)
    options.push_back(fmt::format("--transmittance {}", name(arguments.transmittance)));
  if (arguments.emission_sampling != usual.emission_sampling)
    options.push_back(fmt::format("--emission {}", name_in(emissions, arguments.emission_sampling)));
  return options;
}

// All that decides a picture but its seed.
std::string key_of(const scene::Scene& scene, const RenderArguments& arguments, bool has_samples = true) {
  std::string key;
  for (const auto& [name, text] : as_texts(settings_of(scene, arguments)))
    if (name != "seed" && (has_samples || name != "samples")) key += fmt::format("{}={} ", name, text);
  for (const std::string& option : options_in(arguments)) key += option + " ";
  return key;
}

RunCost mean_cost(const std::vector<MeasuredRun>& runs) {
  RunCost mean;
  const auto count = static_cast<double>(runs.size());
  for (const MeasuredRun& run : runs) {
    mean.seconds += run.cost.seconds / count;
    mean.cpu_seconds += run.cost.cpu_seconds / count;
    mean.preparation_cpu_seconds += run.cost.preparation_cpu_seconds / count;
    mean.peak_bytes = std::max(mean.peak_bytes, run.cost.peak_bytes);
  }
  return mean;
}

// The first from there on that no render of this key has, whatever --seed they began with.
std::uint64_t unused_seed(const Measurements& measurements, const std::string& key, std::uint64_t from) {
  std::set<std::uint64_t> used;
  for (const MeasuredRun& run : measurements.runs_of(key)) used.insert(run.seed);
  while (used.contains(from)) ++from;
  return from;
}

RenderSums sums_of(const Measurements& measurements, const std::vector<MeasuredRun>& runs) {
  RenderSums sums;
  for (const MeasuredRun& run : runs) sums.add(measurements.pixels(run));
  return sums;
}

}  // namespace

RenderArguments reference_arguments(const scene::Scene& scene, const std::vector<MeasuredSetting>& settings) {
  RenderArguments arguments = settings[0].arguments;
  arguments.method = render::Method::tracking;
  arguments.transmittance = render::Transmittance::ratio;
  arguments.distance = RenderArguments{}.distance;
  arguments.emission_sampling = RenderArguments{}.emission_sampling;
  GivenSettings& given = arguments.settings;
  const scene::RenderSettings usual;
  given.values.step = usual.step;
  given.values.light_samples = usual.light_samples;
  given.values.multiple_scattering = {};
  given.values.clamp = {};
  given.values.bounces = settings_of(scene, settings[0].arguments).bounces;
  for (const MeasuredSetting& setting : settings)
    given.values.bounces = std::max(given.values.bounces, settings_of(scene, setting.arguments).bounces);
  if (settings[0].value("bounces")) given.values.bounces = std::max(given.values.bounces, usual.bounces);
  for (const std::string_view name : {"step", "light_samples", "multiple_scattering", "clamp", "bounces"})
    given.names.insert(name);
  return arguments;
}

Measuring::Measuring(const scene::Scene& scene, std::vector<MeasuredSetting> settings, MeasureGoals goals,
                     std::optional<Reference> given, Measurements& measurements)
    : scene_(scene),
      settings_(std::move(settings)),
      goals_(goals),
      given_(std::move(given)),
      reference_arguments_(reference_arguments(scene, settings_)),
      reference_key_("reference " + key_of(scene, reference_arguments_, false)),
      measurements_(measurements),
      progress_(settings_.size()) {
  for (const MeasuredSetting& setting : settings_) keys_.push_back(key_of(scene_, setting.arguments));
  reference_progress_.given = given_.has_value();
  reference_progress_.goal = goals_.reference_error;
  note_progress();
}

void Measuring::note_progress() {
  for (std::size_t i = 0; i < settings_.size(); ++i) {
    const std::vector<MeasuredRun> runs = measurements_.runs_of(keys_[i]);
    progress_[i].runs = static_cast<int>(runs.size());
    progress_[i].seconds = mean_cost(runs).seconds;
    if (runs.empty()) continue;
    const double seconds = reference_parts * progress_[i].seconds / runs[0].samples;
    double& expected = reference_progress_.expected_seconds;
    expected = expected > 0 ? std::min(expected, seconds) : seconds;
  }
  if (given_) return;
  reference_progress_.samples = 0;
  reference_progress_.seconds = 0;
  for (const MeasuredRun& run : reference_rounds()) {
    if (run.part == 0) reference_progress_.samples += run.samples;
    reference_progress_.seconds += run.cost.seconds;
  }
}

// Reads the pictures again: done when the order of what comes depends on it.
void Measuring::note_errors() {
  const Reference parts = reference();
  if (parts.parts.empty()) return;
  const WeighedReference truth(parts);
  for (std::size_t i = 0; i < settings_.size(); ++i) {
    const std::vector<MeasuredRun> runs = measurements_.runs_of(keys_[i]);
    if (runs.size() >= 2)
      progress_[i].error = root(truth.accuracy_of(sums_of(measurements_, runs)).relmse).value;
  }
}

// Of the reference those rounds of which all parts are there, so that all parts weigh the same.
std::vector<MeasuredRun> Measuring::reference_rounds() const {
  const std::vector<MeasuredRun> runs = measurements_.runs_of(reference_key_);
  std::map<int, int> parts;
  for (const MeasuredRun& run : runs) ++parts[run.round];
  std::vector<MeasuredRun> whole;
  for (const MeasuredRun& run : runs)
    if (parts[run.round] == reference_parts) whole.push_back(run);
  return whole;
}

Reference Measuring::reference() const {
  if (given_) return *given_;
  Reference made;
  if (reference_progress_.samples == 0) return made;
  std::vector<std::vector<double>> sums(reference_parts);
  for (const MeasuredRun& run : reference_rounds()) {
    const std::vector<float> pixels = measurements_.pixels(run);
    std::vector<double>& sum = sums[static_cast<std::size_t>(run.part)];
    sum.resize(pixels.size());
    const double weight = static_cast<double>(run.samples) / reference_progress_.samples;
    for (std::size_t i = 0; i < pixels.size(); ++i) sum[i] += weight * pixels[i];
  }
  for (std::vector<double>& sum : sums) {
    made.parts.emplace_back(sum.begin(), sum.end());
    sum.clear();
    sum.shrink_to_fit();
  }
  return made;
}

ReferenceFacts Measuring::reference_facts() const {
  ReferenceFacts facts;
  facts.given = given_.has_value();
  const Reference truth = reference();
  facts.parts = static_cast<int>(truth.parts.size());
  facts.samples = facts.given ? 0 : reference_progress_.samples * reference_parts;
  facts.seconds = reference_progress_.seconds;
  for (const std::string& option : options_in(reference_arguments_))
    facts.method += (facts.method.empty() ? "" : " ") + option;
  facts.method += fmt::format(" --bounces {}", reference_arguments_.settings.values.bounces);
  if (truth.parts.size() > 1) facts.error = WeighedReference(truth).error();
  return facts;
}

std::string Measuring::render(const RenderArguments& arguments, MeasuredRun run,
                              const std::atomic<bool>& stop) {
  RenderRun rendered = render_run(scene_, arguments, run.seed, stop);
  if (rendered.stopped) return {};
  if (!rendered.problem.empty()) return fmt::format("a render did not end well: {}", rendered.problem);
  run.cost = rendered.cost;
  return measurements_.add(std::move(run), rendered.pixels);
}

std::string Measuring::do_run(std::size_t setting, const std::atomic<bool>& stop) {
  const RenderArguments& arguments = settings_[setting].arguments;
  const scene::RenderSettings settings = settings_of(scene_, arguments);
  const std::uint64_t seed = unused_seed(measurements_, keys_[setting], settings.seed);
  return render(arguments, {.key = keys_[setting], .seed = seed, .samples = settings.samples}, stop);
}

// A round: each part gets as many samples, with a seed of its own. One that was not ended is gone on with.
std::string Measuring::do_reference(int samples, const std::atomic<bool>& stop) {
  int round = 0, first_part = 0;
  for (const MeasuredRun& run : measurements_.runs_of(reference_key_)) {
    const bool was_ended = run.part + 1 == reference_parts;
    round = was_ended ? run.round + 1 : run.round;
    first_part = was_ended ? 0 : run.part + 1;
    if (!was_ended) samples = run.samples;
  }
  RenderArguments arguments = reference_arguments_;
  arguments.settings.values.samples = samples;
  arguments.settings.names.insert("samples");
  const std::uint64_t first = settings_of(scene_, arguments).seed + reference_seeds;
  std::string problem;
  for (int part = first_part; part < reference_parts && problem.empty() && !stop; ++part)
    problem = render(arguments,
                     {.key = reference_key_,
                      .seed = unused_seed(measurements_, reference_key_, first),
                      .samples = samples,
                      .part = part,
                      .round = round},
                     stop);
  return problem;
}

std::string Measuring::do_task(const Task& task, const std::atomic<bool>& stop) {
  const bool makes_reference = task.kind == Task::Kind::reference;
  const std::string problem = makes_reference ? do_reference(task.samples, stop) : do_run(task.setting, stop);
  note_progress();
  if (makes_reference && problem.empty() && !stop)
    reference_progress_.error = WeighedReference(reference()).error().high;
  return problem;
}

std::string Measuring::told(const Task& task) const {
  if (task.kind == Task::Kind::reference)
    return fmt::format("reference: {} more samples a pixel\n", task.samples * reference_parts);
  return fmt::format("{}: render {} of {}\n", settings_[task.setting].name(),
                     progress_[task.setting].runs + 1, goals_.seeds);
}

std::string Measuring::run(const std::atomic<bool>& stop, bool quiet) {
  const Stopwatch watch;
  if (!given_ && reference_progress_.samples > 0)
    reference_progress_.error = WeighedReference(reference()).error().high;
  bool knows_errors = false;
  while (!stop) {
    const bool all_twice =
        std::all_of(progress_.begin(), progress_.end(), [](const SettingProgress& p) { return p.runs >= 2; });
    if (all_twice && !knows_errors) note_errors(), knows_errors = true;
    const Task task = next_task(progress_, reference_progress_, goals_.seeds,
                                {goals_.budget_seconds, goals_.budget_seconds - watch.seconds()});
    if (task.kind == Task::Kind::none) break;
    if (!quiet) print_message(told(task));
    if (std::string problem = do_task(task, stop); !problem.empty()) return problem;
  }
  return {};
}

std::vector<SettingRow> Measuring::rows() const {
  const Reference parts = reference();
  const WeighedReference truth(parts);
  std::vector<SettingRow> rows;
  for (std::size_t i = 0; i < settings_.size(); ++i) {
    const MeasuredSetting& setting = settings_[i];
    std::vector<MeasuredRun> runs = measurements_.runs_of(keys_[i]);
    SettingRow row{.name = setting.name(),
                   .swept = setting.swept,
                   .settings = settings_of(scene_, setting.arguments),
                   .options = options_in(setting.arguments),
                   .runs = static_cast<int>(runs.size()),
                   .cost = mean_cost(runs)};
    if (runs.size() >= 2 && !parts.parts.empty())
      row.accuracy = truth.accuracy_of(sums_of(measurements_, runs));
    rows.push_back(std::move(row));
  }
  mark_front(rows);
  return rows;
}

std::vector<float> Measuring::first_picture(std::size_t setting) const {
  const std::vector<MeasuredRun> runs = measurements_.runs_of(keys_[setting]);
  return runs.empty() ? std::vector<float>() : measurements_.pixels(runs[0]);
}

std::vector<float> Measuring::mean_picture(std::size_t setting) const {
  const std::vector<MeasuredRun> runs = measurements_.runs_of(keys_[setting]);
  if (runs.empty()) return {};
  const RenderSums sums = sums_of(measurements_, runs);
  std::vector<float> mean(sums.size());
  for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = static_cast<float>(sums.mean(i));
  return mean;
}

}  // namespace tyndall::tools
