// Blocks that were never run hold no surprises: their words are looked up, without any value.
#include "resolve/checks/unreached_code.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/overloaded.h"
#include "resolve/resolve_context.h"
#include "shader/compile_body.h"
#include "syntax/foreign_words.h"

namespace tyndall::resolve {

namespace {

// The statements and parameters of a block, down to the things in its values.
class BlockCheck {
 public:
  BlockCheck(Run& run, const Site& site) : run_(run), site_(site), tree_(*site.tree) {}

  void block(syntax::BlockId id) {
    for (const syntax::ItemId item : tree_.list_of_items(tree_[id].items))
      std::visit(Overloaded{
                     [&](const syntax::ThingItem& thing) { this->thing(thing); },
                     [&](const syntax::PlaceItem& place) {
                       parameters(place.block, PlaceParameters::keyword, list_names<PlaceParameters>);
                     },
                     [&](const syntax::ForItem& loop) { block(loop.body); },
                     [&](const syntax::IfItem& choice) {
                       block(choice.then_block);
                       if (choice.else_block.valid()) block(choice.else_block);
                     },
                     [&](const syntax::TemplateItem& form) { block(form.body); },
                     [&](const syntax::ObjectItem& object) { block(object.body); },
                     [&](const syntax::BodyItem& body) {
                       outputs(body.body, body.kind, run_.symbols.text(body.name.symbol));
                     },
                     [](const auto&) {},
                 },
                 tree_[item].node);
  }

  // Whether a file is included: then names may come from there.
  bool includes(syntax::BlockId id) const {
    const auto items = tree_.list_of_items(tree_[id].items);
    return std::any_of(items.begin(), items.end(), [&](syntax::ItemId item) {
      const auto& node = tree_[item].node;
      if (std::holds_alternative<syntax::IncludeItem>(node)) return true;
      if (const auto* loop = std::get_if<syntax::ForItem>(&node)) return includes(loop->body);
      if (const auto* thing = std::get_if<syntax::ThingItem>(&node)) return includes(thing->block);
      const auto* choice = std::get_if<syntax::IfItem>(&node);
      return choice &&
             (includes(choice->then_block) || (choice->else_block.valid() && includes(choice->else_block)));
    });
  }

 private:
  void thing(const syntax::ThingItem& thing) {
    const Statement* row = run_.statements.find(thing.keyword.symbol, thing.kind.symbol);
    if (!row) {
      report_unknown_statement(run_, site_, thing);
      if (const auto behind = statement_behind(run_, thing)) this->thing(*behind);
      return;
    }
    if (const Statement* const of_file = run_.statements.of_file(*row); of_file && thing.file.valid())
      row = of_file;
    if (row->list_names) parameters(thing.block, row->name, row->list_names);
    block(thing.block);
  }

  void parameters(syntax::BlockId id, std::string_view keyword, ListNames list) {
    std::vector<std::string_view> known;
    list(known);
    for (const syntax::ItemId item : tree_.list_of_items(tree_[id].items)) {
      const auto* parameter = std::get_if<syntax::ParameterItem>(&tree_[item].node);
      if (!parameter) continue;
      const std::string_view name = run_.symbols.text(parameter->name.symbol);
      if (std::find(known.begin(), known.end(), name) == known.end())
        run_.diagnostics.error(parameter->name.span, no_parameter(name, keyword), way_out(name, known));
      if (const auto* value = std::get_if<syntax::ThingExpr>(&tree_[parameter->value].node))
        thing_as_value(*value, name);
    }
  }

  static std::string way_out(std::string_view name, const std::vector<std::string_view>& known) {
    const syntax::ForeignWord* row = syntax::find_foreign_parameter(name, known);
    return row ? std::string(row->help) : did_you_mean(name, known);
  }

  // A shape that a volume fills, or an unnamed body.
  void thing_as_value(const syntax::ThingExpr& thing, std::string_view parameter) {
    if (!thing.keyword.symbol.valid()) {
      if (parameter == "medium") outputs(thing.block, syntax::BodyKind::medium, "medium");
      if (parameter == "material") outputs(thing.block, syntax::BodyKind::material, "material");
      return;
    }
    const Statement* row = run_.statements.find(thing.keyword.symbol, {});
    if (!row || !row->is_shape()) return report_no_shape(run_, thing);
    if (const Statement* const of_file = run_.statements.of_file(*row); of_file && thing.file.valid())
      row = of_file;
    if (row->list_shape_names) parameters(thing.block, row->name, row->list_shape_names);
  }

  void outputs(syntax::BlockId block, syntax::BodyKind kind, std::string_view name) {
    shader::check_outputs(run_.context, tree_, block, kind, name);
  }

  Run& run_;
  const Site& site_;
  const syntax::SyntaxTree& tree_;
};

}  // namespace

void check_never_run(Run& run) {
  std::vector<std::uint32_t> blocks;
  for (const auto& [block, place] : run.passed_over.blocks)
    if (!run.blocks_run[block]) blocks.push_back(block);
  std::sort(blocks.begin(), blocks.end());
  for (const std::uint32_t index : blocks) {
    const syntax::BlockId block(index);
    const PassedOver::Place& place = run.passed_over.blocks.at(index);
    Site site;
    site.tree = run.main;
    site.scope = std::make_shared<eval::Scope>();
    site.scope->parent = place.scope;
    BlockCheck check(run, site);
    check.block(block);
    if (!check.includes(block))
      run.evaluator.check_names(*run.main, block, place.scope, place.parameters, place.variable);
  }
}

}  // namespace tyndall::resolve
