// A visitor of lambdas for std::visit.
#pragma once

namespace tyndall {

template <class... Fs>
struct Overloaded : Fs... {
  using Fs::operator()...;
};
template <class... Fs>
Overloaded(Fs...) -> Overloaded<Fs...>;

}  // namespace tyndall
