// A cluster of Slurm on this machine, of a test's own: two nodes, with a key, ports and folders that nothing
// else uses.
#pragma once

#include <sys/types.h>

#include <map>
#include <string>
#include <vector>

#include "cli/run_program.h"

namespace tyndall::test {

class SlurmCluster {
 public:
  // Its files are in `folder`, which must be there.
  explicit SlurmCluster(std::string folder);
  // Ends all that was started, tasks included.
  ~SlurmCluster();
  SlurmCluster(const SlurmCluster&) = delete;
  SlurmCluster& operator=(const SlurmCluster&) = delete;

  // What is not installed here: what to tell before skipping; empty when all is there.
  static std::string what_is_missing();

  // Starts the daemons and waits until both nodes are idle; a message when they do not come up.
  std::string start();
  // Starts the daemon of node "one" or "two", or kills it, as a machine that loses its power does, but for
  // its tasks, which live on and know nothing of it.
  void start_node(const std::string& node);
  void kill_node(const std::string& node);

  // Runs a command of the shell that asks this cluster.
  Outcome shell(const std::string& command) const;
  // What squeue tells of each job that has not ended, a line each: number, state, node or reason.
  std::string queue() const;
  // What the daemons have told so far, for messages of tests.
  std::string logs() const;

 private:
  pid_t start_daemon(const std::string& name, const std::vector<std::string>& command);

  std::string folder_;
  std::map<std::string, pid_t> daemons_;
};

}  // namespace tyndall::test
