#include "denoise/window.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "denoise/window.cpp"
#include "hwy/foreach_target.h"
//
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::denoise::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::CappedTag<float, row_lanes>;
using Float = hn::Vec<Floats>;

// Numbers of a window: a row of lanes for each of its rows.
struct WindowLanes {
  alignas(64) float values[std::size_t{window_side} * row_lanes];

  float* row(int row) { return values + row * row_lanes; }
  const float* row(int row) const { return values + row * row_lanes; }
};

struct Window {
  int x = 0, y = 0;              // of its centre
  int x0 = 0, x1 = 0;            // pixels of the picture in it, from its left edge, half-open
  int y0 = 0, y1 = 0;            // and from its top; other rows have no numbers
  WindowLanes weight, reliable;  // of the pixels, and in the regression
  // Of the model: a one, and the differences of those features from the centre that vary here.
  int terms = 0;
  std::array<int, most_features + 1> feature{};  // of a term but the first
  std::array<WindowLanes, most_features + 1> basis;
  std::array<float, 3> least{}, most{};  // colours of the pixels that count
};

// The mean over a patch of the squared difference beyond what noise makes, in units of the noise: of `lanes`
// offsets from (dx, dy) on.
HWY_INLINE HWY_ATTR Float patch_distances(const WindowPlanes& planes, const Window& window, int dx, int dy) {
  const Floats d;
  constexpr float bandwidth = 0.5f, patch_pixels = (2 * patch_radius + 1) * (2 * patch_radius + 1);
  const Float least = hn::Set(d, 1e-30f), squared = hn::Set(d, bandwidth * bandwidth);
  Float sum = hn::Zero(d);
  for (int py = -patch_radius; py <= patch_radius; ++py)
    for (int px = -patch_radius; px <= patch_radius; ++px) {
      const int x = window.x + px, y = window.y + py;
      Float difference = hn::Zero(d);
      for (const Plane* plane : planes.guide) {
        const Float delta = hn::Sub(hn::LoadU(d, plane->at(x + dx, y + dy)), hn::Set(d, *plane->at(x, y)));
        difference = hn::MulAdd(delta, delta, difference);
      }
      const Float noise =
          hn::Add(hn::LoadU(d, planes.variance->at(x + dx, y + dy)), hn::Set(d, *planes.variance->at(x, y)));
      sum = hn::Add(sum, hn::Div(hn::Sub(difference, noise), hn::MulAdd(squared, noise, least)));
    }
  return hn::Mul(sum, hn::Set(d, 1 / patch_pixels));
}

// exp(-max(x, 0)) to a few per cent, and 0 from 16 on.
HWY_INLINE HWY_ATTR Float falloff(Float x) {
  const Floats d;
  Float v =
      hn::Max(hn::NegMulAdd(hn::Max(x, hn::Zero(d)), hn::Set(d, 1.0f / 16), hn::Set(d, 1)), hn::Zero(d));
  for (int k = 0; k < 4; ++k) v = hn::Mul(v, v);
  return v;
}

HWY_ATTR void find_weights(const WindowPlanes& planes, Window& window) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const Float x0 = hn::Set(d, static_cast<float>(window.x0)), x1 = hn::Set(d, static_cast<float>(window.x1));
  for (int row = window.y0; row < window.y1; ++row)
    for (int k = 0; k < row_lanes; k += lanes) {
      const int dx = k - window_radius, dy = row - window_radius;
      const Float at = hn::Iota(d, static_cast<float>(k));
      const auto inside = hn::And(hn::Ge(at, x0), hn::Lt(at, x1));
      const Float weight = hn::IfThenElseZero(inside, falloff(patch_distances(planes, window, dx, dy)));
      hn::Store(weight, d, window.weight.row(row) + k);
      hn::Store(hn::Mul(weight, hn::LoadU(d, planes.reliability->at(window.x + dx, window.y + dy))), d,
                window.reliable.row(row) + k);
    }
}

// Features that hardly vary in the window say nothing.
constexpr float least_spread = 1e-3f;

HWY_ATTR void find_basis(const WindowPlanes& planes, Window& window) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int row = window.y0; row < window.y1; ++row)
    for (int k = 0; k < row_lanes; k += lanes) hn::Store(hn::Set(d, 1), d, window.basis[0].row(row) + k);
  window.terms = 1;
  for (std::size_t i = 0; i < planes.features.size(); ++i) {
    const Plane& plane = *planes.features[i];
    const Float centre = hn::Set(d, *plane.at(window.x, window.y));
    WindowLanes& to = window.basis[window.terms];
    Float most = hn::Zero(d);
    for (int row = window.y0; row < window.y1; ++row)
      for (int k = 0; k < row_lanes; k += lanes) {
        const float* from = plane.at(window.x + k - window_radius, window.y + row - window_radius);
        const Float difference = hn::Sub(hn::LoadU(d, from), centre);
        most = hn::Max(most, hn::Abs(difference));
        hn::Store(difference, d, to.row(row) + k);
      }
    if (hn::GetLane(hn::MaxOfLanes(d, most)) > least_spread)
      window.feature[window.terms++] = static_cast<int>(i);
  }
}

// Sums over the window for the regression: of the products of the terms, and of those with the colours.
struct Moments {
  static constexpr int most = most_features + 1;
  std::array<std::array<double, most>, most> product;
  std::array<std::array<double, 3>, most> color;
};

// Sums of products of one row of numbers with four others.
HWY_INLINE HWY_ATTR void add_products(const Window& window, const WindowLanes& of,
                                      const std::array<const WindowLanes*, 4>& with,
                                      const std::array<double*, 4>& to) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  Float a = hn::Zero(d), b = a, c = a, e = a;
  for (int k = window.y0 * row_lanes; k < window.y1 * row_lanes; k += lanes) {
    const Float value = hn::Load(d, of.values + k);
    a = hn::MulAdd(value, hn::Load(d, with[0]->values + k), a);
    b = hn::MulAdd(value, hn::Load(d, with[1]->values + k), b);
    c = hn::MulAdd(value, hn::Load(d, with[2]->values + k), c);
    e = hn::MulAdd(value, hn::Load(d, with[3]->values + k), e);
  }
  *to[0] = static_cast<double>(hn::GetLane(hn::SumOfLanes(d, a)));
  *to[1] = static_cast<double>(hn::GetLane(hn::SumOfLanes(d, b)));
  *to[2] = static_cast<double>(hn::GetLane(hn::SumOfLanes(d, c)));
  *to[3] = static_cast<double>(hn::GetLane(hn::SumOfLanes(d, e)));
}

HWY_ATTR void find_moments(const WindowPlanes& planes, Window& window, Moments& moments) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  std::array<WindowLanes, 3> colors;
  for (std::size_t c = 0; c < 3; ++c) {
    const Float centre = hn::Set(d, *planes.color[c]->at(window.x, window.y));
    Float least = centre, most = centre;
    for (int row = window.y0; row < window.y1; ++row)
      for (int k = 0; k < row_lanes; k += lanes) {
        const float* from = planes.color[c]->at(window.x + k - window_radius, window.y + row - window_radius);
        const Float color = hn::LoadU(d, from);
        hn::Store(color, d, colors[c].row(row) + k);
        const auto counts = hn::Gt(hn::Load(d, window.weight.row(row) + k), hn::Zero(d));
        const Float counted = hn::IfThenElse(counts, color, centre);
        least = hn::Min(least, counted);
        most = hn::Max(most, counted);
      }
    window.least[c] = hn::GetLane(hn::MinOfLanes(d, least));
    window.most[c] = hn::GetLane(hn::MaxOfLanes(d, most));
  }
  WindowLanes weighted;
  double unused = 0;
  for (int i = 0; i < window.terms; ++i) {
    for (int k = window.y0 * row_lanes; k < window.y1 * row_lanes; k += lanes)
      hn::Store(hn::Mul(hn::Load(d, window.reliable.values + k), hn::Load(d, window.basis[i].values + k)), d,
                weighted.values + k);
    for (int j = 0; j < i + 4; j += 4) {
      std::array<const WindowLanes*, 4> with{};
      std::array<double*, 4> to{};
      for (int k = 0; k < 4; ++k) {
        const int term = j + k, color = term - i - 1;
        with[k] = term <= i ? &window.basis[term] : &colors[std::min(color, 2)];
        to[k] = term <= i ? &moments.product[i][term] : color < 3 ? &moments.color[i][color] : &unused;
      }
      add_products(window, weighted, with, to);
    }
    for (int j = 0; j < i; ++j) moments.product[j][i] = moments.product[i][j];
  }
}

// Of each colour: the value at the centre, and how it changes with each feature.
using Model = std::array<std::array<float, Moments::most>, 3>;

// Solves the normal equations of `count` of the terms by Cholesky decomposition, scaled so that each has
// variance 1. Slopes are drawn towards 0 a little (ridge regression), and the more the noisier the feature.
Model solve(const Moments& moments, const std::array<int, Moments::most>& used, int count,
            const std::array<double, Moments::most>& scale, const std::array<double, Moments::most>& noise) {
  constexpr double ridge = 1e-2, noise_weight = 4;
  constexpr int most = Moments::most;
  const double normalised = 1 / moments.product[0][0];
  std::array<std::array<double, most>, most> l;
  std::array<std::array<double, 3>, most> rhs;
  std::array<double, most> inverse;
  for (int i = 0; i < count; ++i) {
    const double row_scale = scale[i] * normalised;
    for (int j = 0; j <= i; ++j) {
      double value = moments.product[used[i]][used[j]] * row_scale * scale[j];
      if (i == j && i > 0) value += ridge + noise_weight * scale[i] * scale[i] * noise[i];
      for (int k = 0; k < j; ++k) value -= l[i][k] * l[j][k];
      if (i == j) {
        l[i][i] = std::sqrt(std::max(value, 1e-12));
        inverse[i] = 1 / l[i][i];
      } else {
        l[i][j] = value * inverse[j];
      }
    }
    for (int c = 0; c < 3; ++c) {
      double value = moments.color[used[i]][c] * row_scale;
      for (int k = 0; k < i; ++k) value -= l[i][k] * rhs[k][c];
      rhs[i][c] = value * inverse[i];
    }
  }
  Model model{};
  for (int i = count - 1; i >= 0; --i)
    for (int c = 0; c < 3; ++c) {
      double value = rhs[i][c];
      for (int k = i + 1; k < count; ++k) value -= l[k][i] * rhs[k][c];
      rhs[i][c] = value * inverse[i];
      model[c][used[i]] = static_cast<float>(rhs[i][c] * scale[i]);
    }
  return model;
}

// Leaves out features that vary by their noise alone.
Model fit(const WindowPlanes& planes, const Window& window, const Moments& moments) {
  const double total = moments.product[0][0];
  if (!(total > 0)) return {};
  std::array<int, Moments::most> used{};
  std::array<double, Moments::most> scale{1}, noise{};
  int count = 1;
  for (int i = 1; i < window.terms; ++i) {
    const double mean = moments.product[i][0] / total, spread = moments.product[i][i] / total - mean * mean;
    noise[count] = *planes.feature_variances[window.feature[i]]->at(window.x, window.y);
    if (!(spread > least_spread * least_spread + 2 * noise[count])) continue;
    used[count] = i;
    scale[count] = 1 / std::sqrt(spread);
    ++count;
  }
  return solve(moments, used, count, scale, noise);
}

HWY_ATTR void add_predictions(const WindowPlanes& planes, const Window& window, const Model& model) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int row = window.y0; row < window.y1; ++row)
    for (int k = 0; k < row_lanes; k += lanes) {
      const int x = window.x + k - window_radius, y = window.y + row - window_radius;
      const Float weight = hn::Load(d, window.weight.row(row) + k);
      Float red = hn::Set(d, model[0][0]), green = hn::Set(d, model[1][0]), blue = hn::Set(d, model[2][0]);
      for (int i = 1; i < window.terms; ++i) {
        const Float difference = hn::Load(d, window.basis[i].row(row) + k);
        red = hn::MulAdd(hn::Set(d, model[0][i]), difference, red);
        green = hn::MulAdd(hn::Set(d, model[1][i]), difference, green);
        blue = hn::MulAdd(hn::Set(d, model[2][i]), difference, blue);
      }
      // Beyond the colours that it was fitted to a line tells nothing.
      const auto bounded = [&](Float value, std::size_t c) HWY_ATTR {
        return hn::Min(hn::Max(value, hn::Set(d, window.least[c])), hn::Set(d, window.most[c]));
      };
      const auto add = [&](Plane& plane, Float value) HWY_ATTR {
        float* to = plane.at(x, y);
        hn::StoreU(hn::MulAdd(weight, value, hn::LoadU(d, to)), d, to);
      };
      add(*planes.sum[0], bounded(red, 0));
      add(*planes.sum[1], bounded(green, 1));
      add(*planes.sum[2], bounded(blue, 2));
      add(*planes.weight, hn::Set(d, 1));
    }
}

HWY_ATTR void add_window_here(const WindowPlanes& planes, int x, int y) {
  Window window;
  window.x = x;
  window.y = y;
  window.x0 = std::max(0, window_radius - x);
  window.y0 = std::max(0, window_radius - y);
  window.x1 = std::min(window_side, planes.weight->width() - x + window_radius);
  window.y1 = std::min(window_side, planes.weight->height() - y + window_radius);
  find_weights(planes, window);
  find_basis(planes, window);
  Moments moments;
  find_moments(planes, window, moments);
  add_predictions(planes, window, fit(planes, window, moments));
}

}  // namespace tyndall::denoise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tyndall::denoise {

HWY_EXPORT(add_window_here);

void add_window(const WindowPlanes& planes, int x, int y) {
  HWY_DYNAMIC_DISPATCH(add_window_here)(planes, x, y);
}

}  // namespace tyndall::denoise
#endif
