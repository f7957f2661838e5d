#include "crampon/contact/normal.hpp"

#include <array>
#include <cmath>

#include "crampon/core/pack.hpp"

namespace crampon {

namespace {

/// In coordinates scaled by the cell. Without it |beta| would grow without end for sets that a plane can separate. Smaller values turn
/// normals beside a corner closer to the face, larger ones smooth those along curved faces.
constexpr double lambda = 1e-2;

/// Rounding does not choose between two that are as large: the first is taken (conventions 32).
constexpr double tie = 1 - 1e-10;

template <int Dim>
using Coefficients = std::array<double, Dim + 1>;  ///< beta along the axes, in cells, then the constant

/// Normal equations of one step of least squares.
template <int Dim>
struct NormalEquations {
  static constexpr int size = Dim + 1;
  static_assert(size <= lanes);
  Pack matrix[size] = {};
  Pack right = {};

  /// A point's share: factor X X^T and value X, where X = (x, 1).
  void add(const Vec<Dim>& x, double factor, double value) {
    Pack X = {};
    for (int k = 0; k < Dim; ++k) X[k] = x[k];
    X[Dim] = 1;
    const Pack scaled = splat(factor) * X;
    for (int i = 0; i < size; ++i) matrix[i] = fused(splat(scaled[i]), X, matrix[i]);
    right = fused(splat(value), X, right);
  }

  /// Cholesky without roots; the ridge is added to all but the constant. Empty unless clearly positive definite.
  std::optional<Coefficients<Dim>> solve() const {
    double L[size][size], D[size];
    Coefficients<Dim> y;
    for (int i = 0; i < size; ++i) {
      const double diagonal = matrix[i][i] + (i < Dim ? lambda : 0);
      D[i] = diagonal;
      y[i] = right[i];
      for (int k = 0; k < i; ++k) {
        double sum = matrix[k][i];
        for (int j = 0; j < k; ++j) sum -= L[i][j] * D[j] * L[k][j];
        L[i][k] = sum / D[k];
        D[i] -= L[i][k] * sum;
        y[i] -= L[i][k] * y[k];
      }
      if (!(D[i] > 1e-13 * diagonal)) return std::nullopt;
    }
    for (int i = size - 1; i >= 0; --i) {
      y[i] /= D[i];
      for (int j = i + 1; j < size; ++j) y[i] -= L[j][i] * y[j];
    }
    return y;
  }
};

struct Counts {
  int a = 0, b = 0;
  double scale = 0;  ///< one over the mean weight
  double mean = 0;   ///< of the labels
};

template <int Dim>
Counts count(std::span<const LabelledPoint<Dim>> points) {
  Counts counts;
  double weights = 0, labels = 0;
  for (const LabelledPoint<Dim>& p : points) {
    ++(p.side == ContactSide::a ? counts.a : counts.b);
    weights += p.weight;
    labels += p.weight * static_cast<double>(p.side);
  }
  counts.scale = static_cast<double>(points.size()) / weights;
  counts.mean = labels / weights;
  return counts;
}

/// The gradient of a function of x_k/h_k, normalised. Empty when it is zero or not a number.
template <int Dim>
std::optional<Vec<Dim>> direction(const Coefficients<Dim>& beta, const Vec<Dim>& cell) {
  Vec<Dim> gradient;
  for (int k = 0; k < Dim; ++k) gradient[k] = beta[k] * (cell[0] / cell[k]);
  const double length = norm(gradient);
  if (!(length > 0 && std::isfinite(length))) return std::nullopt;
  return gradient * (1 / length);
}

/// Empty when a side is missing, or both lie about the same middle.
template <int Dim>
std::optional<Coefficients<Dim>> linear_fit(std::span<const LabelledPoint<Dim>> points, const Counts& counts) {
  if (counts.a == 0 || counts.b == 0) return std::nullopt;
  NormalEquations<Dim> equations;
  Vec<Dim> pull;
  double size = 0;
  for (const LabelledPoint<Dim>& p : points) {
    const double w = counts.scale * p.weight, c = static_cast<double>(p.side);
    equations.add(p.x, w, w * c);
    pull += p.x * (w * (c - counts.mean));
    size += w * norm(p.x);
  }
  if (!(norm(pull) > 1e-12 * size)) return std::nullopt;
  return equations.solve();
}

/// The objective at beta, and the equations of the Gauss-Newton step from there.
template <int Dim>
struct LogisticFit {
  Coefficients<Dim> beta{};
  double objective = 0;
  NormalEquations<Dim> equations;

  LogisticFit(std::span<const LabelledPoint<Dim>> points, double scale, const Coefficients<Dim>& at) : beta(at) {
    NormalEquations<Dim> sums;
    double sum = 0;
    for (const LabelledPoint<Dim>& p : points) {
      double u = beta[Dim];
      for (int k = 0; k < Dim; ++k) u += beta[k] * p.x[k];
      // tanh(u/2) and phi = (1 - tanh^2)/2 from one exponential that cannot overflow.
      const double e = std::exp(-std::fabs(u)), q = 1 / (1 + e);
      const double tanh = std::copysign((1 - e) * q, u), phi = 2 * e * q * q;
      const double w = scale * p.weight, rest = static_cast<double>(p.side) - tanh;
      sum += w * rest * rest;
      sums.add(p.x, w * phi * phi, w * phi * rest);
    }
    objective = sum;
    equations = sums;
    for (int k = 0; k < Dim; ++k) {
      objective += lambda * beta[k] * beta[k];
      equations.right[k] -= lambda * beta[k];
    }
  }
};

}  // namespace

template <int Dim>
std::optional<Vec<Dim>> linear_regression_normal(std::span<const LabelledPoint<Dim>> points, const Vec<Dim>& cell) {
  const auto beta = linear_fit(points, count(points));
  return beta ? direction<Dim>(*beta, cell) : std::nullopt;
}

template <int Dim>
std::optional<Vec<Dim>> logistic_regression_normal(std::span<const LabelledPoint<Dim>> points, const Vec<Dim>& cell) {
  const Counts counts = count(points);
  if (counts.a < Dim + 1 || counts.b < Dim + 1) return std::nullopt;
  auto start = linear_fit(points, counts);
  if (!start) return std::nullopt;
  for (double& c : *start) c *= 2;
  std::optional<Vec<Dim>> n = direction<Dim>(*start, cell);
  if (!n) return std::nullopt;
  LogisticFit<Dim> fit(points, counts.scale, *start);
  for (int iteration = 0; iteration < 15; ++iteration) {
    auto step = fit.equations.solve();
    if (!step) return std::nullopt;
    const double before = fit.objective;
    const Coefficients<Dim> from = fit.beta;
    int halvings = 0;
    do {
      Coefficients<Dim> to;
      for (int k = 0; k <= Dim; ++k) {
        to[k] = from[k] + (*step)[k];
        (*step)[k] *= 0.5;
      }
      fit = LogisticFit<Dim>(points, counts.scale, to);
    } while (!(fit.objective <= before) && ++halvings < 20);
    const Vec<Dim> previous = *n;
    n = direction<Dim>(fit.beta, cell);
    if (!n) return std::nullopt;
    // The first step mostly lengthens beta: that it does not turn says little.
    if (iteration > 0 && 1 - dot(*n, previous) < 1e-5) break;
  }
  return n;
}

template <int Dim>
Vec<Dim> gradient_normal(GradientNormal choice, const VolumeGradient<Dim>& a, const VolumeGradient<Dim>& b, double rigid_bias) {
  const double size_a = norm(a.g), size_b = norm(b.g);
  const Vec<Dim> of_a = normalized(a.g), of_b = normalized(-b.g);
  if (a.rigid && size_a > 0 && size_a * rigid_bias >= size_b) return of_a;
  if (b.rigid && size_b > 0 && size_b * rigid_bias >= size_a) return of_b;
  if (size_a == 0 || size_b == 0) return size_a > 0 ? of_a : of_b;
  switch (choice) {
    case GradientNormal::largest_gradient:
      return size_a >= tie * size_b ? of_a : of_b;
    case GradientNormal::more_volume:
      return a.V >= tie * b.V ? of_a : of_b;
    case GradientNormal::average:
      return normalized(a.g - b.g);
  }
  return {};
}

template std::optional<Vec<2>> linear_regression_normal<2>(std::span<const LabelledPoint<2>>, const Vec<2>&);
template std::optional<Vec<3>> linear_regression_normal<3>(std::span<const LabelledPoint<3>>, const Vec<3>&);
template std::optional<Vec<2>> logistic_regression_normal<2>(std::span<const LabelledPoint<2>>, const Vec<2>&);
template std::optional<Vec<3>> logistic_regression_normal<3>(std::span<const LabelledPoint<3>>, const Vec<3>&);
template Vec<2> gradient_normal<2>(GradientNormal, const VolumeGradient<2>&, const VolumeGradient<2>&, double);
template Vec<3> gradient_normal<3>(GradientNormal, const VolumeGradient<3>&, const VolumeGradient<3>&, double);

}  // namespace crampon
