#pragma once
/// Members of a struct, stated once. A struct says
///
///     template <class Self, class Visit>
///     static void for_members(Self& self, Visit&& visit) {
///       auto& [time, step] = self;  // a member that is not named here does not compile
///       visit(Member{"time", "s"}, time);
///       visit(Member{"step"}, step);
///     }
///
/// Everyone who must see every member walks that list: core/saved_state.hpp saves, loads, compares and hashes by it
/// (docs/decisions/0023-declared-state.md).

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "crampon/core/pack.hpp"
#include "crampon/core/vector.hpp"

namespace crampon {

/// Does the further course of a run depend on a member, or do only outputs show it?
enum class Use : std::uint8_t { course, display };

/// What is known of a member besides its type.
struct Member {
  const char* name;
  const char* unit = "1";  ///< SI; several, separated by commas, where components differ
  Use use = Use::course;
};

/// Takes what for_members() hands to it and does nothing.
struct IgnoreMember {
  void operator()(const Member&, const auto&) const {}
};

template <class T>
concept HasMembers = requires(const T& a) {
  T::for_members(a, IgnoreMember{});
};

/// Kinds of numbers that members are made of.
enum class Scalar : std::uint8_t { f64, i64, u64, i32, u32, i16, u16, i8, u8 };

constexpr std::size_t size_of(Scalar s) {
  switch (s) {
    case Scalar::f64:
    case Scalar::i64:
    case Scalar::u64:
      return 8;
    case Scalar::i32:
    case Scalar::u32:
      return 4;
    case Scalar::i16:
    case Scalar::u16:
      return 2;
    case Scalar::i8:
    case Scalar::u8:
      return 1;
  }
  return 0;
}

template <class T>
requires std::is_arithmetic_v<T>
constexpr Scalar scalar_of() {
  if constexpr (std::is_floating_point_v<T>) {
    static_assert(sizeof(T) == 8, "the state is kept in double precision");
    return Scalar::f64;
  } else if constexpr (std::is_signed_v<T>) {
    return sizeof(T) == 8 ? Scalar::i64 : sizeof(T) == 4 ? Scalar::i32 : sizeof(T) == 2 ? Scalar::i16 : Scalar::i8;
  } else {
    return sizeof(T) == 8 ? Scalar::u64 : sizeof(T) == 4 ? Scalar::u32 : sizeof(T) == 2 ? Scalar::u16 : Scalar::u8;
  }
}

/// A type that is some numbers of one kind, one after another without gaps: scalar and count. Others have none of it.
template <class T>
struct Numeric {};
template <class T>
requires std::is_arithmetic_v<T>
struct Numeric<T> {
  static constexpr Scalar scalar = scalar_of<T>();
  static constexpr std::size_t count = 1;
};
template <class T>
requires std::is_enum_v<T>
struct Numeric<T> : Numeric<std::underlying_type_t<T>> {
};
template <int Dim>
struct Numeric<Vec<Dim>> {
  static constexpr Scalar scalar = Scalar::f64;
  static constexpr std::size_t count = Dim;
};
template <>
struct Numeric<Pack> {
  static constexpr Scalar scalar = Scalar::f64;
  static constexpr std::size_t count = lanes;
};
template <class T, std::size_t N>
requires requires { Numeric<T>::count; }
struct Numeric<std::array<T, N>> {
  static constexpr Scalar scalar = Numeric<T>::scalar;
  static constexpr std::size_t count = N * Numeric<T>::count;
};

template <class T>
concept IsNumeric = requires {
  Numeric<T>::count;
}
&&sizeof(T) == Numeric<T>::count* size_of(Numeric<T>::scalar);

}  // namespace crampon
