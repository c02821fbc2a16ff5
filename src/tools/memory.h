// Memory that runs out, told with the work that wanted it.
#pragma once

#include <new>
#include <utility>

namespace tyndall::tools {

class OutOfMemory : public std::bad_alloc {
 public:
  explicit OutOfMemory(const char* purpose) : purpose_(purpose) {}
  const char* what() const noexcept override { return purpose_; }

 private:
  const char* purpose_;
};

// Does the work; `purpose` ends the message "there is not enough memory …".
template <class Work>
auto with_memory(const char* purpose, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const OutOfMemory&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw OutOfMemory(purpose);
  }
}

}  // namespace tyndall::tools
