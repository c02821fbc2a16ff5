// The radiance of an environment: a number, a colour or a picture.
#include <algorithm>

#include "resolve/reading/reader.h"

namespace tyndall::resolve {

static PlanePointer without_negative(const Plane& plane) {
  std::vector<float> texels = plane.texels;
  for (float& texel : texels) texel = std::max(texel, 0.0f);
  return make_plane(plane.name, plane.width, plane.height, std::move(texels));
}

void Reader::read_value(const FieldInfo& info, const Given& given, optics::SkyRadiance& to) {
  const eval::Value value = evaluator_.evaluate(*site_.tree, given.item->value, *site_.scope);
  const auto* image = value.get<eval::Image>();
  if (!image) return to_color(info, value, value_span(given), "a number, a colour or an image", to.color);
  const std::vector<PlanePointer> planes = evaluator_.context().images->planes(*image);
  ok_ &= !planes.empty();
  for (std::size_t c = 0; c < 3 && !planes.empty(); ++c) to.picture[c] = planes[planes.size() == 3 ? c : 0];
  to.color = Rgb(image->factor);
  const bool dark =
      std::any_of(planes.begin(), planes.end(), [](const auto& plane) { return plane->lowest < 0; });
  if (dark)
    diagnostics_.warning(value_span(given), "the picture holds values below 0",
                         "no light is negative: they count as 0");
  for (PlanePointer& plane : to.picture)
    if (plane && plane->lowest < 0 && !plane->paged) plane = without_negative(*plane);
}

}  // namespace tyndall::resolve
