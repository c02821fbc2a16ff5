#include "tools/picture_output.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "image/files.h"
#include "image/image.h"
#include "render/film/part_file.h"
#include "tools/denoising.h"
#include "tools/part_facts.h"
#include "tools/report.h"
#include "tools/run_report.h"
#include "tools/staleness.h"
#include "tools/stopwatch.h"

namespace tyndall::tools {

namespace {

namespace fs = std::filesystem;

constexpr double usual_interval = 10;   // between two checkpoints [s of rendering]
constexpr double most_cost = 1.0 / 50;  // of the time, for them

}  // namespace

std::string checkpoint_path(const std::string& output) { return output + std::string(checkpoint_extension); }

void remove_checkpoint(const std::string& output) {
  std::error_code ignored;
  fs::remove(checkpoint_path(output), ignored);
}

std::string output_path_problem(const std::string& path) {
  return is_part(path) ? image::check_file_writable(path) : image::check_writable(path);
}

PictureOutput::PictureOutput(const RenderArguments& arguments, const scene::Scene& scene,
                             PictureIdentity identity)
    : arguments_(arguments),
      scene_(scene),
      identity_(std::move(identity)),
      checkpoint_(image::appears_whole(arguments.output) ? checkpoint_path(arguments.output) : std::string()),
      next_(checkpoint_.empty() ? infinity : arguments.checkpoint_interval.value_or(usual_interval)) {}

std::optional<render::Unfinished> PictureOutput::unfinished(const compile::CompiledScene& world,
                                                            const render::RenderOptions& options) {
  if (checkpoint_.empty()) return std::nullopt;
  for (const std::string& path : {arguments_.output, checkpoint_}) image::remove_leftovers(path);
  std::error_code failed;
  if (!fs::exists(checkpoint_, failed)) return std::nullopt;
  const render::PartText text = render::read_part_text(checkpoint_);
  const auto facts = part_facts_from(text.text);
  std::string problem = text.error;
  if (problem.empty() && !(facts && facts->is_checkpoint))
    problem = fmt::format("'{}' is no checkpoint", checkpoint_);
  if (problem.empty())
    if (const auto differing = differences(facts->identity, identity_); !differing.empty())
      problem = fmt::format("'{}' is of another picture: {}", checkpoint_, fmt::join(differing, ", "));
  if (!arguments_.resume) {
    if (problem.empty())
      print_warning(fmt::format("'{}' has a part of this picture, and is not used: --resume goes on from it",
                                checkpoint_));
    return std::nullopt;
  }
  if (problem.empty()) {
    render::PartResult read = render::read_part(checkpoint_);
    if (read.part) {
      if (facts->identity.simd != identity_.simd)
        print_warning(fmt::format("'{}' was computed with {}, and this is {}: last digits may differ",
                                  checkpoint_, facts->identity.simd, identity_.simd));
      render::Unfinished from{std::move(read.part->film), std::move(read.part->rest)};
      if (render::fits(world, options, from)) {
        if (!arguments_.quiet) print_message(fmt::format("{}: rendering goes on from there\n", checkpoint_));
        return from;
      }
      read.error = fmt::format("'{}' does not fit the scene", checkpoint_);
    }
    problem = read.error;
  }
  print_warning(problem + "; rendering begins anew");
  return std::nullopt;
}

image::Image PictureOutput::picture(const render::Film& film) const {
  return picture_to_write(film, arguments_.denoise, arguments_.output, arguments_.threads);
}

image::Metadata PictureOutput::metadata(const render::Statistics& statistics) const {
  return metadata_of(identity_, {samples_text(arguments_, scene_, statistics),
                                 clamped_light(scene_, statistics), step_bias_text(arguments_, statistics)});
}

void PictureOutput::tell_failure(const std::string& problem) {
  if (problem.empty() || std::exchange(told_failure_, true)) return;
  print_warning(fmt::format("{}; rendering goes on, and what was written before stays", problem));
}

bool PictureOutput::is_finished_by_another() const {
  if (!arguments_.resume) return false;
  const auto there = identity_of_finished(arguments_.output);
  return there && differences(*there, identity_, arguments_.output).empty();
}

std::string PictureOutput::write_checkpoint(const render::Film& film, const std::string& rest) {
  return render::write_part(checkpoint_, to_text({identity_, true}), film, rest);
}

void PictureOutput::save(const render::Film& film, const render::Statistics& so_far,
                         const std::string& rest) {
  if (!is_due(so_far.seconds)) return;
  Stopwatch watch;
  tell_failure(write_checkpoint(film, rest));
  // With --strict it is not known yet whether there will be any picture.
  if (!arguments_.strict && !is_part(arguments_.output) && so_far.pixels_without_samples == 0 &&
      !is_finished_by_another()) {
    image::Metadata so_far_told = metadata(so_far);
    so_far_told.emplace_back("tyndall:unfinished", fmt::format("{} samples so far", so_far.samples));
    tell_failure(image::write(arguments_.output, picture(film), so_far_told, view_in(identity_)));
  }
  const double seconds = watch.lap();
  next_ = so_far.seconds + seconds +
          arguments_.checkpoint_interval.value_or(std::max(usual_interval, seconds / most_cost));
}

std::string PictureOutput::write_output(const render::RenderResult& result) const {
  const render::Statistics& statistics = result.statistics;
  if (is_part(arguments_.output)) {
    if (statistics.stopped) return {};
    return render::write_part(arguments_.output,
                              to_text({identity_, false, clamped_light(scene_, statistics),
                                       step_bias_text(arguments_, statistics)}),
                              result.film, {});
  }
  if (statistics.stopped && is_finished_by_another()) return {};
  image::Metadata told = metadata(statistics);
  if (statistics.stopped)
    told.emplace_back("tyndall:interrupted", fmt::format("after {} samples in all", statistics.samples));
  return image::write(arguments_.output, picture(result.film), told, view_in(identity_));
}

std::string PictureOutput::finish(const render::RenderResult& result) {
  const bool ended = !result.statistics.stopped;
  if (!ended && !checkpoint_.empty())
    if (const std::string problem = write_checkpoint(result.film, result.rest); !problem.empty())
      print_warning(problem);
  std::string problem = write_output(result);
  if (problem.empty()) {
    if (ended) discard();
    return problem;
  }
  if (checkpoint_.empty()) return problem;
  // Perhaps there is room for this; if not, what there was before stays.
  if (ended) write_checkpoint(result.film, result.rest);
  std::error_code failed;
  if (fs::exists(checkpoint_, failed))
    problem += fmt::format("; '{}' keeps what was rendered: --resume goes on from it", checkpoint_);
  return problem;
}

void PictureOutput::discard() const {
  if (!checkpoint_.empty()) remove_checkpoint(arguments_.output);
}

}  // namespace tyndall::tools
