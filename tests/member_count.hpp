#pragma once

#include <cstddef>

namespace gracilis {

/// Stands for a value of any type.
struct Any {
  template <class T>
  operator T() const;
};

/// How many members an aggregate without bases has: as many as it accepts initializers.
template <class Aggregate, class... Initializers>
constexpr std::size_t member_count() {
  if constexpr (requires { Aggregate{Initializers{}..., Any{}}; }) {
    return member_count<Aggregate, Initializers..., Any>();
  } else {
    return sizeof...(Initializers);
  }
}

}  // namespace gracilis
