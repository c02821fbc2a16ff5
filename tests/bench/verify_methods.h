// The second half of docs/verification.md.
#pragma once

namespace tyndall {

// All methods compared with each other, on six scenes. False when two disagree.
bool print_methods();

}  // namespace tyndall
