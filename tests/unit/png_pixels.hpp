#pragma once
/// Pixels of pictures, for tests of what is drawn.

#include <png.h>

#include <array>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "crampon/picture/palette.hpp"

namespace crampon::test {

/// A PNG as 8-bit RGB.
struct Pixels {
  explicit Pixels(const fs::path& path) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_file(&image, path.c_str()) == 0) throw std::runtime_error(image.message);
    image.format = PNG_FORMAT_RGB;
    bytes.resize(PNG_IMAGE_SIZE(image));
    width = static_cast<int>(image.width);
    height = static_cast<int>(image.height);
    png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr);
  }
  std::array<int, 3> at(double x, double y) const {
    const std::size_t i = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    return {bytes.at(i), bytes.at(i + 1), bytes.at(i + 2)};
  }
  std::vector<unsigned char> bytes;
  int width = 0, height = 0;
};

/// One step of eight bits: cairo and the test may round a half either way.
inline void expect_colour(const std::array<int, 3>& seen, const Colour& wanted, const std::string& what) {
  EXPECT_NEAR(seen[0], 255 * wanted.red, 1) << what << " red";
  EXPECT_NEAR(seen[1], 255 * wanted.green, 1) << what << " green";
  EXPECT_NEAR(seen[2], 255 * wanted.blue, 1) << what << " blue";
}

}  // namespace crampon::test
