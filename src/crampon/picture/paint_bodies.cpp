#include "crampon/picture/paint_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace crampon {
namespace {

using Point = std::array<double, 2>;

constexpr Colour outline{0.28, 0.28, 0.3}, hatching{0.6, 0.6, 0.62};
// Layers are painted without antialiasing, where neighbouring edges would show as seams, but at twice the size, so that outlines come out
// smooth.
constexpr int finer = 2;

// A layer over a plot area, and its pixels.
class Layer {
 public:
  explicit Layer(const PictureMap::Panel& panel)
      : panel_(panel),
        canvas_(finer * static_cast<int>(panel.width), finer * static_cast<int>(panel.height)),
        raster_{canvas_.width(), canvas_.height(), panel.x_lowest, panel.y_highest, 1 / (panel.scale * finer)} {
    cairo_scale(canvas_.context(), finer, finer);
    cairo_translate(canvas_.context(), -panel.left, -panel.top);
    cairo_set_antialias(canvas_.context(), CAIRO_ANTIALIAS_NONE);
  }
  Canvas& canvas() { return canvas_; }
  int width() const { return canvas_.width(); }
  int height() const { return canvas_.height(); }
  const Raster& raster() const { return raster_; }
  std::size_t index(int i, int j) const { return raster_.index(i, j); }

  /// Fills the parallelogram, grown by some pixels.
  void fill(const ParticleShape& s, double grown) {
    const double half_a = std::hypot(s.a[0], s.a[1]) * panel_.scale, half_b = std::hypot(s.b[0], s.b[1]) * panel_.scale;
    const double fa = half_a > 0 ? panel_.scale * (1 + grown / half_a) : 0, fb = half_b > 0 ? panel_.scale * (1 + grown / half_b) : 0;
    const Point centre = panel_.pixel(s.centre[0], s.centre[1]);
    static constexpr double corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    cairo_t* c = canvas_.context();
    for (const auto& [i, j] : corners)
      cairo_line_to(c, centre[0] + i * fa * s.a[0] + j * fb * s.b[0], centre[1] - i * fa * s.a[1] - j * fb * s.b[1]);
    cairo_close_path(c);
    cairo_fill(c);
  }
  /// Where chosen, in hatched colour.
  void fill_hatched(const std::vector<bool>& chosen, const Colour& colour, int apart) {
    set_pixels([&](int i, int j) -> const Colour* {
      if (!chosen[index(i, j)]) return nullptr;
      return (i + j) % apart < apart / 4 ? &hatching : &colour;
    });
  }
  /// A line between pixels of different kinds; bordering(a, b): is there one between the kinds of neighbours?
  template <class Kind, class F>
  void outline_borders(Kind kind, F bordering) {
    std::vector<bool> line(index(0, height()), false);
    constexpr int reach = finer;  // pixels on either side
    const auto mark = [&](int i, int j) {
      if (i >= 0 && i < width() && j >= 0 && j < height()) line[index(i, j)] = true;
    };
    for (int j = 0; j < height(); ++j) {
      for (int i = 0; i < width(); ++i) {
        const auto here = kind(i, j);
        if (i + 1 < width() && bordering(here, kind(i + 1, j)))
          for (int k = 1 - reach; k <= reach; ++k) mark(i + k, j);
        if (j + 1 < height() && bordering(here, kind(i, j + 1)))
          for (int k = 1 - reach; k <= reach; ++k) mark(i, j + k);
      }
    }
    set_pixels([&](int i, int j) { return line[index(i, j)] ? &outline : nullptr; });
  }
  void outline_covered(const std::vector<bool>& covered) {
    outline_borders([&](int i, int j) { return static_cast<bool>(covered[index(i, j)]); }, [](bool a, bool b) { return a != b; });
  }
  std::vector<std::uint32_t> pixels() {
    cairo_surface_flush(canvas_.surface());
    const unsigned char* data = cairo_image_surface_get_data(canvas_.surface());
    const int stride = cairo_image_surface_get_stride(canvas_.surface());
    std::vector<std::uint32_t> out(index(0, height()));
    for (int j = 0; j < height(); ++j)
      std::memcpy(&out[index(0, j)], data + j * stride, sizeof(std::uint32_t) * static_cast<std::size_t>(width()));
    return out;
  }
  /// Paints a colour where chosen(i, j) says so, of the pixels.
  template <class F>
  void set_pixels(F chosen) {
    cairo_surface_flush(canvas_.surface());
    unsigned char* data = cairo_image_surface_get_data(canvas_.surface());
    const int stride = cairo_image_surface_get_stride(canvas_.surface());
    for (int j = 0; j < height(); ++j) {
      for (int i = 0; i < width(); ++i) {
        if (const Colour* colour = chosen(i, j)) {
          const auto byte = [](double v) { return static_cast<std::uint32_t>(std::lround(255 * v)); };
          const std::uint32_t pixel = byte(colour->red) << 16U | byte(colour->green) << 8U | byte(colour->blue);
          std::memcpy(data + j * stride + 4 * i, &pixel, 4);
        }
      }
    }
    cairo_surface_mark_dirty(canvas_.surface());
  }
  void paint_onto(Canvas& canvas) {
    cairo_surface_flush(canvas_.surface());
    cairo_t* to = canvas.context();
    cairo_save(to);
    cairo_translate(to, panel_.left, panel_.top);
    cairo_scale(to, 1. / finer, 1. / finer);
    cairo_set_source_surface(to, canvas_.surface(), 0, 0);
    cairo_pattern_set_filter(cairo_get_source(to), CAIRO_FILTER_GOOD);
    cairo_paint(to);
    cairo_restore(to);
  }

 private:
  const PictureMap::Panel& panel_;
  Canvas canvas_;
  Raster raster_;
};

constexpr std::uint32_t nothing = 0xffffff;

// How far particles are grown, px: by the first neighbours leave no seam; the second is their outline, a whole number of layer pixels wider,
// which gives it one width.
constexpr double closing = 0.3, outlining = 1.8;

// Which particle each pixel shows, as an index into the scene's shapes; `nothing` where none, nor an outline.
std::vector<std::uint32_t> shown_particles(const Scene& scene, const PictureMap::Panel& panel) {
  Layer numbers(panel);  // white: nothing
  for (const double grown : {outlining, closing}) {
    for (std::size_t k = 0; k < std::min<std::size_t>(scene.shapes.size(), nothing); ++k) {
      numbers.canvas().set_colour({(k >> 16U & 255U) / 255., (k >> 8U & 255U) / 255., (k & 255U) / 255.});
      numbers.fill(scene.shapes[k], grown);
    }
  }
  std::vector<std::uint32_t> shown = numbers.pixels();
  for (std::uint32_t& k : shown) k &= 0xffffffU;
  return shown;
}

bool has_several_bodies(const Scene& scene) {
  return std::any_of(scene.shapes.begin(), scene.shapes.end(), [&](const ParticleShape& s) {
    return !scene.body.empty() && scene.body[s.index] != scene.body[scene.shapes[0].index];
  });
}

// Solid rigid bodies in space, where they stand before the particles and each other.
void paint_solids(Layer& layer, const Scene& scene, const std::vector<std::uint32_t>& shown, const Categories& categories, int apart) {
  std::vector<double> top(shown.size(), -INFINITY);
  for (std::size_t i = 0; i < shown.size(); ++i)
    if (shown[i] != nothing) top[i] = scene.height[scene.shapes[shown[i]].index];
  for (const Scene::Rigid& rigid : scene.rigid) {
    if (rigid.view.is_section()) continue;
    std::vector<bool> visible = covered_pixels(rigid.view, layer.raster());
    for (int j = 0; j < layer.height(); ++j) {
      for (int i = 0; i < layer.width(); ++i) {
        const std::size_t at = layer.index(i, j);
        if (!visible[at]) continue;
        const double z = rigid.view.top(layer.raster().x(i), layer.raster().y(j));
        visible[at] = z > top[at];
        if (visible[at]) top[at] = z;
      }
    }
    layer.fill_hatched(visible, categories.of_rigid(*rigid.shape), apart);
    layer.outline_covered(visible);
  }
}

}  // namespace

void hatch(Canvas& canvas, const PixelBox& box, double apart) {
  cairo_t* c = canvas.context();
  cairo_save(c);
  cairo_rectangle(c, box.left, box.top, box.width, box.height);
  cairo_clip(c);
  canvas.set_colour(hatching);
  for (double x = box.left - box.height; x < box.right(); x += apart) canvas.line(x, box.bottom(), x + box.height, box.top, 0.25 * apart);
  cairo_restore(c);
}

void paint_bodies(Canvas& canvas, const Scene& scene, const PictureMap& map, const Categories& categories, const PictureMap::Panel& panel) {
  Layer layer(panel);
  const auto colour_of = [&](double value) { return categories.empty() ? map.colour(value) : categories.colour(value); };

  std::vector<std::vector<bool>> sections;
  const int apart = finer * std::max(6, static_cast<int>(std::lround(map.width / 150.)));
  for (const Scene::Rigid& rigid : scene.rigid) {
    if (!rigid.view.is_section()) continue;
    sections.push_back(covered_pixels(rigid.view, layer.raster()));
    layer.fill_hatched(sections.back(), categories.of_rigid(*rigid.shape), apart);
  }
  layer.canvas().set_colour(outline);
  for (const ParticleShape& s : scene.shapes) layer.fill(s, outlining);
  for (const ParticleShape& s : scene.shapes) {
    layer.canvas().set_colour(colour_of(scene.values[s.index]));
    layer.fill(s, closing);
  }
  const bool solids = std::any_of(scene.rigid.begin(), scene.rigid.end(), [](const Scene::Rigid& r) { return !r.view.is_section(); });
  if (solids || has_several_bodies(scene)) {
    const std::vector<std::uint32_t> shown = shown_particles(scene, panel);
    const auto body_of = [&](std::uint32_t k) { return scene.body.empty() ? 0 : scene.body[scene.shapes[k].index]; };
    layer.outline_borders(
        [&](int i, int j) { return shown[layer.index(i, j)]; },
        [&](std::uint32_t a, std::uint32_t b) { return a != b && a != nothing && b != nothing && body_of(a) != body_of(b); });
    if (solids) paint_solids(layer, scene, shown, categories, apart);
  }
  for (const std::vector<bool>& section : sections) layer.outline_covered(section);
  layer.paint_onto(canvas);
}

}  // namespace crampon
