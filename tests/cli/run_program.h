// Runs the program as a user does, and gives back what it said.
#pragma once

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace tyndall::test {

struct Outcome {
  int status = -1;  // exit status; 128 + signal when a signal ended it
  std::string out, err;
};

// What may be done to a run from outside.
struct RunOptions {
  // Send the signal then, four times later with sanitizers; 0: never.
  double interrupt_after_seconds = 0;
  int signal = SIGINT;
  int times = 1;                           // … again after as long, with sanitizers too
  std::string wait_for_on_err{};           // … but not before this text is on standard error
  std::function<bool()> wait_for{};        // … nor before this says so, which is asked every few ms
  bool wait_until_caught = true;           // … nor before the program has a handler for the signal
  std::vector<std::string> environment{};  // NAME=VALUE, added
};

// Runs an executable with arguments and an empty standard input; ends it after two minutes.
Outcome run(const std::string& executable, const std::vector<std::string>& arguments,
            const RunOptions& options = {});

// Runs the program under test.
Outcome tyndall(const std::vector<std::string>& arguments, const RunOptions& options = {});

// A test with a directory of its own, removed at its end.
class CliTest : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;
  // The path of a name in the directory.
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  // Writes a file there and gives its path.
  std::string file(const std::string& name, const std::string& text) const;
  std::size_t file_count() const;
  // For RunOptions::wait_for: whether a file of that name is there.
  std::function<bool()> appears(const std::string& name) const {
    return [file = path(name)] { return std::filesystem::exists(file); };
  }

 private:
  std::filesystem::path directory_;
};

std::string read_file(const std::string& path);

// A small scene with a cloud, a light and a wall: 16x12 pixels, 2 samples.
std::string small_scene();

}  // namespace tyndall::test
