// The second half of docs/verification.md.
#pragma once

namespace tyndall {

// Every way through a medium against every other, on six scenes. False when two disagree.
bool print_methods();

}  // namespace tyndall
