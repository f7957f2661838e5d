#pragma once
/// Bodies in the plot area of a picture. For the drawing files of this room only.

#include "crampon/picture/canvas.hpp"
#include "crampon/picture/scene.hpp"

namespace crampon {

/// Particles in their colours with an outline about each body, also where two touch; rigid bodies and walls behind them, hatched,
/// their outlines before them.
void paint_bodies(Canvas& canvas, const Scene& scene, const PictureMap& map, const Categories& categories, const PictureMap::Panel& panel);

/// Parallel lines over a box that mark what is rigid.
void hatch(Canvas& canvas, const PixelBox& box, double apart);

}  // namespace crampon
