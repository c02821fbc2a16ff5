#include "optics/surface_model.h"

#include <algorithm>
#include <cmath>

#include "base/numerics.h"

namespace tyndall::optics {

namespace {

double reflected_part(const AlbedoTables& tables, double f0, double cosine, double roughness) {
  const AlbedoTables::Reflection e = tables.reflection(cosine, roughness);
  return f0 * e.scale + e.bias;
}

double coat_roughness(const SurfaceParameters& p) {
  return is_smooth(double{p.coat_roughness}) ? 0.0 : double{p.coat_roughness};
}

// Of a boundary of relative index `eta`, coloured.
Rgb colored_f0(double eta, const Rgb& color) {
  const auto grey = static_cast<float>(sqr((eta - 1) / (eta + 1)));
  Rgb out;
  for (std::size_t k = 0; k < 3; ++k) out[k] = std::min(grey * color[k], 1.0f);
  return out;
}

double gloss_roughness(const SurfaceParameters& p) { return is_smooth(p.roughness) ? 0.0 : p.roughness; }

// Lobes without a colour of their own are white.
Rgb colored(double grey) { return Rgb(static_cast<float>(grey)); }
const Rgb& colored(const Rgb& color) { return color; }

Rgb square_root(const Rgb& c) { return {std::sqrt(c.x), std::sqrt(c.y), std::sqrt(c.z)}; }

}  // namespace

std::array<double, 4> SurfaceModel::passed(double cosine) const {
  std::array<double, 4> part{1, 1, 1, 1};
  const SurfaceParameters& p = parameters_;
  if (!is_black(p.sheen)) part[1] = 1 - max_component(p.sheen) * tables_->sheen(cosine);
  part[2] = part[1];
  if (p.coat > 0) part[2] *= 1 - p.coat * reflected_part(*tables_, coat_f0, cosine, coat_roughness(p));
  part[3] = part[2];
  if (p.specular > 0)
    part[3] *= 1 - p.specular *
                       reflected_part(*tables_, double{max_component(gloss_f0_)}, cosine, gloss_roughness(p));
  return part;
}

SurfaceModel::SurfaceModel(const AlbedoTables& tables, const SurfaceParameters& parameters, double eta,
                           bool sheet, const Vec3d& o)
    : tables_(&tables),
      parameters_(parameters),
      gloss_f0_(colored_f0(eta, parameters.specular_color)),
      o_(o) {
  const SurfaceParameters& p = parameters_;
  passed_o_ = passed(o.z);
  const float rest = 1 - p.metallic, opaque = rest * (1 - p.transmission), clear = rest * p.transmission;
  if (!is_black(p.sheen)) add(Sheen{}, p.sheen, Under::nothing);
  if (p.coat > 0) add(Reflection{Rgb(float(coat_f0)), coat_roughness(p), false}, Rgb(p.coat), Under::sheen);
  if (p.metallic > 0) add(Reflection{p.base_color, p.roughness, true}, Rgb(p.metallic), Under::coat);
  if (clear > 0) {
    transmits_ = true;
    if (sheet)
      add(Pane{eta, p.roughness, p.base_color}, Rgb(clear), Under::coat);
    else  // light that crosses the body passes two boundaries
      add(Glass{eta, p.roughness, square_root(p.base_color)}, Rgb(clear), Under::coat);
  }
  if (opaque > 0) {
    if (p.specular > 0) add(Reflection{gloss_f0_, p.roughness, false}, Rgb(p.specular * opaque), Under::coat);
    if (is_black(p.sheen) && p.coat == 0) {
      const AlbedoTables::Reflection e = tables.reflection_average(gloss_roughness(p));
      gloss_passed_average_ = 1 - p.specular * (double{max_component(gloss_f0_)} * e.scale + e.bias);
    } else {
      // 2 ∫ passed μ dμ by Gauss and Legendre's rule of five points.
      constexpr double x[] = {0.0469100770306680, 0.2307653449471585, 0.5, 0.7692346550528415,
                              0.9530899229693319};
      constexpr double w[] = {0.1184634425280945, 0.2393143352496832, 0.2844444444444444, 0.2393143352496832,
                              0.1184634425280945};
      gloss_passed_average_ = 0;
      for (int k = 0; k < 5; ++k) gloss_passed_average_ += 2 * w[k] * x[k] * passed(x[k])[3];
    }
    add(Diffuse{}, p.base_color * opaque, Under::gloss);
  }
  double total = 0;
  for (std::size_t k = 0; k < count_; ++k) total += layers_[k].probability;
  if (total > 0)
    for (std::size_t k = 0; k < count_; ++k) layers_[k].probability /= total;
}

void SurfaceModel::add(const Lobe& lobe, const Rgb& color, Under under) {
  const Rgb lobe_albedo =
      std::visit([&](const auto& l) { return Rgb(colored(l.albedo(*tables_, o_))); }, lobe);
  const Rgb part = color * lobe_albedo * static_cast<float>(passed_o_[static_cast<std::size_t>(under)]);
  layers_[count_++] = {lobe, color, under, max_component(part)};
  albedo_ += part;
}

double SurfaceModel::share(const Layer& layer, const std::array<double, 4>& passed_i) const {
  const auto k = static_cast<std::size_t>(layer.under);
  if (layer.under == Under::gloss)
    return gloss_passed_average_ > 0 ? passed_o_[k] * passed_i[k] / gloss_passed_average_ : 0.0;
  return std::min(passed_o_[k], passed_i[k]);
}

Rgb SurfaceModel::value(const Vec3d& i) const {
  Rgb sum;
  const std::array<double, 4> passed_i = passed(std::abs(i.z));
  for (std::size_t k = 0; k < count_; ++k) {
    const Layer& layer = layers_[k];
    if (layer.probability == 0) continue;
    const Rgb lobe =
        std::visit([&](const auto& l) { return Rgb(colored(l.value(*tables_, o_, i))); }, layer.lobe);
    sum += layer.color * lobe * static_cast<float>(share(layer, passed_i));
  }
  return sum;
}

double SurfaceModel::pdf(const Vec3d& i) const {
  double sum = 0;
  for (std::size_t k = 0; k < count_; ++k)
    if (layers_[k].probability > 0)
      sum += layers_[k].probability *
             std::visit([&](const auto& l) { return l.pdf(*tables_, o_, i); }, layers_[k].lobe);
  return sum;
}

std::optional<SurfaceSample> SurfaceModel::sample(double u_layer, double u0, double u1, double u2) const {
  std::size_t k = 0, last = count_;
  for (; k < count_; ++k) {
    if (layers_[k].probability == 0) continue;
    last = k;
    if (u_layer < layers_[k].probability) break;
    u_layer -= layers_[k].probability;
  }
  if (last == count_) return std::nullopt;
  const Layer& layer = layers_[last];
  const auto drawn =
      std::visit([&](const auto& l) { return l.sample(*tables_, o_, u0, u1, u2); }, layer.lobe);
  if (!drawn) return std::nullopt;
  SurfaceSample out{drawn->direction, {}, 0, drawn->delta_weight.has_value()};
  if (out.delta) {
    out.weight = layer.color * *drawn->delta_weight *
                 static_cast<float>(share(layer, passed(std::abs(out.direction.z))) / layer.probability);
    return out;
  }
  out.pdf = pdf(out.direction);
  if (!(out.pdf > 0)) return std::nullopt;
  out.weight = value(out.direction) * static_cast<float>(1 / out.pdf);
  return out;
}

bool SurfaceModel::only_deltas() const {
  return std::all_of(layers_.begin(), layers_.begin() + static_cast<std::ptrdiff_t>(count_),
                     [](const Layer& l) { return l.probability == 0 || is_delta(l.lobe); });
}

}  // namespace tyndall::optics
