#pragma once
/// The shape functions. The words of the input, the reference page, the engines, all that the step is compiled for, and the tests of the family
/// follow from one list.

#include <stdexcept>
#include <type_traits>
#include <utility>

#include "crampon/shape/bspline.hpp"
#include "crampon/shape/complete.hpp"
#include "crampon/shape/cpdi.hpp"
#include "crampon/shape/cubic_bspline.hpp"
#include "crampon/shape/gimp.hpp"
#include "crampon/shape/linear.hpp"
#include "crampon/state/grid.hpp"

/// Expands X(Shape, MORE) for each of them. A further one is one file like linear.hpp, which is included above, and one line here.
#define CRAMPON_SHAPES(X, MORE) \
  X(LinearShape, MORE)          \
  X(GimpShape, MORE)            \
  X(BsplineShape, MORE)         \
  X(CubicBsplineShape, MORE)    \
  X(CpdiShape, MORE)

namespace crampon {

template <class... Shapes>
struct ShapeList {
  static constexpr int size = sizeof...(Shapes);
};

#define CRAMPON_CHECK_SHAPE(SHAPE, MORE) static_assert(CompleteShapeFunction<SHAPE>::value);
CRAMPON_SHAPES(CRAMPON_CHECK_SHAPE, )
#undef CRAMPON_CHECK_SHAPE

template <class, class... Shapes>
using ListAfterFirst = ShapeList<Shapes...>;
#define CRAMPON_LIST_SHAPE(SHAPE, MORE) , SHAPE
using ShapeFunctions = ListAfterFirst<void CRAMPON_SHAPES(CRAMPON_LIST_SHAPE, )>;
#undef CRAMPON_LIST_SHAPE

/// A shape function as a number: its place in the list.
enum class ShapeFunctionKind : int {};

/// f(std::type_identity<Shape>) for each in the order of the list.
template <class F, class... Shapes>
constexpr void for_each_shape(ShapeList<Shapes...>, F f) {
  (f(std::type_identity<Shapes>{}), ...);
}
template <class F>
constexpr void for_each_shape(F f) {
  for_each_shape(ShapeFunctions{}, std::move(f));
}

/// The place of Shape in the list.
template <class Shape>
constexpr ShapeFunctionKind find_kind() {
  int kind = -1, at = 0;
  for_each_shape([&]<class S>(std::type_identity<S>) {
    if (std::is_same_v<S, Shape>) kind = at;
    ++at;
  });
  if (kind < 0) throw std::logic_error("a shape function that is not in CRAMPON_SHAPES");
  return ShapeFunctionKind{kind};
}
template <class Shape>
inline constexpr ShapeFunctionKind kind_of = find_kind<Shape>();

/// f(std::type_identity<Shape>) for the one at this place.
template <class F>
constexpr auto with_shape(ShapeFunctionKind kind, F f) {
  const auto first_of = []<class S, class... Rest>(ShapeList<S, Rest...>) { return std::type_identity<S>{}; };
  using Result = decltype(f(first_of(ShapeFunctions{})));
  const auto find = [&]<class S, class... Rest>(auto self, int at, ShapeList<S, Rest...>) -> Result {
    if (at == 0) return f(std::type_identity<S>{});
    if constexpr (sizeof...(Rest) > 0) return self(self, at - 1, ShapeList<Rest...>{});
    throw std::logic_error("unknown shape functions");
  };
  return find(find, static_cast<int>(kind), ShapeFunctions{});
}

/// What the profile of a shape function is made of, and whether particles have domains that move.
constexpr ProfileBoxes boxes_of(ShapeFunctionKind kind) {
  return with_shape(kind, []<class S>(std::type_identity<S>) { return ProfileBoxes{S::boxes}; });
}
constexpr bool has_domains(ShapeFunctionKind kind) {
  return with_shape(kind, []<class S>(std::type_identity<S>) { return bool{S::has_domains}; });
}

/// The most nodes that a stencil has.
inline constexpr int most_nodes_along_axis = [] {
  int most = 0;
  for_each_shape([&]<class S>(std::type_identity<S>) { most = S::width > most ? S::width : most; });
  return most;
}();
template <int Dim>
inline constexpr int most_nodes = power(most_nodes_along_axis, Dim);

}  // namespace crampon
