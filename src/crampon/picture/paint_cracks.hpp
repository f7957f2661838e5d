#pragma once
/// Cracks and their tips in the plot area of a picture. For the drawing files of this room only.

#include "crampon/picture/canvas.hpp"
#include "crampon/picture/layout.hpp"
#include "crampon/picture/scene.hpp"

namespace crampon {

/// Cracks by their two surfaces with the gap between them in white, what has grown since the start in a colour of its own; a mark at each tip, with its
/// name beside it where the options ask for that and there is room.
void paint_cracks(Canvas& canvas, const Scene& scene, const PictureMap::Panel& panel, const TextSizes& sizes, const DrawOptions& options);

/// A line under the plots that says what the colours and marks of cracks mean; nothing where the extent has no growth and no tip.
void paint_key(Canvas& canvas, const PictureLayout& layout, const PictureExtent& extent);

}  // namespace crampon
