#include "tools/golden.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <numeric>
#include <span>

#include "base/parallel.h"
#include "image/compare.h"
#include "image/files.h"
#include "image/flip.h"
#include "image/layers.h"
#include "tools/comparison.h"
#include "tools/golden_render.h"
#include "tools/numbers.h"
#include "tools/staleness.h"
#include "vm/run/machine.h"

namespace tyndall::tools {
namespace {

namespace fs = std::filesystem;
using image::Image;

GoldenScene golden_of(const fs::path& scene, const std::string& references) {
  const fs::path folder = references.empty() ? scene.parent_path() : fs::path(references);
  return {scene.string(), (folder / scene.stem()).string() + ".exr"};
}

// Two scenes of one name in two folders, where the references are in a third.
std::string shared_reference(const std::vector<GoldenScene>& scenes) {
  std::map<std::string, std::string> scene_of;
  for (const GoldenScene& golden : scenes)
    if (const auto [other, is_new] = scene_of.emplace(golden.reference, golden.scene);
        !is_new && other->second != golden.scene)
      return fmt::format("'{}' would be the reference of both '{}' and '{}': test them by two commands",
                         golden.reference, other->second, golden.scene);
  return {};
}

// A picture of R, G and B; nothing where it has not all three.
std::optional<Image> colors_of(const Image& image) {
  for (const char* name : {"R", "G", "B"})
    if (std::find(image.channels.begin(), image.channels.end(), name) == image.channels.end())
      return std::nullopt;
  return image::with_channels(image, {"R", "G", "B"});
}

bool equal_bits(const Image& a, const Image& b) {
  return a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(float)) == 0;
}

std::string size_of(const Image& image) { return fmt::format("{}x{}", image.width, image.height); }

// A test while it runs.
class GoldenTest {
 public:
  GoldenTest(const GoldenArguments& arguments, const GoldenScene& golden) : arguments_(arguments) {
    result_.golden = golden;
  }

  GoldenResult run(const std::string& picture_path, int threads) {
    std::error_code ignored;
    const bool is_new = !fs::exists(result_.golden.reference, ignored);
    if (is_new && !arguments_.update)
      return end(
          GoldenOutcome::problem,
          fmt::format("there is no reference '{}': --update renders it; what scenes include belongs into a "
                      "folder of its own",
                      result_.golden.reference));
    if (!is_new && !read_reference()) return std::move(result_);
    const std::optional<std::uint64_t> seed =
        arguments_.statistical && !is_new ? std::optional(new_seed()) : std::nullopt;
    rendered_ = render_like(arguments_, result_.golden.scene, made_, seed, picture_path, threads);
    result_.seconds = rendered_.seconds;
    if (!rendered_.problem.empty()) return end(GoldenOutcome::problem, rendered_.problem);
    note_what_changed();
    if (arguments_.update) return update(is_new);
    return judge();
  }

 private:
  GoldenResult end(GoldenOutcome outcome, std::string message) {
    result_.outcome = outcome;
    result_.message = std::move(message);
    return std::move(result_);
  }
  // What is wrong with the reference is no problem for --update, unless it cannot even be read.
  bool unusable(const std::string& why) {
    if (arguments_.update) return true;
    end_with(fmt::format("the reference '{}' is of no use: {}; --update renders it anew",
                         result_.golden.reference, why));
    return false;
  }
  void end_with(std::string problem) {
    result_.outcome = GoldenOutcome::problem;
    result_.message = std::move(problem);
  }

  bool read_reference() {
    reference_ = image::read(result_.golden.reference);
    if (!reference_.image) return unusable(reference_.error);
    result_.view = reference_.view;
    made_ = identity_from(metadata_entry(reference_.metadata, identity_entry));
    if (!made_) return unusable("Tyndall did not render it, or it does not tell how");
    for (const std::string_view entry : {"tyndall:unfinished", "tyndall:interrupted"})
      if (!metadata_entry(reference_.metadata, entry).empty()) return unusable("its rendering did not end");
    if (const std::string why = why_not_again(*made_); !why.empty()) {
      made_.reset();
      return unusable(why);
    }
    return true;
  }

  std::uint64_t new_seed() const {
    if (arguments_.seed) return *arguments_.seed;
    return made_ ? read_decimal<std::uint64_t>(made_->setting("seed").value).value_or(0) + 1 : 1;
  }

  // The seed and what is tested with it are meant to differ; folders may, for what files in them hold is
  // compared by itself.
  void note_what_changed() {
    if (!made_ || !rendered_.identity) return;
    PictureIdentity is = *rendered_.identity;
    for (const std::string_view name : {"seed", "aov"}) is.setting(name) = made_->setting(name);
    is.include_directories = made_->include_directories;
    const std::vector<std::string> changes = differences(*made_, is);
    if (!changes.empty())
      result_.notes.push_back(fmt::format("since the reference was rendered: {}", fmt::join(changes, ", ")));
    if (made_->simd != is.simd)
      result_.notes.push_back(
          fmt::format("the reference was computed with {}, and this is {}", made_->simd, is.simd));
  }

  // Compares as far as sizes and numbers allow. A message where they do not.
  std::string measure() {
    const auto picture = colors_of(*rendered_.read.image), reference = colors_of(*reference_.image);
    if (!picture || !reference) return "it has not R, G and B";
    result_.picture = picture;
    result_.reference = reference;
    if (picture->width != reference->width || picture->height != reference->height)
      return fmt::format("the picture is {}, its reference {}", size_of(*picture), size_of(*reference));
    if (equal_bits(*picture, *reference)) {
      result_.relative_mse = result_.flip = 0;
      return {};
    }
    for (const auto& [what, image] : {std::pair("the picture", &picture), {"the reference", &reference}})
      if (const std::string bad = image::first_not_finite(**image); !bad.empty())
        return fmt::format("{} has {}", what, bad);
    const image::Comparison comparison = image::compare(*picture, *reference);
    result_.relative_mse = comparison.relative_mse;
    max_difference_ = comparison.max_difference;
    if (comparison.reference_mean != 0) mean_change_ = comparison.mean / comparison.reference_mean - 1;
    result_.errors = image::flip_hdr(*picture, *reference);
    result_.flip = std::accumulate(result_.errors->pixels.begin(), result_.errors->pixels.end(), 0.0) /
                   std::max(static_cast<double>(result_.errors->pixels.size()), 1.0);
    return {};
  }

  std::string numbers() const {
    return fmt::format("relmse {:.3g}, FLIP {:.3g}, largest difference {:.3g}, mean {:+.2f} %",
                       result_.relative_mse.value_or(0), result_.flip.value_or(0), max_difference_,
                       100 * mean_change_);
  }

  GoldenResult judge() {
    if (std::string problem = measure(); !problem.empty()) return end(GoldenOutcome::differs, problem);
    GoldenResult result = arguments_.statistical ? judge_by_statistics() : judge_by_pixels();
    if (result.outcome == GoldenOutcome::passed)
      result.picture = result.reference = result.errors = std::nullopt;
    return result;
  }

  GoldenResult judge_by_pixels() {
    if (*result_.relative_mse == 0 && max_difference_ == 0)
      return end(GoldenOutcome::passed, "equal to the last bit");
    // Between classes of SIMD, or processors, library functions may round differently.
    constexpr double of_rounding = 1e-6;
    const bool same_class = made_->simd == vm::simd_name();
    const double most = arguments_.max.value_or(same_class ? 0 : of_rounding);
    if (*result_.relative_mse <= most)
      return end(GoldenOutcome::passed, fmt::format("{} (at most {:.3g})", numbers(), most));
    return end(GoldenOutcome::differs, numbers());
  }

  GoldenResult judge_by_statistics() {
    const std::uint64_t seed = new_seed();
    if (equal_bits(*result_.picture, *result_.reference) &&
        fmt::format("{}", seed) == made_->setting("seed").value)
      return end(
          GoldenOutcome::problem,
          fmt::format("seed {} is the reference's own: a statistical test wants another --seed", seed));
    result_.z_test = image::z_test(*rendered_.read.image, *reference_.image);
    const bool has_variance =
        result_.z_test && std::find(reference_.image->channels.begin(), reference_.image->channels.end(),
                                    "variance.R") != reference_.image->channels.end();
    if (!has_variance)
      return end(GoldenOutcome::problem,
                 fmt::format("'{}' has no variance: --update renders it with --aov variance",
                             result_.golden.reference));
    const std::string found = fmt::format("seed {}: {}", seed, describe(*result_.z_test, *result_.reference));
    return end(result_.z_test->agrees() ? GoldenOutcome::passed : GoldenOutcome::differs, found);
  }

  GoldenResult update(bool is_new) {
    const bool comparable = !is_new && reference_.image;
    std::string found;
    if (comparable) {
      const std::string problem = measure();
      const bool same = problem.empty() && max_difference_ == 0 && made_ &&
                        reference_.image->channels == rendered_.read.image->channels;
      if (same) return end(GoldenOutcome::unchanged, "equal to the last bit");
      found = problem.empty() ? numbers() : problem;
    }
    std::ifstream file(rendered_.path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    if (std::string problem =
            image::write_file_whole(result_.golden.reference, std::as_bytes(std::span(bytes)));
        !problem.empty())
      return end(GoldenOutcome::problem, std::move(problem));
    if (is_new) return end(GoldenOutcome::created, size_of(*rendered_.read.image));
    if (!comparable) return end(GoldenOutcome::changed, "the one before could not be read");
    return end(GoldenOutcome::changed, found);
  }

  const GoldenArguments& arguments_;
  GoldenResult result_;
  image::ReadResult reference_;
  std::optional<PictureIdentity> made_;  // what the reference was made of
  RenderedPicture rendered_;
  double max_difference_ = 0, mean_change_ = 0;
};

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name"))
      if (const std::size_t colon = line.find(": "); colon != std::string::npos)
        return line.substr(colon + 2);
  return "an unknown processor";
}

}  // namespace

std::string_view name(GoldenOutcome outcome) {
  switch (outcome) {
    case GoldenOutcome::passed:
      return "passed";
    case GoldenOutcome::differs:
      return "differs";
    case GoldenOutcome::problem:
      return "problem";
    case GoldenOutcome::created:
      return "created";
    case GoldenOutcome::changed:
      return "changed";
    case GoldenOutcome::unchanged:
      return "unchanged";
  }
  return "";
}

GoldenScenes find_golden_scenes(const std::vector<std::string>& paths, const std::string& references) {
  GoldenScenes found;
  for (const std::string& path : paths) {
    std::error_code failed;
    if (fs::is_regular_file(path, failed) && path.ends_with(".tyn")) {
      found.scenes.push_back(golden_of(path, references));
      continue;
    }
    if (!fs::is_directory(path, failed)) {
      found.problem = failed && failed != std::errc::no_such_file_or_directory
                          ? fmt::format("cannot read '{}': {}", path, failed.message())
                          : fmt::format("'{}' is neither a folder of scenes nor a scene (.tyn)", path);
      return found;
    }
    const std::size_t before = found.scenes.size();
    std::error_code unreadable;
    for (fs::directory_iterator at(path, unreadable), end; !unreadable && at != end; at.increment(unreadable))
      if (at->path().extension() == ".tyn") found.scenes.push_back(golden_of(at->path(), references));
    if (unreadable) {
      found.problem = fmt::format("cannot read the folder '{}': {}", path, unreadable.message());
      return found;
    }
    if (found.scenes.size() == before) {
      found.problem = fmt::format(
          "the folder '{}' has no scene (.tyn): put a scene there, and render its reference with "
          "tyndall golden {} --update",
          path, path);
      return found;
    }
    std::sort(found.scenes.begin() + static_cast<std::ptrdiff_t>(before), found.scenes.end(),
              [](const GoldenScene& a, const GoldenScene& b) { return a.scene < b.scene; });
  }
  found.problem = shared_reference(found.scenes);
  return found;
}

GoldenResult run_golden(const GoldenArguments& arguments, const GoldenScene& golden,
                        const std::string& directory, std::size_t number, int threads) {
  const std::string path = fmt::format("{}/{}.exr", directory, number);
  GoldenResult result = GoldenTest(arguments, golden).run(path, threads);
  std::error_code ignored;
  fs::remove(path, ignored);
  return result;
}

std::string describe_machine(int threads) {
  const int count = threads > 0 ? threads : hardware_threads();
  return fmt::format("Tyndall {}, {}, {} {} of {}", TYNDALL_VERSION, vm::simd_name(), count,
                     count == 1 ? "thread" : "threads", processor_name());
}

}  // namespace tyndall::tools
