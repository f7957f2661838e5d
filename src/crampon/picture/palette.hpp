#pragma once
/// Colours for numbers.

#include <cstddef>
#include <vector>

namespace crampon {

/// sRGB, 0 to 1.
struct Colour {
  double red = 0, green = 0, blue = 0;
};

/// Of rigid bodies and walls, under their hatching.
inline constexpr Colour rigid_colour{0.8, 0.8, 0.81};

/// Of what has grown of a crack. Dark enough to be told from white, and far from all colours of the palettes.
inline constexpr Colour grown_colour{0.86, 0.05, 0.27};

enum class Palette {
  uniform,    ///< dark violet over teal to yellow: equal steps look equal, lightness rises throughout, safe for colour-blind eyes
  grey,       ///< black to white, as N03's figures
  diverging,  ///< blue over near-white to orange, for ranges symmetric about zero
};

/// Colour at t in [0, 1] (clamped). NaN is magenta.
Colour palette_colour(Palette palette, double t);

/// Colours for categories, told apart as well as their number allows: the first eight by all common kinds of colour vision.
Colour category_colour(std::size_t k);

/// Coordinates of a colour in the OKLab space (B. Ottosson, 2020), where distances match seen differences.
struct OkLab {
  double lightness = 0, a = 0, b = 0;
};
Colour srgb_from_oklab(const OkLab& lab);
OkLab oklab_from_srgb(const Colour& colour);

/// Colours for curves, told apart by all common kinds of colour vision (Okabe and Ito, 2008), black first.
const std::vector<Colour>& curve_colours();

}  // namespace crampon
