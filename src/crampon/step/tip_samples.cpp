#include "crampon/step/tip_samples.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "crampon/core/parallel.hpp"
#include "crampon/step/particle_view.hpp"
#include "crampon/step/tip_room.hpp"

namespace crampon {

namespace {

/// Displacement gradient of particle l of a pack.
Tensor2 gradient_of(const Pack* u, std::size_t l) {
  return {Vec<2>{{u[0][static_cast<int>(l)], u[1][static_cast<int>(l)]}}, Vec<2>{{u[2][static_cast<int>(l)], u[3][static_cast<int>(l)]}}};
}

bool is_sampled(const State<2>& state, const Model<2>& model, const TipFrame& frame, const WatchedParticle& w, std::uint32_t material,
                double radius) {
  return norm(state.particles.original[w.slot] - frame.tip) < radius && belong_together(model, w.material, material) &&
         !state.particles.is_padding(w.slot);  // it left the grid in this step
}

/// Direction of the first axis after the mean turn of what is sampled: {cos, sin}. Laws of small strain do not turn.
Vec<2> mean_turn(const State<2>& state, const Model<2>& model, const TipFrame& frame, const TipWatch& watch, std::uint32_t material,
                 double radius) {
  Vec<2> sum;  // of the symmetric and the antisymmetric part of deformation gradients
  if (!model.materials[material].law->follows_deformation()) return {{1, 0}};
  for (const WatchedParticle& w : watch.particles) {
    if (!is_sampled(state, model, frame, w, material, radius)) continue;
    const Tensor2& u = w.gradient;  // of the start of the step: a turn is a matter of convenience
    sum += Vec<2>{{2 + u[0][0] + u[1][1], u[1][0] - u[0][1]}} * state.particles.volume(w.slot);
  }
  return norm(sum) > 0 ? normalized(sum) : Vec<2>{{1, 0}};
}

/// Opening at the k-th vertex from a tip: left side less right, in its present frame, m.
Vec<2> opening_at(const Crack<2>& crack, const TipVertices& vertices, const TipFrame& frame, std::size_t k) {
  return frame.turned(crack.upper[vertices[k]] - crack.lower[vertices[k]]) * vertices.sign();
}

}  // namespace

std::vector<TipWatch> watch_particles(const State<2>& state, const Model<2>& model) {
  const double reach = (model.fracture.outer + 2) * model.grid.largest_cell();  // and a cell of the lattice that finds edges
  std::vector<Vec<2>> places;
  std::vector<std::uint32_t> tip_at;  // the number of the tip at a place
  for (std::size_t t = 0; t < state.fracture.tips.size(); ++t) {
    const CrackTip& tip = state.fracture.tips[t];
    if (tip.status == TipStatus::unborn) continue;
    places.push_back(original_frame(model, state.cracks.list[tip.crack], tip).tip);
    tip_at.push_back(static_cast<std::uint32_t>(t));
  }
  struct Seen {
    std::uint32_t tip;
    WatchedParticle particle;
  };
  std::vector<std::vector<Seen>> of_run(state.order.runs.size());
  parallel_for(state.order.runs.size(), model.threads, [&](std::size_t r) {
    const Run& run = state.order.runs[r];
    if (model.is_rigid(model.materials[run.material].field)) return;
    for (std::size_t k = run.first_pack; k < run.end_pack; ++k) {
      bool known = false;
      Pack u[4];
      for (std::size_t p = k * lanes; p < (k + 1) * lanes; ++p) {
        const Vec<2>& X = state.particles.original[p];
        for (std::size_t t = 0; t < places.size(); ++t) {
          if (std::fabs(X[0] - places[t][0]) > reach || std::fabs(X[1] - places[t][1]) > reach || state.particles.is_padding(p)) continue;
          if (!known) PackView<2>(state, model, run.material, k).displacement_gradient(u);
          known = true;
          of_run[r].push_back(
              {tip_at[t], {static_cast<std::uint32_t>(p), run.material, state.particles.velocity(p), gradient_of(u, p % lanes)}});
        }
      }
    }
  });
  std::vector<TipWatch> watches(state.fracture.tips.size());
  for (const auto& seen : of_run) {
    for (const Seen& s : seen) watches[s.tip].particles.push_back(s.particle);
  }
  return watches;
}

std::vector<TipSample> take_samples(const State<2>& state, const StepWork<2>& work, const Model<2>& model, const TipFrame& frame,
                                    const TipWatch& watch, std::uint32_t material, double radius, double dt) {
  const TipFrame spatial = frame.turned_by(mean_turn(state, model, frame, watch, material, radius));
  std::vector<TipSample> samples;
  std::size_t last_pack = std::numeric_limits<std::size_t>::max();
  Pack u[4];
  PackReport report{};
  Pack dissipated{};
  for (const WatchedParticle& w : watch.particles) {
    if (!is_sampled(state, model, frame, w, material, radius)) continue;
    const std::size_t pack = w.slot / lanes, lane = w.slot % lanes;
    const int l = static_cast<int>(lane);
    const PackView<2> view(state, model, w.material, pack);
    if (pack != last_pack) {
      view.displacement_gradient(u);
      report = view.report();
      dissipated = view.dissipated();
      last_pack = pack;
    }
    const Material<2>& of = model.materials[w.material];
    const Tensor2 gradient = gradient_of(u, lane), F = {gradient[0] + Vec<2>{{1, 0}}, gradient[1] + Vec<2>{{0, 1}}};
    TipSample s;
    s.place = frame.turned(state.particles.original[w.slot] - frame.tip);
    s.area = state.particles.volume(w.slot) / of.thickness;
    s.density = state.particles.mass(w.slot) / state.particles.volume(w.slot);
    s.gradient = turned(F, spatial, frame);
    s.gradient[0][0] -= 1, s.gradient[1][1] -= 1;
    s.energy = report.energy[l] + dissipated[l];
    const Vec<2> velocity = state.particles.velocity(w.slot);
    s.velocity = spatial.turned(velocity);
    if (dt > 0) {
      const Prescribed<2>& outer = work.prescribed;
      s.inertia =
          spatial.turned((velocity - w.velocity) * (1 / dt) - outer.body_force + velocity * (outer.damping + outer.particle_damping));
      s.rate = turned(Tensor2{(gradient[0] - w.gradient[0]) * (1 / dt), (gradient[1] - w.gradient[1]) * (1 / dt)}, spatial, frame);
    }
    const Pack* tau = view.stress();
    Tensor2 stress = {Vec<2>{{tau[0][l], tau[2][l]}}, Vec<2>{{tau[2][l], tau[1][l]}}};
    if (of.law->follows_deformation()) {  // P = tau F^-T
      const double J = F[0][0] * F[1][1] - F[0][1] * F[1][0];
      for (Vec<2>& row : stress) row = Vec<2>{{row[0] * F[1][1] - row[1] * F[0][1], row[1] * F[0][0] - row[0] * F[1][0]}} * (1 / J);
    }
    s.stress = turned(stress, spatial, frame);
    samples.push_back(s);
  }
  return samples;
}

std::vector<FaceTraction> take_tractions(const State<2>& state, const Model<2>& model, const CrackTip& tip, double radius,
                                         const VirtualExtension* extension) {
  const Crack<2>& crack = state.cracks.list[tip.crack];
  std::vector<FaceTraction> pieces;
  if (!model.tractions[tip.crack].acts()) return pieces;
  const TipVertices vertices(crack, tip);
  const TipFrame frame = present_frame(model, crack, tip);
  const Vec<2> x = crack.original[vertices[0]];
  const auto traction_at = [&](std::size_t v) {
    return frame.turned(crack.traction.force[v]) * (-vertices.sign() / crack.traction.area[v]);
  };
  for (std::size_t k = 0; k + 1 < vertices.size(); ++k) {
    const std::size_t near = vertices[k], far = vertices[k + 1];
    const double r = norm((crack.original[near] + crack.original[far]) * 0.5 - x);
    if (r >= radius) break;
    // A law acts on pieces both ends of which bear it (areas_between()).
    if (!(crack.traction.area[near] > 0 && crack.traction.area[far] > 0)) continue;
    FaceTraction f;
    f.weight = extension ? extension->on_path(r) : 1;
    f.traction = (traction_at(near) + traction_at(far)) * 0.5;
    // Ahead of the tip there is no opening; its own, a mean over a cell, is worked on by the traction as well.
    f.opening_step = (k == 0 ? Vec<2>{} : opening_at(crack, vertices, frame, k)) - opening_at(crack, vertices, frame, k + 1);
    f.near = norm(crack.original[near] - x);
    f.far = norm(crack.original[far] - x);
    pieces.push_back(f);
  }
  return pieces;
}

std::vector<FaceTraction> take_contact_tractions(const State<2>& state, const Model<2>& model, const CrackTip& tip,
                                                 const VirtualExtension& extension, const std::vector<CrackSideSample>& sides,
                                                 double modulus) {
  const Crack<2>& crack = state.cracks.list[tip.crack];
  const TipVertices vertices(crack, tip);
  const TipFrame frame = present_frame(model, crack, tip);
  const Vec<2> x = crack.original[vertices[0]];
  const auto bears_a_law = [&](std::size_t v) { return !crack.traction.area.empty() && crack.traction.area[v] > 0; };
  // Means beside the faces also hold what is ahead of a tip within 1.5 cells: there the stress of the first piece beyond is taken.
  const double h = model.grid.largest_cell();
  std::size_t clear = 0;
  while (clear + 1 < sides.size() && (norm(sides[clear].place) < 1.5 * h || sides[clear].piece != sides[clear + 1].piece)) ++clear;
  std::vector<FaceTraction> pieces;
  const ContactLaw& law = model.contact.law_across(static_cast<CrackId>(tip.crack));
  if (law.ignores()) return pieces;
  for (std::size_t s = 0; s + 1 < sides.size(); ++s) {
    const CrackSideSample &left = sides[s], &right = sides[s + 1];
    if (left.piece != right.piece) continue;  // the other side holds no material
    const std::size_t k = left.piece, near = vertices[k], far = vertices[k + 1];
    if (bears_a_law(near) && bears_a_law(far)) continue;
    const Vec<2>& up = right.normal;
    FaceTraction f;
    const std::size_t from = clear + 1 < sides.size() ? std::max(s, clear) : s;
    for (std::size_t i = 0; i < 2; ++i) f.traction[i] = 0.5 * (dot(sides[from].stress[i], up) + dot(sides[from + 1].stress[i], up));
    const Vec<2> at_near = k == 0 ? Vec<2>{} : opening_at(crack, vertices, frame, k), at_far = opening_at(crack, vertices, frame, k + 1);
    const double pressure = -dot(f.traction, up), opening = 0.5 * dot(at_near + at_far, up);
    if (!(pressure > 0) || opening * modulus > pressure * h) continue;
    const Vec<2> along{{up[1], -up[0]}};
    Sliding sliding;  // per area and time
    const double shear = dot(f.traction, along);
    sliding.normal = pressure, sliding.full = std::fabs(shear), sliding.mass = sliding.dt = sliding.area = 1;
    const SlidingLimit limit = law.limit(sliding);
    if (!limit.sticks) {
      const double bound = limit.per_normal * pressure + limit.rest;
      f.traction += along * (std::clamp(shear, -bound, bound) - shear);
    }
    f.weight = extension.on_path(norm(left.place));
    f.opening_step = at_near - at_far;
    f.opening_step -= up * dot(f.opening_step, up);
    f.near = norm(crack.original[near] - x);
    f.far = norm(crack.original[far] - x);
    pieces.push_back(f);
  }
  return pieces;
}

std::vector<Vec<2>> path_behind(const Crack<2>& crack, const CrackTip& tip, const TipFrame& frame) {
  std::vector<Vec<2>> path;
  const TipVertices vertices(crack, tip);
  for (std::size_t k = 0; k < vertices.size(); ++k) path.push_back(frame.turned(crack.original[vertices[k]] - frame.tip));
  return path;
}

std::vector<CrackSideSample> take_sides(const std::vector<Vec<2>>& path, const std::vector<TipSample>& samples, double radius,
                                        double cell) {
  std::vector<CrackSideSample> sides;
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    const Vec<2> middle = (path[k] + path[k + 1]) * 0.5, way = path[k] - path[k + 1];
    if (norm(middle) >= radius) break;
    const Vec<2> towards = normalized(way), left{{-towards[1], towards[0]}};
    for (const bool is_left : {true, false}) {
      CrackSideSample f;
      f.place = middle, f.length = norm(way), f.is_left = is_left, f.piece = k;
      f.normal = is_left ? -left : left;
      double weights = 0;
      for (const TipSample& s : samples) {
        const Vec<2> y = (s.place - middle) * (1 / cell);
        const double square = dot(y, y);
        if (square > 1 || (dot(y, left) > 0) != is_left) continue;
        const double w = s.area * (1 - square) * (1 - square);
        weights += w;
        f.energy += w * (s.energy + 0.5 * s.density * dot(s.velocity, s.velocity));
        f.momentum += s.velocity * (w * s.density);
        for (std::size_t i = 0; i < 2; ++i) f.stress[i] += s.stress[i] * w, f.gradient[i] += s.gradient[i] * w;
      }
      if (!(weights > 0)) continue;
      f.energy *= 1 / weights;
      f.momentum *= 1 / weights;
      for (std::size_t i = 0; i < 2; ++i) f.stress[i] *= 1 / weights, f.gradient[i] *= 1 / weights;
      sides.push_back(f);
    }
  }
  return sides;
}

}  // namespace crampon
