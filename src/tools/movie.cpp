#include "tools/movie.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <span>
#include <system_error>

#include "image/files.h"
#include "image/image.h"
#include "tools/child_process.h"

namespace tyndall::tools {
namespace {

namespace fs = std::filesystem;

// Containers by the extension, and what ffmpeg calls them.
constexpr std::pair<std::string_view, std::string_view> containers[] = {
    {".mp4", "mp4"}, {".mov", "mov"}, {".mkv", "matroska"}};

std::string_view container_of(const std::string& path) {
  const std::string extension = fs::path(path).extension().string();
  for (const auto& [ending, name] : containers)
    if (ending == extension) return name;
  return {};
}

std::vector<std::string> ffmpeg_command(const std::string& path, std::string_view container, int width,
                                        int height, double fps) {
  return {"ffmpeg", "-hide_banner", "-loglevel", "error", "-f", "rawvideo", "-pixel_format", "rgb24",
          "-video_size", fmt::format("{}x{}", width, height), "-framerate", fmt::format("{}", fps), "-i",
          "pipe:0", "-vf",
          // 4:2:0 wants even sides.
          "scale=out_color_matrix=bt709:out_range=tv,pad=ceil(iw/2)*2:ceil(ih/2)*2,format=yuv420p", "-c:v",
          "libx264", "-crf", "16", "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709",
          "-movflags", "+faststart", "-f", std::string(container), "-y", path};
}

// A file that is removed at the end, unless it has taken another one's place.
struct UnfinishedFile {
  std::string path;
  ~UnfinishedFile() {
    std::error_code ignored;
    if (!path.empty()) fs::remove(path, ignored);
  }
};

}  // namespace

std::string movie_problem(const std::string& path) {
  if (container_of(path).empty())
    return fmt::format("--movie wants a name that ends in .mp4, .mov or .mkv, not '{}'", path);
  if (!image::appears_whole(path)) return fmt::format("--movie wants a plain file, which '{}' is not", path);
  if (!is_installed("ffmpeg"))
    return "--movie wants ffmpeg, which is not installed: install it (apt-get install ffmpeg), or leave "
           "--movie out";
  return image::check_file_writable(path);
}

std::string write_movie(const std::string& path, const std::vector<std::string>& pictures,
                        const GivenView& given, double fps) {
  const auto failed = [&](std::string_view why) { return fmt::format("cannot write '{}': {}", path, why); };
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(path, error), target = error ? fs::path(path) : canonical;
  const fs::path beside =
      target.parent_path() / fmt::format(".{}.{}.part", target.filename().string(), ::getpid());
  UnfinishedFile unfinished{beside.string()};
  std::optional<ChildProcess> ffmpeg;
  image::Image::Place size;
  for (const std::string& picture : pictures) {
    const image::ReadResult read = image::read(picture);
    if (!read.image) return failed(read.error);
    const image::Image::Place whole = image::whole_of(*read.image);
    if (!ffmpeg) {
      size = whole;
      // Said to be a file: what stands before a colon would be taken for a protocol.
      ffmpeg.emplace(ffmpeg_command("file:" + unfinished.path, container_of(path), size.whole_width,
                                    size.whole_height, fps));
    }
    if (whole.whole_width != size.whole_width || whole.whole_height != size.whole_height)
      return failed(fmt::format("'{}' is {}x{}, and the frames before are {}x{}", picture, whole.whole_width,
                                whole.whole_height, size.whole_width, size.whole_height));
    const image::View view = is_developed(picture) ? read.view : in_place(given, read.view);
    const std::vector<std::uint8_t> shown = image::display_rgb(*read.image, view);
    ffmpeg->write(std::as_bytes(std::span(shown)));
    if (!ffmpeg->problem().empty()) break;
  }
  if (!ffmpeg) return failed("there are no frames");
  if (!ffmpeg->finish()) return failed("ffmpeg says: " + ffmpeg->problem());
  fs::rename(unfinished.path, target, error);
  if (error) return failed(error.message());
  unfinished.path.clear();
  return {};
}

}  // namespace tyndall::tools
