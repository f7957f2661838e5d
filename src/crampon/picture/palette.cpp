#include "crampon/picture/palette.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace crampon {
namespace {

constexpr int table_size = 512;
using Table = std::array<Colour, table_size + 1>;

double to_gamma(double linear) {
  linear = std::clamp(linear, 0., 1.);
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double from_gamma(double encoded) { return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4); }

OkLab polar(double lightness, double chroma, double degrees) {
  const double hue = degrees * std::numbers::pi / 180;
  return {lightness, chroma * std::cos(hue), chroma * std::sin(hue)};
}

// Lightness rises linearly while the hue turns from violet (300 deg) over teal to yellow (105 deg); the chroma is lowest at teal,
// where the sRGB gamut is narrowest.
OkLab uniform_path(double t) {
  const double chroma = 0.09 + 0.035 * (2 * t - 1) * (2 * t - 1) + 0.04 * std::pow(t, 4);
  return polar(0.24 + 0.68 * t, chroma, 300 - 195 * t);
}

OkLab diverging_path(double t) {
  const double s = std::abs(2 * t - 1);
  return polar(0.96 - 0.46 * s, 0.235 * s * (1 - 0.45 * s), t < 0.5 ? 255 : 50);
}

double distance(const OkLab& a, const OkLab& b) { return std::hypot(a.lightness - b.lightness, a.a - b.a, a.b - b.b); }

// Samples a path at equal arc lengths, which makes equal steps of t look equal.
template <class Path>
Table equal_steps(Path path) {
  constexpr int fine = 20 * table_size;
  std::vector<double> length(fine + 1, 0.);
  for (int i = 1; i <= fine; ++i)
    length[static_cast<std::size_t>(i)] = length[static_cast<std::size_t>(i - 1)] + distance(path((i - 1.) / fine), path(double(i) / fine));
  Table table;
  for (std::size_t k = 0; k < table.size(); ++k) {
    const double wanted = length.back() * static_cast<double>(k) / table_size;
    const auto next = std::lower_bound(length.begin() + 1, length.end() - 1, wanted);
    const double w = (wanted - *(next - 1)) / (*next - *(next - 1));
    table[k] = srgb_from_oklab(path((static_cast<double>(next - length.begin()) - 1 + w) / fine));
  }
  return table;
}

}  // namespace

Colour srgb_from_oklab(const OkLab& lab) {
  const double l = std::pow(lab.lightness + 0.3963377774 * lab.a + 0.2158037573 * lab.b, 3);
  const double m = std::pow(lab.lightness - 0.1055613458 * lab.a - 0.0638541728 * lab.b, 3);
  const double s = std::pow(lab.lightness - 0.0894841775 * lab.a - 1.2914855480 * lab.b, 3);
  return {to_gamma(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          to_gamma(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          to_gamma(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

OkLab oklab_from_srgb(const Colour& colour) {
  const double r = from_gamma(colour.red), g = from_gamma(colour.green), b = from_gamma(colour.blue);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s, 1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

Colour palette_colour(Palette palette, double t) {
  if (std::isnan(t)) return {1, 0, 1};
  t = std::clamp(t, 0., 1.);
  if (palette == Palette::grey) return {t, t, t};
  static const Table uniform = equal_steps(uniform_path), diverging = equal_steps(diverging_path);
  return (palette == Palette::uniform ? uniform : diverging)[static_cast<std::size_t>(std::lround(t * table_size))];
}

Colour category_colour(std::size_t k) {
  // Okabe and Ito (2008) without black, which is for lines; a light one beside a dark one.
  static const std::vector<Colour> first{{0.337, 0.706, 0.914}, {0.902, 0.624, 0}, {0, 0.62, 0.451},    {0.941, 0.894, 0.259},
                                         {0, 0.447, 0.698},     {0.835, 0.369, 0}, {0.8, 0.475, 0.655}, {0.75, 0.86, 0.75}};
  if (k < first.size()) return first[k];
  // Hues by the golden angle never come round to the same; three lightnesses part neighbours in hue.
  const std::size_t beyond = k - first.size();
  static constexpr std::array<double, 3> lightness{0.5, 0.4, 0.88};
  return srgb_from_oklab(polar(lightness[beyond % 3], 0.12, 318 + 137.50776 * static_cast<double>(beyond)));
}

const std::vector<Colour>& curve_colours() {
  static const std::vector<Colour> colours{{0, 0, 0},           {0, 0.447, 0.698}, {0.835, 0.369, 0},    {0, 0.62, 0.451},
                                           {0.8, 0.475, 0.655}, {0.902, 0.624, 0}, {0.337, 0.706, 0.914}};
  return colours;
}

}  // namespace crampon
