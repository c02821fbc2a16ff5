// What `measure` does first, and what it advises.
#include <gtest/gtest.h>

#include <cmath>

#include "tools/measure/advice.h"
#include "tools/measure/schedule.h"

namespace tyndall::test {
namespace UNNAMED {

using tools::ReferenceProgress, tools::SettingProgress, tools::SettingRow, tools::Task;

TEST(MeasurePlan, EachSettingOnceThenAReferenceThenTheFront) {
  // The third is slower than the first, and less accurate by far.
  std::vector<SettingProgress> settings(3);
  const SettingProgress after_runs[] = {{0, 1, 0.1}, {0, 4, 0.02}, {0, 2, 0.5}};
  ReferenceProgress reference{.goal = 0.01};
  std::string order;
  double left = 1000;
  while (true) {
    const Task task = tools::next_task(settings, reference, 4, {1000, left});
    if (task.kind == Task::Kind::none) break;
    if (task.kind == Task::Kind::reference) {
      order += "R";
      reference.samples += task.samples;
      reference.seconds = 0.5 * reference.samples;
      reference.error = 0.1 / std::sqrt(reference.samples);
      left -= 0.5 * task.samples;
    } else {
      SettingProgress& s = settings[task.setting];
      s.seconds = after_runs[task.setting].seconds;
      s.error = ++s.runs >= 2 ? after_runs[task.setting].error : 0;
      order += static_cast<char>('0' + task.setting);
      left -= s.seconds;
    }
  }
  // Four rounds of the reference: 16, 32, 64 and 128 samples.
  EXPECT_EQ(order, "012RRRR012010122");
  EXPECT_TRUE(tools::is_complete(settings, reference, 4));
}

TEST(MeasurePlan, NothingIsBegunThatDoesNotEndInTime) {
  const std::vector<SettingProgress> settings{{1, 30, 0}, {1, 5, 0}};
  const ReferenceProgress given{.given = true};
  EXPECT_EQ(tools::next_task(settings, given, 4, {60, 10}).setting, 1u);
  EXPECT_EQ(tools::next_task(settings, given, 4, {60, 4}).kind, Task::Kind::none);
  EXPECT_FALSE(tools::is_complete(settings, given, 4));
  // Of a reference as many samples as fit, if that is worth it.
  const std::vector<SettingProgress> done{{4, 1, 0.1}};
  const ReferenceProgress made{.samples = 64, .seconds = 64, .error = 0.1, .goal = 0.01};
  EXPECT_EQ(tools::next_task(done, made, 4, {1000, 40}).samples, 40);
  EXPECT_EQ(tools::next_task(done, made, 4, {1000, 500}).samples, 64);
  EXPECT_EQ(tools::next_task(done, made, 4, {1000, 10}).kind, Task::Kind::none);
  // The first is as long as half of its share, by what samples of the settings take.
  const ReferenceProgress none{.expected_seconds = 20, .goal = 0.01};
  EXPECT_EQ(tools::next_task(done, none, 4, {1000, 900}).samples, 10);
  EXPECT_EQ(tools::next_task(done, none, 4, {60, 50}).samples, 1);
}

SettingRow row(const std::string& step, int samples, double seconds, double bias, double noise) {
  SettingRow out{.name = step,
                 .swept = {{"step", step}, {"samples", std::to_string(samples)}},
                 .settings = {},
                 .options = {},
                 .runs = 4,
                 .cost = {seconds, 2 * seconds, 0, 1e6}};
  out.settings.samples = samples;
  out.settings.step = scene::Step(std::stod(step));
  const double b = bias * bias, n = noise * noise;
  out.accuracy = tools::Accuracy{{b, 0.9 * b, 1.1 * b}, {n, n, n}, {b + n, b + n, b + n}, {bias, bias, bias}};
  return out;
}

TEST(MeasurePlan, TheFastestSettingWithinTheErrorIsAdvised) {
  // Coarse steps are fast and end at 3 %.
  const std::vector<SettingRow> rows{row("0.4", 16, 1, 0.03, 0.08), row("0.1", 16, 3, 0.001, 0.08),
                                     row("0.1", 256, 48, 0.001, 0.02)};
  const std::vector<tools::Advice> advice = tools::advice_of(rows);
  ASSERT_EQ(advice.size(), 3u);
  // 0.05² = 0.03² + 0.08² · 16/n: n = 64, in 4 s.
  EXPECT_EQ(advice[0].setting, "step 0.4");
  EXPECT_EQ(advice[0].samples, 64);
  EXPECT_NEAR(advice[0].seconds, 4, 1e-9);
  // 0.02² = 0.001² + 0.02² · 256/n: from 256 samples, which are nearer than 16.
  EXPECT_EQ(advice[1].setting, "step 0.1");
  EXPECT_EQ(advice[1].samples, 257);
  EXPECT_EQ(advice[2].samples, 1035);
  EXPECT_EQ(advice[2].render, "render {\n  resolution: (640, 360)\n  samples: 1035\n  step: 0.1\n}\n");
  EXPECT_TRUE(tools::advice_of({row("0.4", 16, 1, 0.3, 0.08)})[0].setting.empty());
}

TEST(MeasurePlan, TheFrontHasWhatNothingElseBeats) {
  std::vector<SettingRow> rows{row("1", 1, 1, 0, 0.1), row("2", 1, 2, 0, 0.05), row("3", 1, 3, 0, 0.06)};
  rows.push_back(rows[0]);
  rows.back().accuracy.reset();
  tools::mark_front(rows);
  EXPECT_TRUE(rows[0].on_front);
  EXPECT_TRUE(rows[1].on_front);
  EXPECT_FALSE(rows[2].on_front) << "the second is faster and more accurate";
  EXPECT_FALSE(rows[3].on_front) << "nothing is known of it";
}

}  // namespace UNNAMED
}  // namespace tyndall::test
