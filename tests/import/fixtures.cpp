#include "fixtures.h"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace tyndall::import {

namespace {

// In a process of its own, as no other program has OpenVDB beside the module that reads: that one's functions
// would not come before OpenVDB's.
template <class Write>
void write_elsewhere(Write write) {
  const ::pid_t child = ::fork();
  if (child == 0) {
    void* const module = ::dlopen(TYNDALL_VDB_WRITER_FILE, RTLD_NOW | RTLD_LOCAL);
    const auto* writer =
        module ? static_cast<const VdbWriter*>(::dlsym(module, "tyndall_vdb_writer")) : nullptr;
    if (writer) write(*writer);
    ::_exit(writer ? 0 : 1);
  }
  int status = 1;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

}  // namespace

void write_vdb(const std::string& path, const std::vector<FixtureGrid>& grids, Codec codec) {
  write_elsewhere([&](const VdbWriter& writer) { writer.write(path, grids, codec); });
}
void write_vdb_stream(const std::string& path, const FixtureGrid& grid) {
  write_elsewhere([&](const VdbWriter& writer) { writer.write_stream(path, {grid}, Codec::none); });
}

std::vector<FixtureGrid> plume() {
  FixtureGrid density;
  density.type = GridType::half;
  density.first = {0, 0, 0};
  density.last = {16, 24, 16};
  density.local_from_index = Transform::translate({-0.8, 0, -0.8}) * Transform::scale({0.1, 0.1, 0.1});
  density.value = [](int i, int j, int k) {
    const double x = 0.1 * i - 0.8, y = 0.1 * j, z = 0.1 * k - 0.8, height = y / 2.4;
    const double radius = 0.14 + 0.4 * std::pow(height, 0.8);
    const double across =
        std::hypot(x - 0.1 * std::sin(5 * height), z - 0.1 * std::cos(4 * height) + 0.1) / radius;
    const double billow = 0.5 * std::sin(11 * x + 4 * y) * std::sin(9 * y + 2) * std::sin(12 * z - 3 * y);
    const double ends = std::min(1.0, 12 * height) * std::min(1.0, 4 * (1 - height));
    return std::clamp(1.3 * (1 - across * across + billow) * ends, 0.0, 1.0);
  };
  FixtureGrid temperature = density;
  temperature.name = "temperature";
  temperature.background = 300;
  temperature.value = [value = density.value](int i, int j, int k) {
    return 300 + 1500 * value(i, j, k) * std::exp(-0.2 * j);
  };
  return {density, temperature};
}

}  // namespace tyndall::import
