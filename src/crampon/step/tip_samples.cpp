#include "crampon/step/tip_samples.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "crampon/core/parallel.hpp"
#include "crampon/material/elastic_constants.hpp"
#include "crampon/step/particle_view.hpp"

namespace crampon {

namespace {

/// Displacement gradient of particle l of a pack.
Tensor2 gradient_of(const Pack* u, std::size_t l) {
  return {Vec<2>{{u[0][static_cast<int>(l)], u[1][static_cast<int>(l)]}}, Vec<2>{{u[2][static_cast<int>(l)], u[3][static_cast<int>(l)]}}};
}

double distance_to_segment(const Vec<2>& x, const Vec<2>& a, const Vec<2>& b) {
  const Vec<2> along = b - a;
  const double length2 = dot(along, along);
  const double s = length2 > 0 ? std::clamp(dot(x - a, along) / length2, 0., 1.) : 0.;
  return norm(x - a - along * s);
}

double longest_side(const Model<2>& model) { return std::fmax(model.grid.cell[0], model.grid.cell[1]); }

/// The material about a tip: that of the nearest particle. Others count where a bond joins their velocity field to its own.
std::optional<std::uint32_t> material_at(const State<2>& state, const Model<2>& model, const Vec<2>& x, const TipWatch& watch) {
  double least = std::numeric_limits<double>::infinity();
  std::optional<std::uint32_t> nearest;
  for (const WatchedParticle& w : watch.particles) {
    if (model.ignores_cracks(model.materials[w.material].field)) continue;
    const double d = norm(state.particles.original[w.slot] - x);
    if (d < least) least = d, nearest = w.material;
  }
  if (least > longest_side(model)) return std::nullopt;
  return nearest;
}
bool belong_together(const Model<2>& model, std::uint32_t a, std::uint32_t b) {
  const auto& fields = model.contact.fields;
  return fields[model.materials[a].field].bonded_to == fields[model.materials[b].field].bonded_to;
}

/// Distance from a tip to the nearest place where the body does not fill space: its particles are dealt to a lattice about the tip, of which a node
/// that lies inside gets the area of a cell.
double distance_to_edge(const State<2>& state, const Model<2>& model, const Vec<2>& tip, std::uint32_t material, const TipWatch& watch,
                        double radius) {
  constexpr double full = 0.85;  // a node on a straight edge has a half, one that is .45 cells inside of it has this much
  const double h = longest_side(model);
  const int reach = static_cast<int>(std::ceil(radius / h)) + 1, side = 2 * reach + 1;
  std::vector<double> filled(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  for (const WatchedParticle& w : watch.particles) {
    if (!belong_together(model, w.material, material)) continue;
    const Vec<2> y = (state.particles.original[w.slot] - tip) * (1 / h);
    const int i = static_cast<int>(std::floor(y[0])), j = static_cast<int>(std::floor(y[1]));
    const double area = state.particles.volume(w.slot) / model.materials[w.material].thickness / (h * h);
    for (int a = 0; a < 2; ++a) {
      for (int b = 0; b < 2; ++b) {
        const int m = i + a + reach, n = j + b + reach;
        if (m < 0 || n < 0 || m >= side || n >= side) continue;
        filled[static_cast<std::size_t>(n * side + m)] += area * (1 - std::fabs(y[0] - (i + a))) * (1 - std::fabs(y[1] - (j + b)));
      }
    }
  }
  double nearest = std::numeric_limits<double>::infinity();
  for (int n = -reach; n <= reach; ++n) {
    for (int m = -reach; m <= reach; ++m) {
      if (filled[static_cast<std::size_t>((n + reach) * side + m + reach)] < full) nearest = std::fmin(nearest, h * std::hypot(m, n));
    }
  }
  return nearest;
}

/// Distance from a tip to other cracks, and to parts of its own to which the path comes back.
double distance_to_cracks(const State<2>& state, const CrackTip& tip, const Vec<2>& x, double radius) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < state.cracks.size(); ++c) {
    const Crack<2>& crack = state.cracks.list[c];
    const TipVertices vertices(crack, tip);
    bool left = c != tip.crack;  // the path has left the domain
    for (std::size_t k = 0; k + 1 < vertices.size(); ++k) {
      const Vec<2>&a = crack.original[vertices[k]], &b = crack.original[vertices[k + 1]];
      if (left) nearest = std::fmin(nearest, distance_to_segment(x, a, b));
      left = left || norm(b - x) >= radius;
    }
  }
  return nearest;
}

double distance_to_tips(const State<2>& state, const CrackTip& tip, const Vec<2>& x) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const CrackTip& other : state.fracture.tips) {
    if (other.crack == tip.crack && other.end == tip.end) continue;
    const Crack<2>& crack = state.cracks.list[other.crack];
    nearest = std::fmin(nearest, norm(crack.original[TipVertices(crack, other)[0]] - x));
  }
  return nearest;
}

/// Samples in the frame of the tip. Bodies that follow their deformation are turned back by the mean turn about the tip, so that what is added up is
/// small where strains are.
std::vector<TipSample> take_samples(const State<2>& state, const StepWork<2>& work, const Model<2>& model, const TipFrame& frame,
                                    const TipWatch& watch, std::uint32_t material, double radius, double dt) {
  std::vector<TipSample> samples;
  Vec<2> turn{{0, 0}};  // sums of the symmetric and the antisymmetric part of deformation gradients
  std::size_t last_pack = std::numeric_limits<std::size_t>::max();
  Pack u[4];
  PackReport report{};
  Pack dissipated{};
  const bool follows = model.materials[material].law->follows_deformation();
  for (const WatchedParticle& w : watch.particles) {
    const Vec<2> place = state.particles.original[w.slot] - frame.tip;
    if (norm(place) >= radius || !belong_together(model, w.material, material)) continue;
    if (state.particles.is_padding(w.slot)) continue;  // it left the grid in this step
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
    TipSample s;
    s.place = frame.turned(place);
    s.area = state.particles.volume(w.slot) / of.thickness;
    s.density = state.particles.mass(w.slot) / state.particles.volume(w.slot);
    s.gradient = gradient_of(u, lane);
    s.energy = report.energy[l] + dissipated[l];
    s.velocity = state.particles.velocity(w.slot);
    if (dt > 0) {
      const Prescribed<2>& outer = work.prescribed;
      s.inertia = (s.velocity - w.velocity) * (1 / dt) - outer.body_force + s.velocity * (outer.damping + outer.particle_damping);
      for (std::size_t i = 0; i < 2; ++i) s.rate[i] = (s.gradient[i] - w.gradient[i]) * (1 / dt);
    }
    const Pack* tau = view.stress();
    const Tensor2 kirchhoff = {Vec<2>{{tau[0][l], tau[2][l]}}, Vec<2>{{tau[2][l], tau[1][l]}}};
    s.stress = kirchhoff;
    if (of.law->follows_deformation()) {  // P = tau F^-T
      const Tensor2 F = {s.gradient[0] + Vec<2>{{1, 0}}, s.gradient[1] + Vec<2>{{0, 1}}};
      const double J = F[0][0] * F[1][1] - F[0][1] * F[1][0];
      for (std::size_t i = 0; i < 2; ++i) {
        s.stress[i] =
            Vec<2>{{kirchhoff[i][0] * F[1][1] - kirchhoff[i][1] * F[0][1], kirchhoff[i][1] * F[0][0] - kirchhoff[i][0] * F[1][0]}} *
            (1 / J);
      }
      turn += Vec<2>{{F[0][0] + F[1][1], F[1][0] - F[0][1]}} * s.area;
    }
    samples.push_back(s);
  }
  const Vec<2> axis = follows && norm(turn) > 0 ? normalized(turn) : Vec<2>{{1, 0}};
  const auto turn_back = [&](Tensor2& a) {  // its first index
    const Tensor2 was = a;
    a = {was[0] * axis[0] + was[1] * axis[1], was[1] * axis[0] - was[0] * axis[1]};
  };
  const auto turn_vector_back = [&](Vec<2>& a) { a = Vec<2>{{a[0] * axis[0] + a[1] * axis[1], a[1] * axis[0] - a[0] * axis[1]}}; };
  for (TipSample& s : samples) {
    s.gradient[0][0] += 1, s.gradient[1][1] += 1;
    turn_back(s.gradient);
    s.gradient[0][0] -= 1, s.gradient[1][1] -= 1;
    turn_back(s.stress), turn_back(s.rate);
    turn_vector_back(s.velocity), turn_vector_back(s.inertia);
    s.gradient = frame.turned(s.gradient), s.stress = frame.turned(s.stress), s.rate = frame.turned(s.rate);
    s.velocity = frame.turned(s.velocity), s.inertia = frame.turned(s.inertia);
  }
  return samples;
}

/// Pieces of the crack from the tip to where it leaves the domain, or to its end (radius: infinite), that bear tractions.
std::vector<FaceTraction> take_faces(const State<2>& state, const Model<2>& model, const CrackTip& tip, double radius,
                                     const TipWeight* weight) {
  const Crack<2>& crack = state.cracks.list[tip.crack];
  const CrackTraction& traction = model.tractions[tip.crack];
  std::vector<FaceTraction> faces;
  if (!traction.acts()) return faces;
  const TipVertices vertices(crack, tip);
  const TipFrame frame = present_frame(model, crack, tip);
  const Vec<2> x = crack.original[vertices[0]];
  const auto opening = [&](std::size_t v) { return frame.turned(crack.upper[v] - crack.lower[v]) * vertices.sign(); };
  const auto traction_at = [&](std::size_t v) {
    if (!(crack.traction.area[v] > 0)) return Vec<2>{};
    return frame.turned(crack.traction.force[v]) * (-vertices.sign() / crack.traction.area[v]);
  };
  for (std::size_t k = 0; k + 1 < vertices.size(); ++k) {
    const std::size_t near = vertices[k], far = vertices[k + 1];
    const double r = norm((crack.original[near] + crack.original[far]) * 0.5 - x);
    if (r >= radius) break;
    FaceTraction f;
    f.weight = weight ? weight->at(r) : 1;
    f.traction = (traction_at(near) + traction_at(far)) * 0.5;
    f.opening_step = opening(near) - opening(far);
    f.near = norm(crack.original[near] - x);
    f.far = norm(crack.original[far] - x);
    faces.push_back(f);
  }
  return faces;
}

/// Both sides of the pieces of crack in the domain: means over the samples beside them.
std::vector<CrackSideSample> sides_of(const std::vector<Vec<2>>& path, const std::vector<TipSample>& samples, double radius, double h) {
  std::vector<CrackSideSample> faces;
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    const Vec<2> middle = (path[k] + path[k + 1]) * 0.5, way = path[k] - path[k + 1];
    if (norm(middle) >= radius) break;
    const Vec<2> towards = normalized(way), left{{-towards[1], towards[0]}};
    for (const bool is_left : {true, false}) {
      CrackSideSample f;
      f.place = middle, f.length = norm(way), f.is_left = is_left;
      f.normal = is_left ? -left : left;
      double weights = 0;
      for (const TipSample& s : samples) {
        const Vec<2> y = (s.place - middle) * (1 / h);
        const double square = dot(y, y);
        if (square > 1 || (dot(y, left) > 0) != is_left) continue;
        const double w = s.area * (1 - square) * (1 - square);
        weights += w;
        f.energy += w * (s.energy + 0.5 * s.density * dot(s.velocity, s.velocity));
        for (std::size_t i = 0; i < 2; ++i) f.stress[i] += s.stress[i] * w, f.gradient[i] += s.gradient[i] * w;
      }
      if (!(weights > 0)) continue;
      f.energy *= 1 / weights;
      for (std::size_t i = 0; i < 2; ++i) f.stress[i] *= 1 / weights, f.gradient[i] *= 1 / weights;
      faces.push_back(f);
    }
  }
  return faces;
}

/// Opening at a distance behind the tip, {sliding, opening} of the left side, m.
Vec<2> opening_behind(const Model<2>& model, const Crack<2>& crack, const CrackTip& tip, double distance) {
  const TipVertices vertices(crack, tip);
  const TipFrame frame = present_frame(model, crack, tip);
  const auto opening = [&](std::size_t k) { return frame.turned(crack.upper[vertices[k]] - crack.lower[vertices[k]]) * vertices.sign(); };
  double behind = 0;
  for (std::size_t k = 0; k + 1 < vertices.size(); ++k) {
    const double length = norm(crack.original[vertices[k + 1]] - crack.original[vertices[k]]);
    if (behind + length >= distance) {
      const double s = (distance - behind) / length;
      return opening(k) * (1 - s) + opening(k + 1) * s;
    }
    behind += length;
  }
  return opening(vertices.size() - 1);
}

/// The direction of a tip is that of the chord from where its path is `chord` away from it: a kink of a fraction of a cell says little yet.
TipFrame frame_of(const std::vector<Vec<2>>& points, const Crack<2>& crack, const CrackTip& tip, double chord) {
  const TipVertices vertices(crack, tip);
  const Vec<2>& x = crack.original[vertices[0]];
  for (std::size_t k = 1; k < vertices.size(); ++k) {
    const double before = norm(crack.original[vertices[k - 1]] - x), here = norm(crack.original[vertices[k]] - x);
    if (here < chord && k + 1 < vertices.size()) continue;
    const double s = here > chord && here > before ? (chord - before) / (here - before) : 1;
    return {points[vertices[0]], points[vertices[k - 1]] * (1 - s) + points[vertices[k]] * s};
  }
  return {points[vertices[0]], points[vertices[1]]};
}

}  // namespace

TipFrame original_frame(const Model<2>& model, const Crack<2>& crack, const CrackTip& tip) {
  return frame_of(crack.original, crack, tip, chord_in_cells * longest_side(model));
}
TipFrame present_frame(const Model<2>& model, const Crack<2>& crack, const CrackTip& tip) {
  return frame_of(crack.plane, crack, tip, chord_in_cells * longest_side(model));
}

std::vector<TipWatch> watch_particles(const State<2>& state, const Model<2>& model) {
  const double reach = (model.fracture.outer + 2) * longest_side(model);  // and a cell of the lattice that finds edges
  std::vector<Vec<2>> places;
  for (const CrackTip& tip : state.fracture.tips) places.push_back(original_frame(model, state.cracks.list[tip.crack], tip).tip);
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
          of_run[r].push_back({static_cast<std::uint32_t>(t),
                               {static_cast<std::uint32_t>(p), run.material, state.particles.velocity(p), gradient_of(u, p % lanes)}});
        }
      }
    }
  });
  std::vector<TipWatch> watches(places.size());
  for (const auto& seen : of_run) {
    for (const Seen& s : seen) watches[s.tip].particles.push_back(s.particle);
  }
  return watches;
}

TipRoom find_room(const State<2>& state, const Model<2>& model, const CrackTip& tip, const TipWatch& watch) {
  const double h = longest_side(model);
  const Vec<2> x = original_frame(model, state.cracks.list[tip.crack], tip).tip;
  const auto material = material_at(state, model, x, watch);
  if (!material) return {0, NoParameter::outside};
  TipRoom room{model.fracture.outer * h, NoParameter::none};
  const auto bound = [&](double distance, NoParameter by) {
    if (distance < room.radius) room = {distance, by};
  };
  bound(distance_to_tips(state, tip, x), NoParameter::tip);
  bound(distance_to_cracks(state, tip, x, model.fracture.outer * h), NoParameter::crack);
  bound(distance_to_edge(state, model, x, *material, watch, model.fracture.outer * h), NoParameter::edge);
  return room;
}

void find_parameters(const State<2>& state, const StepWork<2>& work, const Model<2>& model, const TipWatch& watch, double dt,
                     CrackTip& tip) {
  const Crack<2>& crack = state.cracks.list[tip.crack];
  TipParameters now;
  if (tip.status == TipStatus::joined || tip.status == TipStatus::left) {  // a tip no more
    now.no_J = now.no_K = NoParameter::outside;
    tip.now = now;
    return;
  }
  const TipRoom room = find_room(state, model, tip, watch);
  now.radius = room.radius;
  const double h = longest_side(model);
  if (room.radius < std::fmin(FractureModel::least_outer, model.fracture.outer) * h * (1 - 1e-9)) {
    now.no_J = now.no_K = room.bound;
    tip.now = now;
    ++tip.missed;
    return;
  }
  ++tip.found;
  const TipFrame frame = original_frame(model, crack, tip);
  const std::uint32_t material = *material_at(state, model, frame.tip, watch);
  tip.material = material;
  const TipWeight weight(room.radius * model.fracture.inner / model.fracture.outer, room.radius);
  const std::vector<TipSample> samples = take_samples(state, work, model, frame, watch, material, room.radius, dt);
  const std::vector<FaceTraction> tractions = take_faces(state, model, tip, room.radius, &weight);
  std::vector<Vec<2>> path;
  const TipVertices vertices(crack, tip);
  for (std::size_t k = 0; k < vertices.size(); ++k) path.push_back(frame.turned(crack.original[vertices[k]] - frame.tip));
  const std::vector<CrackSideSample> faces = sides_of(path, samples, room.radius, h);
  const Vec<2> J = j_integral(samples, weight, tractions, faces);
  now.J = J[0], now.J_across = J[1];
  now.J_far = J[0];
  for (const FaceTraction& f : take_faces(state, model, tip, std::numeric_limits<double>::infinity(), nullptr))
    now.J_far -= dot(f.traction, f.opening_step);
  const Vec<2> opening = opening_behind(model, crack, tip, 2 * h);
  now.phase = std::atan2(opening[0], opening[1]);

  const auto elastic = model.materials[material].law->elasticity();
  const bool one_material = std::all_of(watch.particles.begin(), watch.particles.end(), [&](const WatchedParticle& w) {
    return w.material == material || !belong_together(model, w.material, material) ||
           norm(state.particles.original[w.slot] - frame.tip) >= room.radius || model.materials[w.material].law->elasticity() == elastic;
  });
  if (!one_material) {
    now.no_K = NoParameter::materials;
  } else if (!elastic) {
    now.no_K = NoParameter::anisotropic;
  } else {
    const PlaneElasticity plane(elastic->plane_lambda(model.stress_state), elastic->mu);
    StressIntensity K;
    if (model.fracture.mixity == FractureModel::Mixity::interaction) {
      K = share(now.J, interaction_integral(samples, weight, TipPath(path), plane, tractions, faces), plane);
    } else {
      K = partition_by_opening(now.J, opening, plane);
    }
    now.K_I = K.I, now.K_II = K.II;
  }
  tip.now = now;
}

TipState state_of_tip(const State<2>& state, const Model<2>& model, const CrackTip& tip, const TipWatch& watch) {
  const Crack<2>& crack = state.cracks.list[tip.crack];
  const double h = longest_side(model);
  TipState out;
  out.J = tip.now.J;
  out.K = {tip.now.K_I, tip.now.K_II};
  out.opening = opening_behind(model, crack, tip, 2 * h);
  if (const auto elastic = model.materials[tip.material].law->elasticity())
    out.elastic = PlaneElasticity(elastic->plane_lambda(model.stress_state), elastic->mu);
  out.time = state.clock.time;
  out.grown = tip.grown;
  // Mean Cauchy stress over particles ahead, whose weight falls with the distance in three cells.
  const TipFrame frame = original_frame(model, crack, tip), present = present_frame(model, crack, tip);
  Tensor2 sum{};
  double weights = 0;
  for (const WatchedParticle& w : watch.particles) {
    if (state.particles.is_padding(w.slot) || !belong_together(model, w.material, tip.material)) continue;
    const Vec<2> place = frame.turned(state.particles.original[w.slot] - frame.tip);
    const double r = norm(place) / (3 * h);
    if (place[0] <= 0 || r > 2) continue;
    const int l = static_cast<int>(w.slot % lanes);
    const PackView<2> view(state, model, w.material, w.slot / lanes);
    const Pack* tau = view.stress();
    const double to_cauchy = view.report().to_cauchy[l], weight = state.particles.volume(w.slot) * std::exp(-0.5 * r * r);
    sum[0] += Vec<2>{{tau[0][l], tau[2][l]}} * (to_cauchy * weight);
    sum[1] += Vec<2>{{tau[2][l], tau[1][l]}} * (to_cauchy * weight);
    weights += weight;
  }
  if (weights > 0) out.ahead = present.turned(Tensor2{sum[0] * (1 / weights), sum[1] * (1 / weights)});
  return out;
}

}  // namespace crampon
