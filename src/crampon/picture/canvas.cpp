#include "crampon/picture/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "crampon/output/file.hpp"
#include "crampon/output/picture_mark.hpp"

namespace crampon {
namespace {

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) throw std::runtime_error(fmt::format("cannot draw: {}", cairo_status_to_string(status)));
}

cairo_status_t append_bytes(void* closure, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

Canvas::Canvas(int width, int height)
    : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)), context_(cairo_create(surface_.get())) {
  check(cairo_surface_status(surface()));
  check(cairo_status(context()));
  set_colour({1, 1, 1});
  cairo_paint(context());
}

void Canvas::line(double x0, double y0, double x1, double y1, double width) {
  cairo_set_line_width(context(), width);
  cairo_move_to(context(), x0, y0);
  cairo_line_to(context(), x1, y1);
  cairo_stroke(context());
}

void Canvas::fill_box(const PixelBox& box) {
  cairo_rectangle(context(), box.left, box.top, box.width, box.height);
  cairo_fill(context());
}

void Canvas::stroke_box(const PixelBox& box, double width) {
  cairo_set_line_width(context(), width);
  cairo_rectangle(context(), box.left, box.top, box.width, box.height);
  cairo_stroke(context());
}

void Canvas::set_font(double size) const {
  cairo_select_font_face(context(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context(), size);
}

void Canvas::text(double x, double y, const std::string& text, double size, AlignX align_x, AlignY align_y) {
  set_font(size);
  cairo_font_extents_t font;
  cairo_font_extents(context(), &font);
  const double width = text_width(text, size);
  if (align_x == AlignX::centre) x -= width / 2;
  if (align_x == AlignX::right) x -= width;
  // The height of digits, not the line's: numbers stand level with their ticks.
  const double digits = 0.73 * size;
  if (align_y == AlignY::top) y += font.ascent;
  if (align_y == AlignY::middle) y += digits / 2;
  if (align_y == AlignY::bottom) y -= font.descent;
  cairo_move_to(context(), x, y);
  cairo_show_text(context(), text.c_str());
  remember(text, x, y);
}

void Canvas::remember(const std::string& text, double x, double y) {
  if (text.empty()) return;
  cairo_text_extents_t ink;
  cairo_text_extents(context(), text.c_str(), &ink);
  double x0 = x + ink.x_bearing, y0 = y + ink.y_bearing, x1 = x0 + ink.width, y1 = y0 + ink.height;
  cairo_user_to_device(context(), &x0, &y0);  // as it may be turned by a right angle
  cairo_user_to_device(context(), &x1, &y1);
  texts_.push_back({text, {std::min(x0, x1), std::min(y0, y1), std::abs(x1 - x0), std::abs(y1 - y0)}});
}

void Canvas::text_upwards(double x, double y, const std::string& label, double size) {
  cairo_save(context());
  cairo_translate(context(), x, y);
  cairo_rotate(context(), -std::numbers::pi / 2);
  text(0, 0, label, size, AlignX::centre, AlignY::middle);
  cairo_restore(context());
}

void Canvas::text_over(double x, double y, const std::string& text, double size) {
  x -= text_width(text, size) / 2;
  y += 0.73 * size / 2;  // the height of digits, as in text()
  cairo_move_to(context(), x, y);
  cairo_text_path(context(), text.c_str());
  set_colour({1, 1, 1});
  cairo_set_line_width(context(), 0.28 * size);
  cairo_set_line_join(context(), CAIRO_LINE_JOIN_ROUND);
  cairo_stroke_preserve(context());
  set_colour({0, 0, 0});
  cairo_fill(context());
  remember(text, x, y);
}

double Canvas::text_width(const std::string& text, double size) const {
  set_font(size);
  cairo_text_extents_t extents;
  cairo_text_extents(context(), text.c_str(), &extents);
  return extents.x_advance;
}

double Canvas::fitting_size(const std::string& text, double size, double room) const {
  return std::min(size, size * room / std::max(1., text_width(text, size)));
}

std::string Canvas::shortened(std::string text, double size, double room) const {
  if (text_width(text, size) <= room) return text;
  while (!text.empty() && text_width(text + "…", size) > room) {
    // A character of UTF-8: the bytes after its first one begin with the bits 10.
    while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xc0U) == 0x80U) text.pop_back();
    if (!text.empty()) text.pop_back();
  }
  return text + "…";
}

void Canvas::save(const std::filesystem::path& path) const {
  check(cairo_status(context()));
  cairo_surface_flush(surface());
  std::string png;
  check(cairo_surface_write_to_png_stream(surface(), append_bytes, &png));
  mark_picture(png);
  write_file(path, png);
}

LabelFont label_font(const Canvas& canvas, double size) {
  return {[&canvas, size](const std::string& label) { return canvas.text_width(label, size); }, size};
}

double widest(const Canvas& canvas, const std::vector<std::string>& texts, double size) {
  double most = 0;
  for (const std::string& text : texts) most = std::max(most, canvas.text_width(text, size));
  return most;
}

}  // namespace crampon
