#include "crampon/crack/traction/law.hpp"

namespace crampon {

Traction update_traction(const TractionLaw& law, const PerMode& opening, double time, const Vec<3>& x, TractionHistory& history) {
  PerMode u = opening;
  if (!law.acts_closed() && u.normal < 0) u.normal = 0;
  const Traction T = history.failed != 0 ? Traction{} : law.respond(u, time, x, history);
  history.work_normal += 0.5 * (history.normal_traction + T.normal) * (u.normal - history.normal_opening);
  history.work_shear += 0.5 * (history.shear_traction + T.shear) * (u.shear - history.shear_opening);
  history.normal_traction = T.normal;
  history.shear_traction = T.shear;
  history.normal_opening = u.normal;
  history.shear_opening = u.shear;
  return T;
}

}  // namespace crampon
