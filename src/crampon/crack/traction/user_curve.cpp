#include "crampon/crack/traction/user_curve.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "crampon/crack/traction/curve.hpp"

namespace crampon {

namespace {

/// At an end: the slope of the parabola through three points, but no rise. h: of the end piece and the next.
double end_slope(double h0, double h1, double d0, double d1) { return std::min(0., ((2 * h0 + h1) * d0 - h0 * d1) / (h0 + h1)); }

/// Slopes at the points of a table that does not rise.
std::vector<double> pchip_slopes(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t last = x.size() - 1;
  const auto h = [&](std::size_t k) { return x[k + 1] - x[k]; };
  const auto d = [&](std::size_t k) { return (y[k + 1] - y[k]) / h(k); };
  if (last == 1) return {d(0), d(0)};
  std::vector<double> m(last + 1, 0.);
  m[0] = end_slope(h(0), h(1), d(0), d(1));
  m[last] = end_slope(h(last - 1), h(last - 2), d(last - 1), d(last - 2));
  for (std::size_t k = 1; k < last; ++k) {
    if (d(k - 1) == 0 || d(k) == 0) continue;
    const double w0 = 2 * h(k) + h(k - 1), w1 = h(k) + 2 * h(k - 1);
    m[k] = (w0 + w1) / (w0 / d(k - 1) + w1 / d(k));
  }
  return m;
}

/// A cubic on [0, h] by its values and slopes at the ends.
struct HermitePiece {
  double h, y0, y1, m0, m1;
  double c() const { return (3 * (y1 - y0) / h - 2 * m0 - m1) / h; }
  double b() const { return (m0 + m1 - 2 * (y1 - y0) / h) / (h * h); }
  double value(double t) const { return y0 + t * (m0 + t * (c() + t * b())); }
  double area(double t) const { return t * (y0 + t * (m0 / 2 + t * (c() / 3 + t * b() / 4))); }
};

}  // namespace

UserCurve::UserCurve(std::vector<double> openings, std::vector<double> stresses)
    : u_(std::move(openings)), S_(std::move(stresses)), m_(pchip_slopes(u_, S_)), W_{0.5 * S_.front() * u_.front()} {
  for (std::size_t k = 1; k < u_.size(); ++k) {
    const double h = u_[k] - u_[k - 1];
    W_.push_back(W_.back() + 0.5 * h * (S_[k - 1] + S_[k]) + h * h * (m_[k - 1] - m_[k]) / 12);
  }
}

std::size_t UserCurve::piece(double u) const {
  const auto above = std::upper_bound(u_.begin() + 1, u_.end() - 1, u);
  return static_cast<std::size_t>(above - u_.begin()) - 1;
}

double UserCurve::stress(double u) const {
  if (u <= u_.front()) return stiffness() * u;
  if (u >= u_.back()) return S_.back();
  const std::size_t k = piece(u);
  return std::max(0., HermitePiece{u_[k + 1] - u_[k], S_[k], S_[k + 1], m_[k], m_[k + 1]}.value(u - u_[k]));
}

double UserCurve::dissipated(double u) const {
  if (u <= u_.front()) return 0;
  if (u >= u_.back()) return dissipated_of(W_.back(), S_.back(), u_.back());
  const std::size_t k = piece(u);
  const HermitePiece p{u_[k + 1] - u_[k], S_[k], S_[k + 1], m_[k], m_[k + 1]};
  return dissipated_of(W_[k] + p.area(u - u_[k]), p.value(u - u_[k]), u);
}

UserCurveInput UserCurveInput::example() {
  UserCurveInput in;
  in.openings = {1e-5, 2.5e-5, 4e-5, 1e-4}, in.stresses = {5e6, 4.6e6, 2e6, 0};
  return in;
}

const Declaration<UserCurveInput>& UserCurveInput::declaration() {
  static const auto d =
      Declaration<UserCurveInput>(name, "A table of traction over opening: elastic up to its first point, which is the peak.")
          .quantities("openings", &UserCurveInput::openings, "m", Bounds::positive(), "openings, rising; the last one ends the law",
                      Presence::required, Length::at_least(2))
          .quantities("stresses", &UserCurveInput::stresses, "Pa", Bounds::non_negative(),
                      "traction at each opening, from the strength down; it is interpolated without overshoot", Presence::required,
                      Length::at_least(2))
          .check([](const UserCurveInput& in, Diagnostics& diagnostics) {
            if (in.openings.size() != in.stresses.size()) {
              diagnostics.add("stresses", fmt::format("{} stresses for {} openings", in.stresses.size(), in.openings.size()),
                              "each point of the table has both", "add or remove some");
              return;
            }
            if (in.stresses.front() == 0)
              diagnostics.add("stresses[0]", "the first stress is 0", "the first point is the peak", "leave out the origin");
            for (std::size_t k = 1; k < in.openings.size(); ++k) {
              if (!(in.openings[k] > in.openings[k - 1]))
                diagnostics.add(fmt::format("openings[{}]", k), "the openings do not rise",
                                fmt::format("{:g} m after {:g} m", in.openings[k], in.openings[k - 1]), "sort the table");
              if (in.stresses[k] > in.stresses[k - 1])
                diagnostics.add(fmt::format("stresses[{}]", k), "the stress rises after the peak",
                                fmt::format("{:g} Pa after {:g} Pa", in.stresses[k], in.stresses[k - 1]),
                                "let the table begin at the largest stress");
            }
          });
  return d;
}

}  // namespace crampon
