#pragma once
/// A picture in memory (cairo), with text that knows its size. For the drawing files of this room only.

#include <cairo.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "crampon/picture/axis.hpp"
#include "crampon/picture/box.hpp"
#include "crampon/picture/palette.hpp"

namespace crampon {

/// Where a text's anchor lies in its box.
enum class AlignX { left, centre, right };
enum class AlignY { top, middle, bottom };

class Canvas {
 public:
  /// White. Throws std::runtime_error when cairo cannot make one of that size.
  Canvas(int width, int height);

  cairo_t* context() const { return context_.get(); }
  cairo_surface_t* surface() const { return surface_.get(); }
  int width() const { return cairo_image_surface_get_width(surface_.get()); }
  int height() const { return cairo_image_surface_get_height(surface_.get()); }

  void set_colour(const Colour& colour) { cairo_set_source_rgb(context(), colour.red, colour.green, colour.blue); }
  void line(double x0, double y0, double x1, double y1, double width);
  void fill_box(const PixelBox& box);
  void stroke_box(const PixelBox& box, double width);
  void text(double x, double y, const std::string& text, double size, AlignX align_x, AlignY align_y);
  /// Reads upwards; (x, y) is the middle of the text.
  void text_upwards(double x, double y, const std::string& text, double size);
  /// Black with a white rim, so that it can be read over any colour; (x, y) is the middle of the text.
  void text_over(double x, double y, const std::string& text, double size);
  double text_width(const std::string& text, double size) const;
  /// The size, or a smaller one at which the text is no longer than `room`.
  double fitting_size(const std::string& text, double size, double room) const;
  /// The text, or its beginning with "…", no longer than `room`.
  std::string shortened(std::string text, double size, double room) const;
  /// All texts so far.
  const std::vector<DrawnText>& texts() const { return texts_; }

  /// Writes a PNG. Throws std::runtime_error "path: reason".
  void save(const std::filesystem::path& path) const;

 private:
  struct Free {
    void operator()(cairo_t* c) const { cairo_destroy(c); }
    void operator()(cairo_surface_t* s) const { cairo_surface_destroy(s); }
  };
  void set_font(double size) const;
  void remember(const std::string& text, double x, double y);

  std::unique_ptr<cairo_surface_t, Free> surface_;
  std::unique_ptr<cairo_t, Free> context_;
  std::vector<DrawnText> texts_;
};

/// Labels of this size.
LabelFont label_font(const Canvas& canvas, double size);

/// Widest of several texts, px.
double widest(const Canvas& canvas, const std::vector<std::string>& texts, double size);

}  // namespace crampon
