#pragma once
/// Boxes in a picture, and the texts that were painted into it.

#include <string>

namespace crampon {

/// px from the picture's top left corner.
struct PixelBox {
  double left = 0, top = 0, width = 0, height = 0;
  double right() const { return left + width; }
  double bottom() const { return top + height; }
  bool overlaps(const PixelBox& other) const {
    return left < other.right() && other.left < right() && top < other.bottom() && other.top < bottom();
  }
};

struct DrawnText {
  std::string text;
  PixelBox box;  ///< of its ink
};

}  // namespace crampon
