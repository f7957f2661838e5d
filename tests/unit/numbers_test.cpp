// However an array of numbers is kept in memory, it reads the same and becomes the same file.

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "crampon/output/file.hpp"
#include "crampon/output/vtp.hpp"
#include "output_cases.hpp"

namespace crampon {
namespace {

constexpr NumberType all_types[] = {NumberType::float32, NumberType::float64, NumberType::int32, NumberType::int64};

std::string bytes_of(const Numbers& numbers, std::size_t block) {
  std::string out;
  std::vector<char> room;
  for (std::size_t from = 0; from < numbers.bytes(); from += block) {
    const auto part = numbers.block(from, std::min(block, numbers.bytes() - from), room);
    out.append(part.data(), part.size());
  }
  return out;
}

TEST(Numbers, AreRoundedToTheirTypeAndBack) {
  const std::vector<double> given{0.1, -2.5, 16777217, 0};
  EXPECT_EQ(Numbers(given).doubles(), given);
  EXPECT_EQ(Numbers(given).as(NumberType::float32).doubles(), (std::vector<double>{0.1f, -2.5, 16777216, 0}));
  for (const NumberType type : {NumberType::int32, NumberType::int64})
    EXPECT_EQ(Numbers(given).as(type).doubles(), (std::vector<double>{0, -2, 16777217, 0}));
  Numbers whole(NumberType::int64);
  for (const double v : {9e15, -9e15}) whole.push_back(v);
  EXPECT_EQ(whole.doubles(), (std::vector<double>{9e15, -9e15}));
}

TEST(Numbers, ComeBackFromTheirBytes) {
  for (const NumberType type : all_types) {
    const Numbers given = Numbers{1, 2, -3, 5, 8}.as(type);
    const std::string bytes = bytes_of(given, 8);
    EXPECT_EQ(bytes.size(), given.bytes());
    EXPECT_EQ(Numbers(type, bytes), given);
    EXPECT_EQ(Numbers(type, std::string_view(bytes).substr(0, bytes.size() - 1)).size(), 4u) << "the number cut off is left out";
  }
}

// Rows that end in zeros, rows all the same and labels, beside the plain list of the same numbers.
TEST(Numbers, KeptInLessMemoryAreTheSame) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-100, 100);
  constexpr std::size_t rows = 37;
  for (const NumberType type : all_types) {
    for (const auto& [shown, kept] : {std::pair{3, 2}, {6, 4}, {3, 3}, {1, 1}}) {
      Numbers numbers(type, rows, shown, kept);
      EXPECT_EQ(numbers.doubles(), std::vector<double>(rows * static_cast<std::size_t>(shown)));
      std::vector<double> plain;
      for (std::size_t i = 0; i < rows; ++i) {
        std::vector<double> row(static_cast<std::size_t>(shown));
        for (int k = 0; k < kept; ++k) row[static_cast<std::size_t>(k)] = uniform(random);
        numbers.set_row(i, row.data());
        plain.insert(plain.end(), row.begin(), row.end());
      }
      const Numbers expected = Numbers(plain).as(type);
      EXPECT_EQ(numbers.doubles(), expected.doubles());
      for (const std::size_t i : {0u, 1u, 2u, 3u, 17u, 36u}) EXPECT_EQ(numbers[i], expected[i]);
      for (const std::size_t block : {8u, 16u, 40u, 4096u}) EXPECT_EQ(bytes_of(numbers, block), bytes_of(expected, block));
    }
    const Numbers same = Numbers::repeated(type, rows, {1, 2, 0}), expected = Numbers(same.doubles()).as(type);
    EXPECT_EQ(same.size(), 3 * rows);
    EXPECT_EQ(same[3 * rows - 2], 2);
    EXPECT_EQ(bytes_of(same, 16), bytes_of(expected, 16));
  }
  Numbers labels = Numbers::labels<std::uint16_t>(3);
  labels.set(1, 65535);
  EXPECT_EQ(labels.type(), NumberType::int64);
  EXPECT_EQ(bytes_of(labels, 8), bytes_of(Numbers{0, 65535, 0}.as(NumberType::int64), 8));
}

TEST_F(Output, FramesKeptInLessMemoryMakeTheSameFile) {
  constexpr std::size_t n = 70000;  // several compression blocks an array, which end within a row
  for (const Precision precision : {Precision::single, Precision::full}) {
    PointFrame frame;
    frame.positions = Numbers(real_type(precision), n, 3, 2);
    frame.particle_size = Numbers::repeated(real_type(precision), n, {0.1, 0.2, 0});
    frame.fields = {{"id", "1", 1, Numbers::labels<std::uint32_t>(n)},
                    {"body", "1", 1, Numbers::labels<std::uint16_t>(n)},
                    {"stress", "Pa", 6, Numbers(real_type(precision), n, 6, 4)}};
    for (std::size_t i = 0; i < n; ++i) {
      const double x = static_cast<double>(i), values[4] = {std::sqrt(x), std::sin(x), 1 / (x + 1), -x};
      frame.positions.set_row(i, values);
      frame.fields[0].values.set(i, x);
      frame.fields[1].values.set(i, static_cast<double>(i % 3));
      frame.fields[2].values.set_row(i, values);
    }
    PointFrame plain = frame;
    for (Numbers* numbers : {&plain.positions, &plain.particle_size}) *numbers = numbers->doubles();
    for (DataArray& field : plain.fields) field.values = field.values.doubles();
    write_vtp(folder / "frame.vtp", frame, precision);
    write_vtp(folder / "plain.vtp", plain, precision);
    EXPECT_TRUE(read_file(folder / "frame.vtp") == read_file(folder / "plain.vtp"));
    const PointFrame read = read_vtp(folder / "frame.vtp");
    EXPECT_EQ(read.positions.doubles(), frame.positions.doubles());
    EXPECT_EQ(read.fields[2].values.type(), real_type(precision));
  }
}

}  // namespace
}  // namespace crampon
