#pragma once
/// What is known of the tips of cracks: fracture parameters as they were last found (docs/theory/fracture.md).

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "crampon/core/members.hpp"
#include "crampon/core/vector.hpp"

namespace crampon {

/// Why there is no J at a tip, or no K.
enum class NoParameter : std::uint8_t {
  none,         ///< there is one
  outside,      ///< the tip does not lie in a body
  edge,         ///< nearer than the smallest domain to the edge of the body
  tip,          ///< ... to another tip
  crack,        ///< ... to another crack, or to another part of its own
  load,         ///< ... to where a load or a prescribed velocity acts
  corner,       ///< its path turns sharply within the domain, and J is taken along a circle
  materials,    ///< several materials about the tip: J, but no K
  anisotropic,  ///< the law has no isotropic elasticity at small strain: J, but no K
  fast,         ///< the tip is not slower than Rayleigh waves: J, but no K
};

/// What follows "there is no J" or "no K": why.
constexpr const char* reason(NoParameter why) {
  switch (why) {
    case NoParameter::none:
      return "";
    case NoParameter::outside:
      return "the tip does not lie in a body";
    case NoParameter::edge:
      return "the edge of the body is too near";
    case NoParameter::tip:
      return "another tip is too near";
    case NoParameter::crack:
      return "another crack, or another part of its own, is too near";
    case NoParameter::load:
      return "a load or a prescribed velocity acts too near";
    case NoParameter::corner:
      return "its path turns sharply near it, which form = \"domain\" can take";
    case NoParameter::materials:
      return "several materials meet there";
    case NoParameter::anisotropic:
      return "its material has no isotropic elasticity";
    case NoParameter::fast:
      return "it is not slower than Rayleigh waves";
  }
  return "";
}

/// What has become of a tip.
enum class TipStatus : std::uint8_t {
  waits,  ///< it has not grown yet
  grows,
  joined,    ///< it has met another crack, or its own path
  left,      ///< ... the edge of the body
  arrested,  ///< it has grown as far as it may
  unborn,    ///< its crack has not started (docs/theory/fracture.md, nucleation)
};
/// As users meet them, in the order of their numbers.
struct TipStatusWord {
  const char *word, *meaning;
};
inline constexpr std::array tip_status_words = {
    TipStatusWord{"waits", "it has not grown yet"},
    TipStatusWord{"grows", "it has grown and may grow on"},
    TipStatusWord{"joined", "it has met a crack"},
    TipStatusWord{"left", "it has met the edge of the body"},
    TipStatusWord{"arrested", "it has grown as far as it may"},
    TipStatusWord{"unborn", "its crack has not started"},
};

/// What is found at a tip.
struct TipParameters {
  double J = std::numeric_limits<double>::quiet_NaN();         ///< of what goes into the tip itself, J/m2
  double J_far = std::numeric_limits<double>::quiet_NaN();     ///< of what comes from afar: tractions of the faces take the rest, J/m2
  double J_across = std::numeric_limits<double>::quiet_NaN();  ///< second component, J/m2
  double R = std::numeric_limits<double>::quiet_NaN();         ///< J and what tractions have taken for good where they end, J/m2
  double K_I = std::numeric_limits<double>::quiet_NaN(), K_II = std::numeric_limits<double>::quiet_NaN();  ///< Pa sqrt(m)
  /// Intensities at which a tip at rest would have this J, Pa sqrt(m): for criteria of growth, whose drive is an energy.
  double rest_I = std::numeric_limits<double>::quiet_NaN(), rest_II = std::numeric_limits<double>::quiet_NaN();
  double phase = std::numeric_limits<double>::quiet_NaN();   ///< atan2(sliding, opening) behind the tip, rad
  double radius = std::numeric_limits<double>::quiet_NaN();  ///< of the domain, m
  double speed = 0;                                          ///< over the last two cells of growth, m/s
  NoParameter no_J = NoParameter::none, no_K = NoParameter::none;

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [J, J_far, J_across, R, K_I, K_II, rest_I, rest_II, phase, radius, speed, no_J, no_K] = self;
    visit(Member{"J", "J/m2"}, J);
    visit(Member{"J_far", "J/m2"}, J_far);
    visit(Member{"J_across", "J/m2"}, J_across);
    visit(Member{"R", "J/m2"}, R);
    visit(Member{"K_I", "Pa m^(1/2)"}, K_I);
    visit(Member{"K_II", "Pa m^(1/2)"}, K_II);
    visit(Member{"rest_I", "Pa m^(1/2)"}, rest_I);
    visit(Member{"rest_II", "Pa m^(1/2)"}, rest_II);
    visit(Member{"phase", "rad"}, phase);
    visit(Member{"radius", "m"}, radius);
    visit(Member{"speed", "m/s"}, speed);
    visit(Member{"no_J"}, no_J);
    visit(Member{"no_K"}, no_K);
  }
};

/// An end of a crack that lies in a body.
struct CrackTip {
  std::uint32_t crack = 0;
  std::uint8_t end = 1;                ///< 0: where the path starts; 1: where it ends
  TipParameters now;                   ///< as they were last found
  std::int64_t found = 0, missed = 0;  ///< how often there was a J since the start, and how often not

  std::uint32_t material = 0;  ///< about the tip, where it was last found
  TipStatus status = TipStatus::waits;
  double grown = 0;       ///< since the start, m
  double speed = 0;       ///< of the last growth, m/s
  double next_check = 0;  ///< of whether it grows, s
  Vec<2> initial;         ///< direction at the start
  bool fired = false;     ///< the first criterion has let it grow

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [crack, end, now, found, missed, material, status, grown, speed, next_check, initial, fired] = self;
    visit(Member{"crack"}, crack);
    visit(Member{"end"}, end);
    visit(Member{"now"}, now);
    visit(Member{"found"}, found);
    visit(Member{"missed"}, missed);
    visit(Member{"material"}, material);
    visit(Member{"status"}, status);
    visit(Member{"grown", "m"}, grown);
    visit(Member{"speed", "m/s"}, speed);
    visit(Member{"next_check", "s"}, next_check);
    visit(Member{"initial"}, initial);
    visit(Member{"fired"}, fired);
  }
};

/// What has become of a [[nucleation]].
struct NucleationState {
  std::int64_t made = 0;                                      ///< cracks
  double next = 0;                                            ///< when stress is looked at, s
  double highest = -std::numeric_limits<double>::infinity();  ///< largest principal stress of a particle, at looks so far, Pa
  bool at_mirror = false;                                     ///< stress has passed the strength too near to a symmetry plane

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [made, next, highest, at_mirror] = self;
    visit(Member{"made"}, made);
    visit(Member{"next", "s"}, next);
    visit(Member{"highest", "Pa"}, highest);
    visit(Member{"at_mirror"}, at_mirror);
  }
};

struct Fracture {
  std::vector<CrackTip> tips;
  double next = 0;         ///< when parameters are due, s
  double energy = 0;       ///< taken by faces that part as tips grow, J
  double energy_by_J = 0;  ///< J times the area by which tips have grown, J
  std::vector<NucleationState> nucleations;

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [tips, next, energy, energy_by_J, nucleations] = self;
    visit(Member{"energy", "J"}, energy);
    visit(Member{"energy_by_J", "J"}, energy_by_J);
    visit(Member{"tips"}, tips);
    visit(Member{"next", "s"}, next);
    visit(Member{"nucleations"}, nucleations);
  }
};

}  // namespace crampon
