#include "tools/measure/full_report.h"

#include <algorithm>
#include <span>

#include "base/parallel.h"
#include "image/files.h"
#include "image/flip.h"
#include "tools/measure/advice.h"
#include "tools/measure/page.h"
#include "tools/measure/thumbnails.h"
#include "tools/view_options.h"

namespace tyndall::tools {
namespace {

// So many settings are shown with their pictures; of more those of the front alone.
constexpr std::size_t most_shown = 16;

image::Image reference_picture(const Measuring& measuring, int width, int height) {
  return picture_of(mean_of(measuring.reference()), width, height);
}

void add_flip(MeasureReport& report, const Measuring& measuring) {
  const image::Image truth = reference_picture(measuring, report.width, report.height);
  if (truth.pixels.empty()) return;
  for (std::size_t i = 0; i < report.rows.size(); ++i) {
    std::vector<float> first = measuring.first_picture(i);
    if (!first.empty())
      report.rows[i].flip =
          image::flip_hdr_mean(picture_of(std::move(first), report.width, report.height), truth);
  }
}

// What the maps show as light: three times the error of the median setting.
double most_error_of(const std::vector<SettingRow>& rows) {
  std::vector<double> errors;
  for (const SettingRow& row : rows)
    if (const auto error = error_of(row); error && error->value > 0) errors.push_back(error->value);
  if (errors.empty()) return 1;
  std::sort(errors.begin(), errors.end());
  return 3 * errors[errors.size() / 2];
}

// Puts the thumbnail's URI in its place.
std::string put(const Thumbnail& thumbnail, std::string& uri) {
  uri = thumbnail.uri;
  return thumbnail.problem;
}

std::string pictures_of(const MeasureReport& report, const image::View& view, const Measuring& measuring,
                        PagePictures& pictures) {
  const image::Image truth = reference_picture(measuring, report.width, report.height);
  if (truth.pixels.empty()) return {};
  pictures.most_error = most_error_of(report.rows);
  std::string problem = put(shown_picture(truth, view), pictures.reference);
  for (std::size_t i = 0; i < report.rows.size() && problem.empty(); ++i) {
    const SettingRow& row = report.rows[i];
    if (row.runs == 0 || (report.rows.size() > most_shown && !row.on_front)) continue;
    const image::Image one = picture_of(measuring.first_picture(i), report.width, report.height),
                       mean = picture_of(measuring.mean_picture(i), report.width, report.height);
    SettingPictures shown{.name = row.name, .render = {}, .render_errors = {}, .mean = {}, .mean_errors = {}};
    problem = put(shown_picture(one, view), shown.render);
    if (problem.empty()) problem = put(error_map(one, truth, pictures.most_error), shown.render_errors);
    if (problem.empty()) problem = put(shown_picture(mean, view), shown.mean);
    if (problem.empty()) problem = put(error_map(mean, truth, pictures.most_error), shown.mean_errors);
    pictures.settings.push_back(std::move(shown));
  }
  return problem;
}

}  // namespace

MeasureReport empty_report(const ReportRequest& request, const scene::Scene& scene,
                           const scene::RenderSettings& settings) {
  MeasureReport report;
  report.scene = request.scene;
  report.width = settings.resolution.width;
  report.height = settings.resolution.height;
  report.frame = scene.frame;
  report.threads = request.threads > 0 ? request.threads : hardware_threads();
  report.seeds = request.seeds;
  report.features = features_of(scene);
  return report;
}

MeasureReport full_report(const ReportRequest& request, const scene::Scene& scene,
                          const scene::RenderSettings& settings, const Measuring& measuring) {
  MeasureReport report = empty_report(request, scene, settings);
  report.complete = measuring.is_complete();
  report.rows = measuring.rows();
  report.reference = measuring.reference_facts();
  report.reference.file = request.reference;
  report.advice = advice_of(report.rows);
  add_flip(report, measuring);
  return report;
}

std::string write_page(const std::string& path, const MeasureReport& report, const scene::Scene& scene,
                       const Measuring* measuring) {
  PagePictures pictures;
  if (measuring != nullptr)
    if (std::string problem = pictures_of(report, view_of(scene), *measuring, pictures); !problem.empty())
      return problem;
  const std::string page = page_of(report, pictures);
  return image::write_file_whole(path, std::as_bytes(std::span(page)));
}

}  // namespace tyndall::tools
