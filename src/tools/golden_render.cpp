#include "tools/golden_render.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "tools/child_process.h"
#include "tools/setting_options.h"
#include "tools/stopwatch.h"

namespace tyndall::tools {
namespace {

using Setting = PictureIdentity::Setting;

// The path of this very program.
std::string own_path() {
  std::error_code failed;
  const std::filesystem::path path = std::filesystem::read_symlink("/proc/self/exe", failed);
  return failed ? "tyndall" : path.string();
}

std::string option_of(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  return "--" + name;
}

// As the option takes it: what a scene says in brackets stays the scene's.
std::string option_value(const Setting& setting) {
  return setting.name == "multiple_scattering" ? setting.value.substr(0, setting.value.find('('))
                                               : setting.value;
}

// A folder of --include that the picture was made with, wherever golden is started: if it is not in the
// current folder, in that of the scene, or above it.
std::string found_include(const std::string& directory, const std::string& scene) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (fs::is_directory(directory, ignored) || fs::path(directory).is_absolute()) return directory;
  fs::path above = fs::absolute(scene, ignored).parent_path();
  for (; above.has_relative_path(); above = above.parent_path())
    if (fs::is_directory(above / directory, ignored)) return (above / directory).string();
  return directory;
}

// Those of the command line, or where it has none, those that the picture was made with.
std::vector<std::string> includes_of(const GoldenArguments& arguments, const std::string& scene,
                                     const std::optional<PictureIdentity>& made) {
  if (!arguments.include_directories.empty() || !made) return arguments.include_directories;
  std::vector<std::string> directories;
  for (const std::string& directory : made->include_directories)
    directories.push_back(found_include(directory, scene));
  return directories;
}

// The options that the picture was made with, but for --include.
std::vector<std::string> options_of(const PictureIdentity& made, bool with_seed) {
  std::vector<std::string> options{"--frame", fmt::format("{}", made.frame)};
  for (const auto& [name, value] : made.overrides)
    options.insert(options.end(), {"--set", fmt::format("{}={}", name, value)});
  for (const Setting& setting : made.settings) {
    if (setting.value == setting.scene_value || setting.name == "aov" ||
        (setting.name == "seed" && !with_seed))
      continue;
    options.insert(options.end(), {option_of(setting.name), option_value(setting)});
  }
  return options;
}

// Its output channels, and the variance.
std::string aovs_with_variance(const std::string& aovs) {
  if (aovs.empty()) return "variance";
  return fmt::format(",{},", aovs).find(",variance,") == std::string::npos ? aovs + ",variance" : aovs;
}

}  // namespace

std::string why_not_again(const PictureIdentity& made) {
  for (const std::string_view name : {"error", "time_limit", "denoise"})
    for (const Setting& setting : made.settings)
      if (setting.name == name && !setting.value.empty())
        return fmt::format("it was rendered with {}", option_of(setting.name));
  if (made.crop) return "it was rendered with --crop";
  if (made.samples && made.samples->first > 0) return "it was rendered with --sample-range";
  return {};
}

RenderedPicture render_like(const GoldenArguments& arguments, const std::string& scene,
                            const std::optional<PictureIdentity>& made, std::optional<std::uint64_t> seed,
                            const std::string& output, int threads) {
  std::vector<std::string> command{own_path(), "render",  scene,       "-o",
                                   output,     "--quiet", "--threads", fmt::format("{}", threads)};
  if (made) {
    const std::vector<std::string> options = options_of(*made, !seed);
    command.insert(command.end(), options.begin(), options.end());
  }
  // Groups of samples, which variances come from, change the picture: an old one that has none stays so.
  const std::string aovs = made ? made->setting("aov").value : "";
  const bool wants_variance = !made || seed;
  if (wants_variance || !aovs.empty())
    command.insert(command.end(), {"--aov", wants_variance ? aovs_with_variance(aovs) : aovs});
  if (seed) command.insert(command.end(), {"--seed", fmt::format("{}", *seed)});
  for (const std::string& directory : includes_of(arguments, scene, made))
    command.insert(command.end(), {"--include", directory});
  if (arguments.allow_outside) command.emplace_back("--allow-outside");

  RenderedPicture rendered;
  rendered.path = output;
  Stopwatch watch;
  ChildProcess child(command);
  const bool good = child.finish();
  rendered.seconds = watch.lap();
  if (!good) {
    if (!child.was_killed()) rendered.problem = child.words();
    if (rendered.problem.empty()) rendered.problem = fmt::format("rendering failed: {}", child.problem());
    return rendered;
  }
  rendered.read = image::read(output);
  rendered.problem = rendered.read.error;
  rendered.identity = identity_from(metadata_entry(rendered.read.metadata, identity_entry));
  return rendered;
}

}  // namespace tyndall::tools
