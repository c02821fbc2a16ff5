// What files of grids and of meshes cost before the first ray, against their targets.
#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "bench.h"
#include "import/fixtures.h"
#include "import/nano_writer.h"
#include "measured_scene.h"

namespace tyndall {

namespace {

namespace fs = std::filesystem;

// Gone with all that is in it when it goes.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_(fs::temp_directory_path() / fmt::format("tyndall-bench-{}", ::getpid())) {
    fs::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string file(std::string_view name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

// A ball of billows that fills a box of 100 voxels a side: every voxel is active, and no two are the same.
constexpr VoxelCoord first_voxel{0, 0, 0}, last_voxel{99, 99, 99};
double billow(int x, int y, int z) {
  const double r = std::hypot(x - 50.0, y - 50.0, z - 50.0) / 50;
  return 0.01 +
         std::fmax(0, 1 - r) * (1 + 0.5 * std::sin(0.31 * x) * std::sin(0.23 * y) * std::sin(0.17 * z));
}

// By OpenVDB itself, in a process of its own.
bool write_vdb(const std::string& path) {
  const ::pid_t child = ::fork();
  if (child == 0) {
    void* const module = ::dlopen(TYNDALL_VDB_WRITER_FILE, RTLD_NOW | RTLD_LOCAL);
    const auto* writer =
        module ? static_cast<const import::VdbWriter*>(::dlsym(module, "tyndall_vdb_writer")) : nullptr;
    if (!writer) ::_exit(1);
    import::FixtureGrid grid;
    grid.first = first_voxel;
    grid.last = last_voxel;
    grid.value = billow;
    writer->write(path, {grid}, import::Codec::blosc);
    ::_exit(0);
  }
  int status = 1;
  return child > 0 && ::waitpid(child, &status, 0) == child && status == 0;
}
bool write_nano(const std::string& path) {
  import::NanoFixture grid;
  grid.first = first_voxel;
  grid.last = last_voxel;
  grid.value = billow;
  std::ofstream file(path, std::ios::binary);
  file << import::nano_file({grid}, import::NanoCodec::blosc);
  return file.good();
}

bool bench_grid(const TemporaryFolder& folder, const std::string& name, bool (*write)(const std::string&)) {
  if (!write(folder.file(name))) return false;
  fmt::print("{}: 1,000,000 active voxels, {:.1f} MB packed by Blosc\n", name,
             static_cast<double>(fs::file_size(folder.file(name))) / megabyte);
  const std::string text = fmt::format(
      "camera perspective {{ from: (50, 50, 300) to: (50, 50, 50) }}\nlight environment {{ radiance: 1 }}\n"
      "let smoke = grid(\"{}\")\nmedium smoky() {{ density = 0.1 * smoke(p)  albedo = 0.9 }}\n"
      "volume {{ in: bounds(smoke)  medium: smoky }}\n",
      name);
  const auto cost = cost_of_scene(folder.file("grid.tyn"), text, Until::compiled);
  if (!cost) return false;
  fmt::print("  resolve {:.3f} compile {:.3f} s of CPU; peak {:.0f} MB\n", cost->lap_cpu_seconds[3],
             cost->lap_cpu_seconds[4], cost->peak_bytes / megabyte);
  return print_target("wall clock until the scene is compiled", cost->wall_seconds, "s", 2, true);
}

template <class... Numbers>
void append(std::string& bytes, Numbers... numbers) {
  const auto one = [&](auto number) {
    char raw[sizeof number];
    std::memcpy(raw, &number, sizeof number);
    bytes.append(raw, sizeof number);
  };
  (one(numbers), ...);
}

// A sheet of hills, of 2 side² triangles.
bool write_ply(const std::string& path, int side) {
  const int points = (side + 1) * (side + 1), triangles = 2 * side * side;
  std::ofstream file(path, std::ios::binary);
  file << fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      points, triangles);
  for (int i = 0; i <= side; ++i) {
    std::string bytes;
    for (int k = 0; k <= side; ++k) {
      const float x = static_cast<float>(k) / static_cast<float>(side),
                  z = static_cast<float>(i) / static_cast<float>(side);
      append(bytes, x, 0.05f * std::sin(40 * x) * std::sin(31 * z), z);
    }
    file << bytes;
  }
  constexpr unsigned char corners = 3;
  for (int i = 0; i < side; ++i) {
    std::string bytes;
    for (int k = 0; k < side; ++k) {
      const int at = i * (side + 1) + k, above = at + side + 1;
      append(bytes, corners, at, above, at + 1, corners, at + 1, above, above + 1);
    }
    file << bytes;
  }
  return file.good();
}

bool bench_mesh(const TemporaryFolder& folder) {
  constexpr int side = 1582;  // 5,005,448 triangles
  const std::string name = "hills.ply";
  if (!write_ply(folder.file(name), side)) return false;
  fmt::print("{}: {} triangles, {:.0f} MB\n", name, 2 * side * side,
             static_cast<double>(fs::file_size(folder.file(name))) / megabyte);
  const std::string text = fmt::format(
      "camera perspective {{ from: (0.5, 1, 2) to: (0.5, 0, 0.5) }}\nlight environment {{ radiance: 1 }}\n"
      "mesh \"{}\" {{}}\n",
      name);
  const auto cost = cost_of_scene(folder.file("mesh.tyn"), text, Until::compiled);
  if (!cost) return false;
  fmt::print("  resolve {:.2f} compile {:.2f} s of CPU\n", cost->lap_cpu_seconds[3],
             cost->lap_cpu_seconds[4]);
  const bool met = print_target("wall clock until the scene is compiled", cost->wall_seconds, "s", 30, true);
  return print_target("peak memory", cost->peak_bytes / megabyte, "MB", 2000, true) && met;
}

}  // namespace

bool bench_inputs() {
  const TemporaryFolder folder;
  bool met = bench_grid(folder, "smoke.vdb", write_vdb);
  met &= bench_grid(folder, "smoke.nvdb", write_nano);
  met &= bench_mesh(folder);
  return met;
}

}  // namespace tyndall
