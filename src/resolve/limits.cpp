// The table of the language's limits.
#include "resolve/limits.h"

#include "eval/evaluator.h"
#include "generate/made.h"
#include "resolve/grids.h"
#include "resolve/images.h"
#include "scene/render_settings.h"
#include "syntax/lexer.h"
#include "syntax/parser.h"
#include "syntax/recursive_parser.h"

namespace tyndall::resolve {

std::span<const Limit> limits() {
  static constexpr Limit table[] = {
      {"file size", max_file_bytes, "bytes of a scene or an included file (256 MB)"},
      {"words", syntax::max_tokens, "words, numbers, marks and comments of a file"},
      {"strings", syntax::max_strings, "strings of a file, and pieces of them between values"},
      {"name length", syntax::max_word_bytes, "characters of a name"},
      {"nesting", syntax::max_nesting, "brackets, blocks and operators within each other in the text"},
      {"list length", syntax::max_list_length, "entries of a list"},
      {"include depth", max_include_depth, "files that include each other, besides the scene's own"},
      {"template depth", max_template_depth, "templates and objects placed within each other"},
      {"block depth", max_block_depth, "blocks within blocks, through all calls of templates"},
      {"repetitions", max_repetitions,
       "rounds of loops, calls of templates and placements in a scene, in all, and facets of lathes, prisms, "
       "height fields, sweeps and texts"},
      {"placed things", max_repetitions, "objects, and volumes in them, counted each time they are placed"},
      {"objects", max_objects,
       "objects placed for the first time; those that differ from placement to placement, each time"},
      {"lights", max_lights, "lights of a scene, those in objects counted each time they are placed"},
      {"volumes", max_volumes, "volumes of a scene, those in objects counted each time they are placed"},
      {"string length", eval::max_string_bytes, "bytes of a string"},
      {"list depth", eval::max_list_depth, "lists within each other"},
      {"light samples", scene::RenderSettings::light_samples_range.most,
       "`light_samples`, as of `--light-samples`"},
      {"pictures", image::PictureMemory::usual,
       "bytes that all pictures of a scene take in memory (4 GB), or as `--texture-memory` says; those that "
       "take more than an eighth of it, or than is left, are kept in a temporary file"},
      {"grids", max_grid_bytes, "bytes that all grids of a scene take (4 GB)"},
      {"curve points", max_curve_points, "points of all strands of one `curves`"},
      {"combined parts", max_combined_parts,
       "shapes in a `difference`, `intersection` or `union`, with those in it"},
      {"combination depth", max_combined_depth, "combinations within each other"},
      {"outline points", generate::most_outline_points,
       "points of the profile of a `lathe`, or of all outlines of a `prism`"},
      {"facets", generate::most_facets,
       "four-sided facets of a `lathe`, `prism`, `heightfield`, `sweep` or `text`"},
      {"call depth", eval::max_call_depth, "functions that call each other"},
      {"function calls", eval::max_total_calls, "calls of functions for one value"},
      {"evaluation depth", eval::max_expression_depth, "operations within each other, through all calls"},
      {"made list", eval::max_list_entries, "entries of a list that is made by `for`, `+` or `append`"},
      {"made lists in all", eval::max_total_list_entries,
       "entries of all such lists below one value of a scene"},
      {"made lists of a scene", eval::max_scene_list_entries, "entries of all such lists of a scene"},
      {"function rounds", eval::max_loop_iterations, "rounds of one `for` in a function"},
      {"function rounds in all", eval::max_total_iterations,
       "rounds of all `for` below one value of a scene"},
      {"body rounds", eval::max_unrolled_iterations, "rounds of one `for` in a medium or material"},
      {"body rounds in all", eval::max_total_unrolled, "rounds of all `for` in a medium or material"},
      {"octaves", eval::max_octaves, "octaves of a noise"},
      {"errors shown", Diagnostics::max_errors, "further ones are counted only"},
  };
  return table;
}

}  // namespace tyndall::resolve
