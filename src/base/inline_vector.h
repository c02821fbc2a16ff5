// A list that takes no memory from the heap while it is short.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

namespace tyndall {

// Up to N elements stand in the object itself, more of them in a std::vector.
template <class T, std::size_t N>
class InlineVector {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  void push_back(const T& element) {
    if (size_ < N) {
      few_[size_] = element;
    } else {
      if (size_ == N) many_.assign(few_.begin(), few_.end());
      many_.push_back(element);
    }
    ++size_;
  }
  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  T& operator[](std::size_t i) { return data()[i]; }
  const T& operator[](std::size_t i) const { return data()[i]; }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }

 private:
  T* data() { return size_ <= N ? few_.data() : many_.data(); }
  const T* data() const { return size_ <= N ? few_.data() : many_.data(); }

  std::array<T, N> few_;
  std::size_t size_ = 0;
  std::vector<T> many_;
};

}  // namespace tyndall
