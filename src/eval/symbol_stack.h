// Names in the order in which they came, asked for one at a time: what a piece of tree defines, or the
// parameters of a definition.
#pragma once

#include <algorithm>
#include <unordered_map>
#include <vector>

#include "syntax/tree.h"

namespace tyndall::eval {

class SymbolStack {
 public:
  std::size_t size() const { return symbols_.size(); }
  const std::vector<syntax::SymbolId>& all() const { return symbols_; }

  void push(syntax::SymbolId symbol) { symbols_.push_back(symbol); }
  // Takes the newest away until `size` are left.
  void shrink(std::size_t size) {
    for (; counted_ > size; --counted_) --counts_[symbols_[counted_ - 1]];
    symbols_.resize(size);
  }

  bool contains(syntax::SymbolId symbol) const {
    if (symbols_.size() <= few) return std::find(symbols_.begin(), symbols_.end(), symbol) != symbols_.end();
    for (; counted_ < symbols_.size(); ++counted_) ++counts_[symbols_[counted_]];
    const auto found = counts_.find(symbol);
    return found != counts_.end() && found->second > 0;
  }

 private:
  static constexpr std::size_t few = 16;  // are looked through faster than a table is asked

  std::vector<syntax::SymbolId> symbols_;
  mutable std::unordered_map<syntax::SymbolId, std::uint32_t> counts_;  // of the first `counted_`
  mutable std::size_t counted_ = 0;
};

}  // namespace tyndall::eval
