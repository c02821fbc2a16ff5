// Pass: dead code. What no output needs has no readers, and nothing is written of it.
#include "vm/builder/graph.h"

namespace tyndall::vm {

Graph::Graph(std::vector<Node> all, std::span<const NodeId> wanted)
    : nodes(std::move(all)), uses(nodes.size(), 0), outputs(wanted.begin(), wanted.end()) {
  for (const NodeId output : outputs) ++uses[output.index];
  for (std::size_t i = nodes.size(); i-- > 0;)
    if (uses[i] > 0)
      for (const NodeId id : nodes[i].reads()) ++uses[id.index];
}

}  // namespace tyndall::vm
