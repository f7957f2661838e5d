#include "crampon/material/initial_state.hpp"

#include <Eigen/LU>

#include <array>
#include <cmath>

namespace crampon {

namespace {

/// Of chosen component c: the entries of a symmetric velocity gradient, and the component of what particles hold.
template <int Dim>
struct Component {
  int row, column, stored;
};
template <int Dim>
constexpr std::array<Component<Dim>, chosen_stress_size<Dim>> components() {
  if constexpr (Dim == 2) {
    return {{{0, 0, 0}, {1, 1, 1}, {0, 1, 2}}};
  } else {
    return {{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {0, 1, 3}, {1, 2, 4}, {0, 2, 5}}};
  }
}

template <int Dim>
class StateSearch {
  static constexpr int size = chosen_stress_size<Dim>;
  using Strain = std::array<Pack, size>;

 public:
  StateSearch(const MaterialLaw& law, StressState state, const Pack* cauchy, Pack* stress, Pack* history)
      : law_(law), state_(state), cauchy_(cauchy), stress_(stress), history_(history) {}

  bool run() {
    // Differences over a strain far below those of solids under load, and far above round-off.
    constexpr double difference = 1e-7;
    Strain strain{}, missing;
    strain.fill(splat(0.));
    for (int iteration = 0; iteration < 30; ++iteration) {
      if (!strained(strain, missing)) return false;
      if (small(missing)) return is_elastic();
      double largest_change = 0;
      std::array<Strain, size> columns;
      for (int c = 0; c < size; ++c) {
        Strain moved = strain;
        moved[static_cast<std::size_t>(c)] += difference;
        if (!strained(moved, columns[static_cast<std::size_t>(c)])) return false;
      }
      for (int l = 0; l < lanes; ++l) {
        Eigen::Matrix<double, size, size> slope;
        Eigen::Matrix<double, size, 1> right;
        for (std::size_t r = 0; r < size; ++r) {
          right(static_cast<int>(r)) = missing[r][l];
          for (std::size_t c = 0; c < size; ++c)
            slope(static_cast<int>(r), static_cast<int>(c)) = (missing[r][l] - columns[c][r][l]) / difference;
        }
        const Eigen::Matrix<double, size, 1> change = slope.partialPivLu().solve(right);
        for (std::size_t c = 0; c < size; ++c) strain[c][l] += change(static_cast<int>(c));
        largest_change = std::fmax(largest_change, change.cwiseAbs().maxCoeff());
      }
      // Laws that hold 1 + strain know no smaller change.
      if (largest_change < 4e-16) return strained(strain, missing) && is_elastic();
    }
    return false;
  }

 private:
  /// Sets stress and history to those of a strain, and finds what the stress is short of.
  bool strained(const Strain& strain, Strain& missing) {
    law_.initialise(Dim, stress_, history_);
    Pack L[Dim * Dim];
    for (std::size_t c = 0; c < size; ++c) {
      const auto at = components<Dim>()[c];
      L[at.row * Dim + at.column] = L[at.column * Dim + at.row] = strain[c];
    }
    StressBatch<Dim> batch;
    batch.packs = 1;
    batch.dt = 1;
    batch.L = L;
    batch.stress = stress_;
    batch.history = history_;
    batch.history_stride = law_.history_size(Dim);
    if (!law_.update(state_, batch)) return false;
    const Pack to_cauchy = law_.report(state_, Dim, stress_, history_).to_cauchy;
    for (std::size_t c = 0; c < size; ++c) missing[c] = cauchy_[c] - stress_[components<Dim>()[c].stored] * to_cauchy;
    return true;
  }
  /// A body that has flowed to bear its stress did so on a way that nobody has told.
  bool is_elastic() const {
    const LawVariable* dissipated = law_.dissipated(Dim);
    return !dissipated || !any_positive(history_[dissipated->at]);
  }
  bool small(const Strain& missing) const {
    for (int l = 0; l < lanes; ++l) {
      double wanted = 0, left = 0;
      for (std::size_t c = 0; c < size; ++c) {
        wanted = std::fmax(wanted, std::fabs(cauchy_[c][l]));
        left = std::fmax(left, std::fabs(missing[c][l]));
      }
      if (!(left <= 1e-12 * wanted)) return false;
    }
    return true;
  }

  const MaterialLaw& law_;
  StressState state_;
  const Pack* cauchy_;
  Pack* stress_;
  Pack* history_;
};

}  // namespace

template <int Dim>
bool find_initial_state(const MaterialLaw& law, StressState state, const Pack* cauchy, Pack* stress, Pack* history) {
  return StateSearch<Dim>(law, state, cauchy, stress, history).run();
}

template bool find_initial_state<2>(const MaterialLaw&, StressState, const Pack*, Pack*, Pack*);
template bool find_initial_state<3>(const MaterialLaw&, StressState, const Pack*, Pack*, Pack*);

}  // namespace crampon
