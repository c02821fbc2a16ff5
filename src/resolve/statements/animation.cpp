// Reading the animation statement, once ahead of time: see animation.h.
#include "resolve/statements/animation.h"

#include <fmt/format.h>

#include <cmath>

#include "resolve/resolve_context.h"
#include "scene/ranges.h"

namespace tyndall::resolve {

namespace {

const syntax::ThingItem* find_animation(Run& run) {
  const syntax::SymbolId keyword = run.symbols.intern(AnimationParameters::keyword);
  for (const syntax::ItemId id : run.main->list_of_items((*run.main)[run.main->file].items)) {
    const auto* thing = std::get_if<syntax::ThingItem>(&(*run.main)[id].node);
    if (thing && thing->keyword.symbol == keyword && !thing->kind.symbol.valid()) return thing;
  }
  return nullptr;
}

// The statement's value if the time and frame were these.
std::optional<scene::Animation> try_animation(Run& run, const syntax::ThingItem& animation, double time,
                                              double frame) {
  Diagnostics ignored;
  eval::Context context = run.context;
  context.diagnostics = &ignored;
  context.time = time;
  context.frame = frame;
  eval::Evaluator evaluator(context);
  const auto scope = std::make_shared<eval::Scope>();
  for (const syntax::ItemId id : run.main->list_of_items((*run.main)[run.main->file].items)) {
    const syntax::Item& item = (*run.main)[id];
    if (const auto* let = std::get_if<syntax::LetItem>(&item.node)) {
      define_file_let(run, evaluator, *run.main, item, *let, scope);
    } else if (std::holds_alternative<syntax::FunctionItem>(item.node)) {
      evaluator.define(*run.main, item, scope);
    } else if (std::get_if<syntax::ThingItem>(&item.node) == &animation) {
      break;
    }
  }
  Reader reader(evaluator, run.schemas, {run.main, &scope}, animation.block, AnimationParameters::keyword,
                header(animation));
  const scene::Animation result = read_animation(reader);
  return reader.ok() ? std::optional(result) : std::nullopt;
}

}  // namespace

scene::Animation read_animation(Reader& reader) {
  const auto given = reader.read<AnimationParameters>();
  reader.finish();
  scene::Animation result;
  if (!reader.ok()) return result;
  const double first = given.frames.first, last = given.frames.last - (given.frames.excludes_last ? 1 : 0);
  if (given.frames.step != 1 || first != std::floor(first) || last != std::floor(last)) {
    reader.error(reader.place("frames"), "'frames' must be a range of whole numbers with step 1",
                 "write `frames: 1..48`; which of them is rendered is the command line's to say: --frame 12");
    return result;
  }
  constexpr scene::WholeRange range = scene::frame_range;
  for (const double frame : {first, last}) {
    if (std::abs(frame) <= static_cast<double>(range.most)) continue;
    reader.error(reader.place("frames"),
                 fmt::format("'frames' reaches {:.0f}: frame numbers go from {} to {}", frame, range.least,
                             range.most));
    return result;
  }
  result = {given.fps,
            static_cast<int>(first),
            static_cast<int>(last),
            {given.shutter.opens.angle(given.fps), given.shutter.closes.angle(given.fps)},
            given.shutter_curve};
  reader.report(scene::validate(result));
  return result;
}

bool same(const scene::Animation& a, const scene::Animation& b) {
  return a.fps == b.fps && a.first_frame == b.first_frame && a.last_frame == b.last_frame &&
         a.shutter == b.shutter && a.shutter_curve == b.shutter_curve;
}

std::optional<scene::Animation> foresee_animation(Run& run) {
  const syntax::ThingItem* animation = find_animation(run);
  if (!animation) return std::nullopt;
  // What differs between two times and frames depends on them.
  const auto at_start = try_animation(run, *animation, 0, 0);
  const auto later = try_animation(run, *animation, 0.6180339887, 7);
  return at_start && later && same(*at_start, *later) ? at_start : std::nullopt;
}

}  // namespace tyndall::resolve
