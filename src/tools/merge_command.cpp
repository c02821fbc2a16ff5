// `tyndall merge`: parts of a picture to the whole.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>

#include "image/image.h"
#include "render/film/part_file.h"
#include "tools/commands.h"
#include "tools/denoising.h"
#include "tools/files_in_use.h"
#include "tools/frame_list.h"
#include "tools/memory.h"
#include "tools/merge.h"
#include "tools/numbers.h"
#include "tools/picture_output.h"
#include "tools/report.h"

namespace tyndall::tools {
namespace {

struct MergeArguments {
  MergeRequest request;
  std::string output;
  std::optional<int> frame;  // takes the place of marks in the names
  bool remove_parts = false, quiet = false;
};

ExitStatus problem(const std::string& message) {
  print_error(message);
  return ExitStatus::problem;
}

std::string files_problem(const MergeArguments& arguments) {
  FilesInUse files;
  for (const std::string& part : arguments.request.parts)
    if (std::string said = files.read(part, "the part"); !said.empty()) return said;
  if (std::string said = output_path_problem(arguments.output); !said.empty()) return said;
  return files.write(arguments.output, "-o");
}

std::string write(const MergeArguments& arguments, const Merged& merged) {
  const std::string& output = arguments.output;
  const PictureIdentity& identity = merged.facts.identity;
  if (is_part(output)) {
    if (!merged.gaps.empty())
      return fmt::format("cannot write '{}': a part has the same samples of all of its pixels", output);
    return render::write_part(output, to_text(merged.facts), merged.film, {});
  }
  const std::string& channels = identity.setting("aov").value;
  if (!channels.empty() && !output.ends_with(".exr"))
    return fmt::format("cannot write '{}': the parts have output channels ({}), which only an .exr takes",
                       output, channels);
  const bool whole = merged.gaps.empty();
  image::Metadata metadata =
      metadata_of(identity, {whole ? fmt::format("{}..{}", identity.samples->first, identity.samples->last)
                                   : fmt::format("{} a pixel on average", merged.mean_samples),
                             merged.facts.clamped_light, merged.facts.step_bias});
  if (!whole) metadata.emplace_back("tyndall:unfinished", "parts are missing");
  return image::write(output, picture_to_write(merged.film, identity.is_denoised(), output, 0), metadata,
                      view_in(identity));
}

// A part that cannot be removed costs disk and nothing else.
void remove_parts(const MergeArguments& arguments) {
  if (!arguments.remove_parts) return;
  for (const std::string& part : arguments.request.parts) {
    std::error_code failed;
    std::filesystem::remove(part, failed);
    if (failed) print_warning(fmt::format("cannot remove '{}': {}", part, failed.message()));
  }
}

ExitStatus end_merged_already(const MergeArguments& arguments) {
  remove_parts(arguments);
  if (!arguments.quiet) print_message(fmt::format("{}: it is there already\n", arguments.output));
  return ExitStatus::done;
}

ExitStatus merge_files(const MergeArguments& arguments) {
  // A run that was ended while it removed parts, or another one that does so right now, has left the picture.
  const auto is_done = [&] {
    return arguments.remove_parts && is_merged_already(arguments.request.parts, arguments.output);
  };
  if (is_done()) return end_merged_already(arguments);
  if (const std::string said = files_problem(arguments); !said.empty()) return problem(said);
  const MergeResult result = with_memory("to merge the parts", [&] { return merge(arguments.request); });
  for (const std::string& warning : result.warnings) print_warning(warning);
  if (!result.merged) return is_done() ? end_merged_already(arguments) : problem(result.error);
  const std::string said =
      with_memory("to write the picture", [&] { return write(arguments, *result.merged); });
  if (!said.empty()) return problem(said);
  const std::size_t parts = arguments.request.parts.size();
  if (!arguments.quiet)
    print_message(fmt::format("{}: {} part{}, {:.3g} samples per pixel{}\n", arguments.output, parts,
                              parts == 1 ? "" : "s", result.merged->mean_samples,
                              removed_text(result.merged->facts.clamped_light)));
  remove_parts(arguments);
  return ExitStatus::done;
}

ExitStatus run_merge(MergeArguments arguments) {
  if (arguments.remove_parts && arguments.request.incomplete)
    return misuse("--remove-parts does not go with --incomplete: the parts are needed for the whole picture");
  if (const auto& frame = arguments.frame) {
    for (std::string& part : arguments.request.parts) part = numbered(part, *frame);
    arguments.output = numbered(arguments.output, *frame);
  }
  return merge_files(arguments);
}

Action merge_options(CLI::App& command) {
  const auto arguments = std::make_shared<MergeArguments>();
  command.add_option("parts", arguments->request.parts, "The parts: .tynpart files that render wrote")
      ->required()
      ->option_text("PART...");
  command
      .add_option("-o,--output", arguments->output,
                  "The picture to write: .exr, .png, .jpg or .tif; or a larger .tynpart")
      ->required()
      ->option_text("OUT");
  command.add_flag("--incomplete", arguments->request.incomplete,
                   "Write what there is when parts are missing; what no part has is black");
  add_whole(command, "--frame", arguments->frame,
            "The frame whose number stands for #### in the names of the parts and of the output");
  command.add_flag("--remove-parts", arguments->remove_parts,
                   "Remove the parts once the picture is written; where that has been done, do nothing");
  command.add_flag("--quiet", arguments->quiet, "Say nothing but errors and warnings");
  return [arguments] { return run_merge(*arguments); };
}

}  // namespace

constinit const Command merge_command{"merge", "Put parts of a picture together", merge_options};

}  // namespace tyndall::tools
