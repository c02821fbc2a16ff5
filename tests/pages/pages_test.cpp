// The pages that `measure` and `golden` write, opened in a browser: what is drawn is as large as it should
// be, stands where its numbers say, and does what it offers.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "cli/run_program.h"
#include "pages/browser.h"

namespace tyndall::test {
namespace UNNAMED {

namespace fs = std::filesystem;
using nlohmann::json;

class Pages : public CliTest {
 protected:
  void SetUp() override {
    if (chromium().empty()) GTEST_SKIP() << "Chromium is not installed (apt-get install chromium)";
    CliTest::SetUp();
  }
  void TearDown() override {
    if (!IsSkipped()) CliTest::TearDown();
  }
  std::string smoke(const std::string& name, double thickness) const {
    return file(name, fmt::format(R"(render {{ resolution: (24, 16)  samples: 16  bounces: 0 }}
camera perspective {{ from: (0, 0, 4)  to: (0, 0, 0)  fov: 34deg }}
volume {{ in: sphere {{ radius: 1 }}  medium: {{ density = {} * smoothstep(1, 0.2, length(p))  albedo = 0.8 }} }}
light environment {{ radiance: 1 }}
)",
                                  thickness));
  }
  json open(const std::string& page, const std::string& expression, int width = 1280) const {
    const OpenedPage opened = open_page(page, expression, path(""), width);
    EXPECT_TRUE(opened.found.is_object()) << opened.told;
    EXPECT_EQ(opened.console, std::vector<std::string>{}) << "the console is silent";
    return opened.found;
  }
};

// What is common to pages: nothing is wider than the window, all pictures were read, no name is used twice.
constexpr const char* common = R"(
  width: document.documentElement.scrollWidth, window: innerWidth,
  pictures: [...document.images].map(i => ({ read: i.complete && i.naturalWidth > 0,
                                             width: i.getBoundingClientRect().width })),
  ids: [...document.querySelectorAll('[id]')].map(e => e.id),
)";

void expect_sound(const json& found) {
  EXPECT_LE(found["width"], found["window"]) << "the page is scrolled sideways";
  for (const json& picture : found["pictures"]) {
    EXPECT_TRUE(picture["read"]);
    EXPECT_GT(picture["width"], 100);
  }
  std::set<std::string> ids;
  for (const json& id : found["ids"]) EXPECT_TRUE(ids.insert(id).second) << id;
}

const std::string measured_probe = fmt::format(R"(() => {{
  const box = e => {{ const b = e.getBoundingClientRect(); return [b.left, b.top, b.right, b.bottom]; }};
  const slider = document.getElementById('wipe'), errors = document.querySelector('.pair img + img');
  const clip = () => getComputedStyle(errors).clipPath;
  const clips = [clip()];
  for (const value of [0, 30, 100]) {{
    slider.value = value;
    slider.dispatchEvent(new Event('input', {{ bubbles: true }}));
    clips.push(clip());
  }}
  return {{ {}
    clips,
    over: box(errors), under: box(errors.previousElementSibling),
    plots: [...document.querySelectorAll('.plots figure')].map(f => ({{
      id: f.id, svg: box(f.querySelector('svg')), texts: [...f.querySelectorAll('text')].map(box),
      ticks: [...f.querySelectorAll('text.tick')].map(t => ({{ place: box(t), text: t.textContent }})),
      lines: [...f.querySelectorAll('polyline')].map(l => [l.getAttribute('class'), l.getTotalLength()]),
      points: [...f.querySelectorAll('circle')].map(c => ({{ place: box(c), x: +c.dataset.x, y: +c.dataset.y,
        filled: !c.classList.contains('hollow') }})) }})),
    rows: [...document.querySelectorAll('#settings tbody tr')].map(r => ({{ front: r.className == 'front',
      cells: [...r.cells].map(c => c.textContent) }})),
    numbers: JSON.parse(document.getElementById('measurements').textContent) }};
}})",
                                               common);

double middle_of(const json& box, std::size_t axis) {
  return 0.5 * (box[axis].get<double>() + box[axis + 2].get<double>());
}

// On both axes equal factors are equal distances, to a pixel.
void expect_logarithmic(const json& plot) {
  for (const auto& [axis, name] : {std::pair<std::size_t, const char*>(0, "x"), {1, "y"}}) {
    const json *low = nullptr, *high = nullptr;
    for (const json& point : plot["points"]) {
      if (!low || point[name] < (*low)[name]) low = &point;
      if (!high || point[name] > (*high)[name]) high = &point;
    }
    const auto log = [&name = name](const json& p) { return std::log(p[name].get<double>()); };
    ASSERT_GT(log(*high), log(*low));
    const double begin = middle_of((*low)["place"], axis), end = middle_of((*high)["place"], axis);
    EXPECT_GT(std::abs(end - begin), 100) << "the points fill the plot";
    for (const json& point : plot["points"]) {
      const double share = (log(point) - log(*low)) / (log(*high) - log(*low));
      EXPECT_NEAR(middle_of(point["place"], axis), begin + share * (end - begin), 1) << plot["id"];
    }
  }
}

bool overlap(const json& a, const json& b) {
  return a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
}

void expect_drawn(const json& plot) {
  SCOPED_TRACE(plot["id"].get<std::string>());
  const json& svg = plot["svg"];
  EXPECT_GT(svg[2].get<double>() - svg[0].get<double>(), 300);
  EXPECT_GT(svg[3].get<double>() - svg[1].get<double>(), 180);
  const auto is_inside = [&](const json& box) {
    return box[0] >= svg[0] && box[1] >= svg[1] && box[2] <= svg[2] && box[3] <= svg[3];
  };
  for (const json& text : plot["texts"]) EXPECT_TRUE(is_inside(text)) << text;
  for (const json& point : plot["points"]) EXPECT_TRUE(is_inside(point["place"])) << point;
  for (const json& line : plot["lines"]) EXPECT_GT(line[1], 20) << line;
  const json& ticks = plot["ticks"];
  EXPECT_GE(ticks.size(), 4u);
  for (std::size_t i = 0; i < ticks.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(overlap(ticks[i]["place"], ticks[j]["place"])) << ticks[i] << ticks[j];
  expect_logarithmic(plot);
}

// The value of a plot's point that a setting has.
void expect_point(const json& plot, double x, double y, bool filled) {
  for (const json& point : plot["points"])
    if (std::abs(point["x"].get<double>() - x) <= 1e-9 * x &&
        std::abs(point["y"].get<double>() - y) <= 1e-9 * y) {
      EXPECT_EQ(point["filled"], filled);
      return;
    }
  ADD_FAILURE() << "no point at " << x << ", " << y << " in\n" << plot["points"];
}

void expect_numbers(const json& found, const json& report) {
  EXPECT_EQ(found["numbers"], report) << "the page holds what --json prints";
  ASSERT_EQ(found["rows"].size(), report["settings"].size());
  for (std::size_t i = 0; i < found["rows"].size(); ++i) {
    const json &row = found["rows"][i], &setting = report["settings"][i], &cells = row["cells"];
    EXPECT_EQ(row["front"], setting["on_front"]);
    EXPECT_EQ(cells[0], setting["name"]);
    EXPECT_EQ(cells[1], fmt::format("{}", setting["runs"].get<int>()));
    EXPECT_EQ(cells[3], fmt::format("{:.3g}", setting["cpu_seconds"].get<double>()));
    EXPECT_EQ(cells[8], fmt::format("{:.3g}", setting["relmse"]["value"].get<double>()));
    EXPECT_EQ(cells[9], fmt::format("{:.3f}", setting["flip"].get<double>()));
    const double cpu_seconds = setting["cpu_seconds"];
    expect_point(found["plots"][0], cpu_seconds, 100 * setting["error"]["value"].get<double>(),
                 setting["on_front"]);
    const bool is_biased = setting["bias"]["low"] > 0;
    expect_point(found["plots"][1], std::stod(setting["parameters"]["step"].get<std::string>()),
                 100 * setting["bias"][is_biased ? "value" : "high"].get<double>(), is_biased);
    expect_point(found["plots"][2], setting["samples"], 100 * setting["noise"]["value"].get<double>(),
                 setting["on_front"]);
  }
}

TEST_F(Pages, MeasureDrawsItsNumbers) {
  const Outcome outcome =
      tyndall({"measure", smoke("smoke.tyn", 6), "--sweep", "step=1.3,0.3", "--sweep", "samples=4,64",
               "--reference-error", "0.03", "--seeds", "3", "-o", path("page.html"), "--json", "--quiet"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json found = open(path("page.html"), measured_probe), report = json::parse(outcome.out);
  expect_sound(found);
  ASSERT_EQ(found["plots"].size(), 3u);
  for (const json& plot : found["plots"]) expect_drawn(plot);
  for (const char* id : {"error-time", "bias-step", "noise-samples"})
    EXPECT_EQ(found["plots"][0]["id"] == id || found["plots"][1]["id"] == id || found["plots"][2]["id"] == id,
              true)
        << id;
  expect_numbers(found, report);
  // A reference, and of each setting one render and the mean of all, each with its errors.
  EXPECT_EQ(found["pictures"].size(), 1 + 4 * report["settings"].size());
}

TEST_F(Pages, MeasureHasASliderThatUncoversErrors) {
  ASSERT_EQ(tyndall({"measure", smoke("smoke.tyn", 6), "--sweep", "step=1.3,0.3", "--samples", "4",
                     "--reference-error", "0.1", "--seeds", "2", "-o", path("page.html"), "--quiet"})
                .status,
            0);
  for (const int width : {1280, 500}) {
    const json found = open(path("page.html"), measured_probe, width);
    expect_sound(found);
    EXPECT_EQ(found["over"], found["under"]) << "the map lies on its picture";
    const auto inset = [](int percent) { return fmt::format("inset(0px 0px 0px {}%)", percent); };
    EXPECT_EQ(found["clips"], (json{inset(50), inset(0), inset(30), inset(100)}));
  }
}

const std::string golden_probe = fmt::format(R"(() => ({{ {}
  title: document.title,
  rows: [...document.querySelectorAll('tr')].slice(1).map(r => ({{ kind: r.className,
    cells: [...r.cells].map(c => c.textContent), color: getComputedStyle(r.cells[0]).color }})),
  sections: [...document.querySelectorAll('section')].map(s => ({{ title: s.querySelector('h2').textContent,
    captions: [...s.querySelectorAll('figcaption')].map(c => c.textContent),
    tops: [...s.querySelectorAll('img')].map(i => i.getBoundingClientRect().top) }})) }}))",
                                             common);

TEST_F(Pages, GoldenShowsWhatDiffers) {
  fs::create_directory(path("tests"));
  smoke("tests/a.tyn", 6);
  smoke("tests/b.tyn", 6);
  smoke("tests/c.tyn", 6);
  ASSERT_EQ(tyndall({"golden", path("tests"), "--update"}).status, 0);
  smoke("tests/b.tyn", 7);
  file("tests/c.tyn", "let a =\n  <&b>\n");
  const Outcome outcome = tyndall({"golden", path("tests"), "--report", path("page.html"), "--json"});
  ASSERT_EQ(outcome.status, 1) << outcome.err;
  const json results = json::parse(outcome.out)["results"], found = open(path("page.html"), golden_probe);
  expect_sound(found);
  EXPECT_EQ(found["title"], "Golden tests: 2 of 3 did not pass");
  ASSERT_EQ(found["rows"].size(), 3u);
  const std::string message = results[2]["message"];
  EXPECT_EQ(found["rows"][2]["cells"][5], message.substr(0, message.find('\n')));
  for (std::size_t i = 0; i < 2; ++i) {
    const json& cells = found["rows"][i]["cells"];
    EXPECT_EQ(cells[0], results[i]["outcome"]);
    EXPECT_EQ(cells[1], results[i]["scene"]);
    EXPECT_EQ(cells[2], fmt::format("{:.3g}", results[i]["relmse"].get<double>()));
    EXPECT_EQ(cells[3], fmt::format("{:.3g}", results[i]["flip"].get<double>()));
  }
  EXPECT_NE(found["rows"][0]["color"], found["rows"][1]["color"]);
  ASSERT_EQ(found["sections"].size(), 2u);
  EXPECT_EQ(found["sections"][1]["captions"], json::array()) << "there is no picture";
  const json& section = found["sections"][0];
  EXPECT_EQ(section["title"], path("tests/b.tyn"));
  EXPECT_EQ(section["captions"].size(), 3u);
  for (const json& top : section["tops"]) EXPECT_EQ(top, section["tops"][0]) << "they stand side by side";
}

// Otherwise the other tests would see nothing.
TEST_F(Pages, ErrorsOfAPageAreSeen) {
  const OpenedPage opened =
      open_page(file("bad.html", "<!doctype html><title>bad</title><body><script>nothing.here();</script>"),
                "() => ({ title: document.title })", path(""));
  EXPECT_EQ(opened.found["title"], "bad");
  ASSERT_EQ(opened.console.size(), 1u) << opened.told;
  EXPECT_NE(opened.console[0].find("nothing is not defined"), std::string::npos);
}

}  // namespace UNNAMED
}  // namespace tyndall::test
