#pragma once
/// A picture in memory (cairo), with text that knows its size. For the drawing files of this room only.

#include <cairo.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "crampon/output/palette.hpp"

namespace crampon {

/// Where a text's anchor lies in its box.
enum class AlignX { left, centre, right };
enum class AlignY { top, middle, bottom };

struct Box {
  double left = 0, top = 0, width = 0, height = 0;  ///< px
  double right() const { return left + width; }
  double bottom() const { return top + height; }
};

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
  void fill_box(const Box& box);
  void stroke_box(const Box& box, double width);
  void text(double x, double y, const std::string& text, double size, AlignX align_x, AlignY align_y);
  /// Reads upwards; (x, y) is the middle of the text.
  void text_upwards(double x, double y, const std::string& text, double size);
  double text_width(const std::string& text, double size) const;

  /// Writes a PNG. Throws std::runtime_error "path: reason".
  void save(const std::filesystem::path& path) const;

 private:
  struct Free {
    void operator()(cairo_t* c) const { cairo_destroy(c); }
    void operator()(cairo_surface_t* s) const { cairo_surface_destroy(s); }
  };
  void set_font(double size) const;

  std::unique_ptr<cairo_surface_t, Free> surface_;
  std::unique_ptr<cairo_t, Free> context_;
};

/// Widest of several texts, px.
double widest(const Canvas& canvas, const std::vector<std::string>& texts, double size);

}  // namespace crampon
