#include "render/worker.h"

#include "render/path_state.h"

namespace tyndall::render {

Worker::Worker() = default;
Worker::~Worker() = default;

}  // namespace tyndall::render
