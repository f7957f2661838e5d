/// Who meets whom at a node, how and along which normal (contact/find_pairs.hpp), from plain facts about the node.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "crampon/contact/find_pairs.hpp"
#include "crampon/contact/groups.hpp"
#include "crampon/contact/laws/adhesive.hpp"
#include "crampon/contact/laws/bonded.hpp"
#include "crampon/contact/laws/coulomb.hpp"
#include "crampon/contact/laws/frictionless.hpp"
#include "crampon/contact/laws/interface.hpp"
#include "crampon/contact/laws/none.hpp"
#include "unit/contact_geometry_cases.hpp"

namespace crampon::test {
namespace {

/// A law that asks for areas and remembers nothing.
const ContactLawSpec with_area = CoulombContact{0.3, {}, 1e6};
const Grid<2> grid({{-16, -16}}, {{1, 1}}, {32, 32});

/// `count` fields of bodies with particles of half size l, all of which meet by `law`.
ContactModel<2> fields_of(int count, const ContactLawSpec& law, Shape shape = boxes_of(kind_of<GimpShape>), double l = 0.25) {
  ContactModel<2> contact;
  contact.fields.assign(static_cast<std::size_t>(count), {});
  for (std::size_t f = 0; f < contact.fields.size(); ++f) {
    contact.fields[f].name = std::string(1, static_cast<char>('a' + f));
    contact.fields[f].bonded_to = static_cast<std::uint16_t>(f);
    contact.fields[f].half_size = l;
    contact.fields[f].edge = edge_map(shape, l);
  }
  contact.field_laws.assign(contact.fields.size() * contact.fields.size(), law);
  contact.field_normals.assign(contact.fields.size() * contact.fields.size(), {});
  return contact;
}

void set_law(ContactModel<2>& contact, std::size_t a, std::size_t b, const ContactLawSpec& law) {
  contact.field_laws[a * contact.fields.size() + b] = contact.field_laws[b * contact.fields.size() + a] = law;
}

/// What the node at x sees of particles of side a in field 0 and of side b in field 1, with density 1.
NodeFacts<2> facts_at(const Vec<2>& x, const std::vector<Particle<2>>& particles, Shape shape, double l) {
  NodeFacts<2> node;
  node.number = grid.node_number({16, 16});
  node.groups = 2;
  const View<2> view = see(particles, x, unit_cell, shape, l);
  for (int side = 0; side < 2; ++side) {
    FieldAtNode<2> at;
    at.layer = at.group = side;
    at.field = static_cast<std::uint16_t>(side);
    at.m = at.volume = view.V[side];
    at.x = at.X = view.x[side] * view.V[side];
    at.g = view.g[side];
    node.fields.push_back(at);
  }
  for (const Particle<2>& p : view.particles) {
    CloudPoint<2> point;
    point.layer = p.side == ContactSide::b;
    point.x = p.x;
    point.S = 1;
    for (int k = 0; k < 2; ++k) point.S *= profile(shape, p.x[k], l).value;
    point.m = 4 * l * l * point.S;
    point.half_size = {{l, l}};
    point.F = {p.half_edges[0] * (1 / l), p.half_edges[1] * (1 / l)};
    node.cloud.push_back(point);
  }
  return node;
}

/// A node that sees `count` fields, of mass 1 and volume 1 each, at the corners of a polygon about it; without a cloud.
NodeFacts<2> around(int count) {
  NodeFacts<2> node;
  node.number = grid.node_number({16, 16});
  node.groups = count;
  for (int f = 0; f < count; ++f) {
    FieldAtNode<2> at;
    at.layer = at.group = f;
    at.field = static_cast<std::uint16_t>(f);
    at.m = at.volume = 1;
    const double angle = 2 * pi * f / count + 0.3;
    at.x = at.X = {{0.3 * std::cos(angle), 0.3 * std::sin(angle)}};
    at.g = at.x * -1;
    node.fields.push_back(at);
  }
  return node;
}

const ContactMemory nothing_remembered;

std::vector<ContactPair<2>> pairs_of(NodeFacts<2> node, const ContactModel<2>& contact, const ContactMemory& memory = nothing_remembered,
                                     bool first_step = false) {
  return PairFinder<2>(contact, grid, memory, first_step).find(node);
}

/// "01|2" for groups 0 and 1 against group 2.
std::string who(const ContactPair<2>& pair) {
  std::string out;
  for_groups(pair.a, [&](int g) { out += std::to_string(g); });
  out += '|';
  for_groups(pair.b, [&](int g) { out += std::to_string(g); });
  return out;
}
std::vector<std::string> who(const std::vector<ContactPair<2>>& pairs) {
  std::vector<std::string> out;
  for (const auto& pair : pairs) out.push_back(who(pair));
  return out;
}
using Who = std::vector<std::string>;

Signature cracks(std::initializer_list<CrackId> list) {
  Signature s;
  for (const CrackId c : list) s.append(c);
  return s;
}

CrackAtNode<2> crack_at(CrackId crack, const Vec<2>& n, double side) { return {crack, n, n, side}; }

/// A line along which two half planes touch, at any angle and offset, with particles in rows along it: its nodes find its normal and no gap, and
/// their areas add up to its length.
TEST(FindPairs, TouchingHalfPlanes) {
  double worst_normal = 0, worst_gap = 0, worst_area = 0;
  for (const Shape shape : shapes) {
    double weights = 0, normal = 0, gap = 0;
    const ContactModel<2> contact = fields_of(2, with_area, shape);
    for (const double angle : {0., 7., 23., 45., 60., 90.}) {
      for (const double offset : {0., 0.13, 0.31, 0.5, 0.77}) {
        const Touching line{angle * degree, offset};
        const std::vector<Particle<2>> particles = line.particles(9);
        double area = 0;
        for (int i = -8; i <= 8; ++i) {
          for (int j = -8; j <= 8; ++j) {
            const Vec<2> x{{static_cast<double>(i), static_cast<double>(j)}};
            const double along = dot(x, line.t());
            // Nodes of a strip across the line, far from the ends of the particles.
            if (std::fabs(along) > 4 || std::fabs(dot(x, line.n()) - offset) > 3) continue;
            const NodeFacts<2> node = facts_at(x, particles, shape, line.l);
            if (!(std::fmin(node.fields[0].m, node.fields[1].m) > 1e-3)) continue;
            const auto pairs = pairs_of(node, contact);
            ASSERT_EQ(who(pairs), Who{"0|1"});
            ASSERT_TRUE(std::isfinite(norm(pairs[0].n)) && std::isfinite(pairs[0].gap) && std::isfinite(pairs[0].area));
            const double weight = std::fmin(node.fields[0].m, node.fields[1].m);
            weights += weight;
            normal += weight * degrees_between(pairs[0].n, line.n());
            gap += weight * std::fabs(pairs[0].gap);
            // Parts of neighbouring strips overlap by a linear ramp, so that the sum does not depend on where nodes lie.
            area += pairs[0].area * std::fmin(4 - std::fabs(along), 1.);
          }
        }
        worst_area = std::fmax(worst_area, std::fabs(area / 7 - 1));
      }
    }
    worst_normal = std::fmax(worst_normal, normal / weights);
    worst_gap = std::fmax(worst_gap, gap / weights);
  }
  // Means over nodes, by the mass of the smaller side. Linear functions see the fewest particles: .48 degrees, .008 cells. The others: at most .2
  // degrees. The sum of areas is off where a row of particles begins to be seen.
  EXPECT_LT(worst_normal, 0.6) << "degrees";
  EXPECT_LT(worst_gap, 0.01) << "cells";
  EXPECT_LT(worst_area, 0.04) << "of the length";
}

/// Fields swapped: the same pair from the other side.
TEST(FindPairs, DoesNotDependOnTheOrderOfFields) {
  for (const ContactDetection detection : {ContactDetection::position, ContactDetection::regression}) {
    for (const ContactNormal normal :
         {ContactNormal::logistic_regression, ContactNormal::linear_regression, ContactNormal::average_gradient}) {
      ContactModel<2> contact = fields_of(2, with_area);
      contact.material_detection = detection;
      contact.normal = normal;
      for (const double angle : {0., 30., 71.}) {
        const Touching line{angle * degree, 0.2};
        NodeFacts<2> node = facts_at({}, line.particles(), boxes_of(kind_of<GimpShape>), line.l);
        const ContactPair<2> pair = pairs_of(node, contact).at(0);
        for (auto& at : node.fields) at.field = static_cast<std::uint16_t>(1 - at.field);
        for (auto& at : node.fields) at.group = 1 - at.group;
        const ContactPair<2> swapped = pairs_of(node, contact).at(0);
        EXPECT_LT(norm(pair.n + swapped.n), 1e-9);
        EXPECT_NEAR(pair.gap, swapped.gap, 1e-9);
        EXPECT_NEAR(pair.area, swapped.area, 1e-9);
      }
    }
  }
}

/// A node on a symmetry plane sees half of both bodies and finds what it finds when it sees all; half of the area is the model's.
TEST(FindPairs, HalfOfANodeOnASymmetryPlane) {
  for (const ContactNormal normal : {ContactNormal::logistic_regression, ContactNormal::largest_gradient}) {
    ContactModel<2> contact = fields_of(2, with_area);
    contact.normal = normal;
    for (const double offset : {-0.3, 0., 0.2, 0.45}) {
      const double l = 0.25;
      const std::vector<Particle<2>> whole = rows(l, 0, {{0, offset}}, {{4, 4}}, [&](const Vec<2>& x) { return x[1] < offset ? -1 : 1; });
      std::vector<Particle<2>> half;
      std::copy_if(whole.begin(), whole.end(), std::back_inserter(half), [](const Particle<2>& p) { return p.x[0] > 0; });
      const Shape shape = boxes_of(kind_of<GimpShape>);
      const ContactPair<2> of_whole = pairs_of(facts_at({}, whole, shape, l), contact).at(0);
      NodeFacts<2> seen = facts_at({}, half, shape, l);
      seen.mirrors = {1u, 2};
      const ContactPair<2> of_half = pairs_of(seen, contact).at(0);
      EXPECT_LT(norm(of_half.n - of_whole.n), 1e-9);
      EXPECT_NEAR(of_half.gap, of_whole.gap, 1e-9);
      EXPECT_NEAR(of_half.area, 0.5 * of_whole.area, 1e-9);
      EXPECT_NEAR(of_half.volume_ratio, of_whole.volume_ratio, 1e-9);
    }
  }
}

/// A block in the corner of another meets it by two faces, each with its own name, normal and area.
TEST(FindPairs, BothFacesOfACorner) {
  ContactModel<2> contact = fields_of(2, with_area);
  const double l = 0.25;
  for (const double angle : {0., 20., 38.}) {
    const Vec<2> u{{std::cos(angle * degree), std::sin(angle * degree)}}, v{{-u[1], u[0]}};
    const auto particles = rows(l, angle * degree, {}, {{4, 4}}, [&](const Vec<2>& x) { return dot(x, u) > 0 && dot(x, v) > 0 ? 1 : -1; });
    const auto pairs = pairs_of(facts_at({}, particles, boxes_of(kind_of<GimpShape>), l), contact);
    ASSERT_EQ(who(pairs), (Who{"0|1", "0|1"}));
    EXPECT_EQ(pairs[0].name.face + pairs[1].name.face, 3);
    const bool along_u = std::fabs(dot(pairs[0].n, u)) > 0.7;
    EXPECT_LT(degrees_between(pairs[along_u ? 0 : 1].n, u), 1.);
    EXPECT_LT(degrees_between(pairs[along_u ? 1 : 0].n, v), 1.);
    for (const auto& pair : pairs) EXPECT_LT(std::fabs(pair.gap), 0.05);
  }
}

TEST(FindPairs, LawsThatDoNotMeet) {
  ContactModel<2> contact = fields_of(3, FrictionlessContact{});
  set_law(contact, 0, 2, NoContact{});
  EXPECT_EQ(who(pairs_of(around(3), contact)), (Who{"0|1", "1|2"}));
}

/// conventions 37: a side with less than the screen's share of the mass is left alone, but for a rigid partner, whose mass means nothing.
TEST(FindPairs, MassScreen) {
  ContactModel<2> contact = fields_of(2, FrictionlessContact{});
  contact.mass_screen = 1e-3;
  contact.normal = ContactNormal::largest_gradient;
  for (const double share : {1e-4, 0.9e-3, 1.1e-3, 0.5}) {
    NodeFacts<2> node = around(2);
    node.fields[0].m = share;
    node.fields[1].m = 1 - share;
    EXPECT_EQ(pairs_of(node, contact).size(), share < 1e-3 ? 0u : 1u) << share;
    contact.fields[1].rigid = contact.fields[1].ignores_cracks = true;
    EXPECT_EQ(pairs_of(node, contact).size(), 1u) << share;
    contact.fields[1].rigid = contact.fields[1].ignores_cracks = false;
  }
}

/// N13 Eq. 8: of three materials and more each meets all others as one, where that is chosen; two meet each other.
TEST(FindPairs, VirtualMaterial) {
  ContactModel<2> contact = fields_of(4, FrictionlessContact{});
  contact.normal = ContactNormal::largest_gradient;
  EXPECT_EQ(pairs_of(around(4), contact).size(), 6u);
  contact.several_materials = SeveralMaterials::virtual_material;
  const auto pairs = pairs_of(around(4), contact);
  EXPECT_EQ(who(pairs), (Who{"0|123", "1|023", "2|013", "3|012"}));
  for (const auto& pair : pairs) EXPECT_TRUE(pair.is_virtual());
  EXPECT_EQ(who(pairs_of(around(3), contact)), (Who{"0|12", "1|02", "2|01"}));
  EXPECT_EQ(who(pairs_of(around(2), contact)), (Who{"0|1"}));
}

/// The law and the normal of a virtual pair are those of the other material of most volume.
TEST(FindPairs, VirtualMaterialFollowsTheLargest) {
  ContactModel<2> contact = fields_of(4, FrictionlessContact{});
  contact.normal = ContactNormal::largest_gradient;
  contact.several_materials = SeveralMaterials::virtual_material;
  const ContactLawSpec rough = CoulombContact{0.7, {}, {}};
  set_law(contact, 0, 2, rough);
  NodeFacts<2> node = around(4);
  node.fields[2].volume = 1.5;
  const auto pairs = pairs_of(node, contact);
  EXPECT_EQ(pairs[0].law->name(), "coulomb");
  EXPECT_EQ(pairs[1].law->name(), "frictionless");
}

/// N13 sec. 2.3: at a node with two cracks, the fields beside each other meet, across the first crack and then across the second
/// (conventions 13).
TEST(FindPairs, FourCrackFields) {
  ContactModel<2> contact = fields_of(1, FrictionlessContact{});
  contact.crack_laws.assign(2, CoulombContact{0.3, {}, {}});
  NodeFacts<2> node = around(4);
  const Signature sides[] = {cracks({}), cracks({0}), cracks({1}), cracks({0, 1})};
  for (std::size_t f = 0; f < 4; ++f) node.fields[f].field = 0, node.fields[f].cracks = sides[f];
  // Particles across crack 0 lie below it (N03: the normal points from above to below), those across crack 1 above it.
  node.cracks = {crack_at(0, {{0, 1}}, -1), crack_at(1, {{1, 0}}, 1)};
  const auto pairs = pairs_of(node, contact);
  EXPECT_EQ(who(pairs), (Who{"0|1", "2|3", "2|0", "3|1"}));
  EXPECT_EQ(pairs[0].n, (Vec<2>{{0, 1}}));
  EXPECT_EQ(pairs[2].n, (Vec<2>{{1, 0}}));
}

/// Fields that lie on different sides of both cracks meet when no field lies between them (conventions 50); one after another, as in N13, not.
TEST(FindPairs, AcrossTwoCracksAtOnce) {
  ContactModel<2> contact = fields_of(1, FrictionlessContact{});
  contact.crack_laws.assign(2, CoulombContact{0.3, {}, {}});
  NodeFacts<2> node = around(2);
  node.fields[0].field = node.fields[1].field = 0;
  node.fields[1].cracks = cracks({0, 1});
  node.cracks = {crack_at(0, {{0, 1}}, -1), crack_at(1, {{1, 0}}, -1)};
  const auto pairs = pairs_of(node, contact);
  ASSERT_EQ(who(pairs), Who{"0|1"});
  EXPECT_LT(norm(pairs[0].n - normalized(Vec<2>{{1, 1}})), 1e-14);
  EXPECT_EQ(pairs[0].name.crack, 0u);
  EXPECT_TRUE(pairs[0].name.rest.contains(1));
  contact.pairs = ContactPairs::sequential;
  EXPECT_TRUE(pairs_of(node, contact).empty());
}

/// Bodies that no crack parts meet the fields on all sides of a crack; rigid ones come last (conventions 36).
TEST(FindPairs, BodiesThatIgnoreCracks) {
  ContactModel<2> contact = fields_of(3, FrictionlessContact{});
  contact.normal = ContactNormal::largest_gradient;
  contact.crack_laws.assign(1, FrictionlessContact{});
  contact.fields[1].rigid = contact.fields[1].ignores_cracks = true;
  contact.fields[2].ignores_cracks = true;
  NodeFacts<2> node = around(4);  // both sides of field 0, rigid field 1, whole field 2
  const std::uint16_t field[] = {0, 0, 1, 2};
  for (std::size_t f = 0; f < 4; ++f) node.fields[f].field = field[f];
  node.fields[1].cracks = cracks({0});
  node.cracks = {crack_at(0, {{0, 1}}, -1)};
  EXPECT_EQ(who(pairs_of(node, contact)), (Who{"0|1", "0|3", "1|3", "0|2", "1|2", "3|2"}));
}

/// A rigid body's face holds the row of nodes before it, and not the next one, which lies a cell deep in the material.
TEST(FindPairs, DeepNodesBeforeARigidFace) {
  for (const Shape shape : shapes) {
    ContactModel<2> contact = fields_of(2, FrictionlessContact{}, shape);
    contact.fields[1].rigid = contact.fields[1].ignores_cracks = true;
    int before = 0, behind = 0;  // nodes that see the rigid body
    for (const double depth : {0.2, 0.6, 0.95, 1.02, 1.3}) {
      const Touching line{0, depth};  // the rigid face is at y = depth, the node at 0
      const NodeFacts<2> node = facts_at({}, line.particles(), shape, line.l);
      if (!(node.fields[1].m > 0)) continue;
      ++(depth < 0.99 ? before : behind);
      const bool held = !pairs_of(node, contact).empty();
      // What tells the depth is the mean position of a face's particles, which a single row tells to a few hundredths.
      EXPECT_EQ(held, depth < 0.99) << "depth " << depth << " cells";
    }
    EXPECT_GT(before, 0);
    // Linear functions and uGIMP see no particles of the face from a cell away.
    EXPECT_GE(behind, shape.reach_of_sums() > 1 ? 1 : 0);
  }
}

/// Fields of bonded laws are one group: in chains, on the same sides of cracks; one after another, as in N13, they are not.
TEST(ContactGroups, ChainsOfBonds) {
  ContactModel<2> contact = fields_of(4, FrictionlessContact{});
  set_law(contact, 0, 2, BondedContact{});
  set_law(contact, 2, 3, BondedContact{});
  contact.crack_laws.assign(2, FrictionlessContact{});
  const std::vector<Layer> layers{{0, {}}, {1, {}}, {2, {}}, {3, {}}, {3, cracks({1})}};
  std::vector<int> group_of;
  EXPECT_EQ(find_groups(layers, contact, {0, 1, 2, 3, 4}, group_of), 3);
  EXPECT_EQ(group_of, (std::vector{0, 1, 0, 0, 2}));
  // Without the middle of the chain its ends are apart.
  EXPECT_EQ(find_groups(layers, contact, {0, 1, 3}, group_of), 3);
  EXPECT_EQ(group_of, (std::vector{0, 1, 2}));
  // A bonded crack does not part them.
  contact.crack_laws[1] = BondedContact{};
  EXPECT_EQ(find_groups(layers, contact, {0, 1, 2, 3, 4}, group_of), 2);
  EXPECT_EQ(group_of, (std::vector{0, 1, 0, 0, 0}));
  contact.pairs = ContactPairs::sequential;
  EXPECT_EQ(find_groups(layers, contact, {0, 1, 2, 3, 4}, group_of), 5);
}

/// A body that ignores cracks keeps its own velocity, though its law is bonded: it meets fields on all sides.
TEST(ContactGroups, WholeBodiesStayApart) {
  ContactModel<2> contact = fields_of(2, BondedContact{});
  contact.fields[1].ignores_cracks = true;
  std::vector<int> group_of;
  EXPECT_EQ(find_groups({{0, {}}, {1, {}}}, contact, {0, 1}, group_of), 2);
}

/// Of a pair the state of the last step is known by node, fields and cracks; where the node has changed sides of a crack that parts both from
/// it, under the other label.
TEST(FindPairs, RemembersStates) {
  ContactModel<2> contact = fields_of(2, FrictionlessContact{});
  contact.normal = ContactNormal::largest_gradient;
  contact.crack_laws.assign(1, FrictionlessContact{});
  NodeFacts<2> node = around(2);
  for (auto& at : node.fields) at.cracks = cracks({0});
  node.cracks = {crack_at(0, {{0, 1}}, -1)};
  ContactName name;
  name.field_a = 0, name.field_b = 1;
  name.others = cracks({0});
  ContactMemory memory;
  memory.entries = {{{node.number, name}, ContactState::slip}};
  memory.sides = {{node.number, 0, -1}};
  EXPECT_EQ(pairs_of(node, contact, memory).at(0).previous, ContactState::slip);
  EXPECT_EQ(pairs_of(node, contact).at(0).previous, ContactState::open);
  memory.sides[0].side = 1;  // the node lay on the other side: the pair was known as one that the crack does not part from it
  EXPECT_EQ(pairs_of(node, contact, memory).at(0).previous, ContactState::open);
  memory.entries[0].key.name.others = {};
  EXPECT_EQ(pairs_of(node, contact, memory).at(0).previous, ContactState::slip);
  node.number += 1;
  EXPECT_EQ(pairs_of(node, contact, memory).at(0).previous, ContactState::open);
}

/// Adhesion glues in the first step what lies within a tenth of a cell.
TEST(FindPairs, GluedFromTheStart) {
  const ContactModel<2> contact = fields_of(2, AdhesiveContact{0.3, 1e5, 1e5});
  const Shape shape = boxes_of(kind_of<GimpShape>);
  for (const double gap : {0., 0.05, 0.2, 0.5}) {
    std::vector<Particle<2>> particles = Touching{0, 0.1}.particles();
    for (Particle<2>& p : particles) {
      if (p.side == ContactSide::b) p.x[1] += gap;
    }
    const NodeFacts<2> node = facts_at({}, particles, shape, 0.25);
    const ContactPair<2> first = pairs_of(node, contact, nothing_remembered, true).at(0);
    EXPECT_NEAR(first.gap, gap, 0.02) << "cells; rows along the line: exact but for the table's steps";
    EXPECT_EQ(first.previous, gap < 0.1 ? ContactState::stick : ContactState::open);
    EXPECT_EQ(pairs_of(node, contact).at(0).previous, ContactState::open);
  }
}

/// The opening of an interface is what its sides have moved apart, whatever the strain and the turn of both together.
TEST(FindPairs, OpeningOfAnInterface) {
  const ContactModel<2> contact = fields_of(2, InterfaceContact{1e9, 1e9, 1e9, {}, {}, 0});
  const Shape shape = boxes_of(kind_of<GimpShape>);
  const std::vector<Particle<2>> at_start = Touching{0, 0.1}.particles();
  Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    // x = A X + d on side b, x = A X on side a.
    const Vec<2> d = trial == 0 ? Vec<2>{} : random.vector<2>(0.1);
    Vec<2> A[2] = {{{1, 0}}, {{0, 1}}};
    if (trial > 1) {
      for (Vec<2>& column : A) column += random.vector<2>(0.1);
    }
    std::vector<Particle<2>> particles = at_start;
    for (Particle<2>& p : particles) {
      p.x = A[0] * p.x[0] + A[1] * p.x[1] + (p.side == ContactSide::b ? d : Vec<2>{});
      for (Vec<2>& r : p.half_edges) r = A[0] * r[0] + A[1] * r[1];
    }
    NodeFacts<2> node = facts_at({}, particles, shape, 0.25);
    // Sums at the start, with the weights of now.
    for (auto& at : node.fields) at.X = {};
    for (const Particle<2>& p : particles) {
      double S = 1;
      for (int k = 0; k < 2; ++k) S *= profile(shape, p.x[k], 0.25).value;
      const Particle<2>& was = at_start[static_cast<std::size_t>(&p - particles.data())];
      if (S >= 1e-14) node.fields[p.side == ContactSide::b].X += was.x * (0.25 * S);
    }
    const ContactPair<2> pair = pairs_of(node, contact).at(0);
    EXPECT_LT(norm(pair.opening - d), 1e-12);
    EXPECT_NEAR(pair.gap, dot(d, pair.n), 1e-12);
  }
}

/// By displacements a gap is what faces have moved apart since the start; by volume it is closed or infinite (N03 Eq. 10).
TEST(FindPairs, OtherGaps) {
  ContactModel<2> contact = fields_of(2, FrictionlessContact{});
  contact.normal = ContactNormal::largest_gradient;
  contact.material_detection = ContactDetection::displacement;
  NodeFacts<2> node = around(2);
  const Vec<2> d{{0.02, 0.05}};
  node.fields[1].x += d * node.fields[1].m;
  ContactPair<2> pair = pairs_of(node, contact).at(0);
  EXPECT_NEAR(pair.gap, dot(d, pair.n), 1e-15);
  contact.material_detection = ContactDetection::volume;
  contact.volume_separated = 0.9;
  for (const double volume : {0.4, 0.44, 0.46, 0.6}) {  // of either field, in cells
    for (auto& at : node.fields) at.volume = volume;
    pair = pairs_of(node, contact).at(0);
    EXPECT_DOUBLE_EQ(pair.volume_ratio, 2 * volume);
    EXPECT_EQ(pair.gap, 2 * volume < 0.9 ? std::numeric_limits<double>::max() : 0.) << volume;
  }
}

/// Clouds are gathered where something reads them only.
TEST(FindPairs, CloudsWanted) {
  ContactModel<2> contact = fields_of(2, FrictionlessContact{});
  contact.detection = ContactDetection::displacement;
  EXPECT_TRUE(clouds_wanted(contact, grid).among_materials);
  EXPECT_FALSE(clouds_wanted(contact, grid).across_cracks);
  contact.normal = ContactNormal::largest_gradient;
  EXPECT_FALSE(clouds_wanted(contact, grid).among_materials);
  const Grid<2> long_cells({{0, 0}}, {{2, 1}}, {8, 8});
  EXPECT_TRUE(clouds_wanted(contact, long_cells).among_materials);
  contact.material_detection = ContactDetection::regression;
  EXPECT_TRUE(clouds_wanted(contact, grid).among_materials);
  contact.crack_laws = {InterfaceContact{1e9, 1e9, 1e9, {}, {}, 0}};
  EXPECT_TRUE(clouds_wanted(contact, grid).across_cracks);
}

}  // namespace
}  // namespace crampon::test
