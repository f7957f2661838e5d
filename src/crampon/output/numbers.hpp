#pragma once
/// Arrays of numbers as frames hold them: of the type that files give them, so that a frame is written without a copy.

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace crampon {

enum class NumberType { float32, float64, int32, int64 };

/// How real numbers are stored: float32 (relative error up to 6e-8) or float64 (every bit).
enum class Precision { single, full };
constexpr NumberType real_type(Precision precision) { return precision == Precision::full ? NumberType::float64 : NumberType::float32; }

/// A list of numbers, read as doubles. Sampled frames, which a run keeps until they are on disk, take less memory than their file shows: rows
/// may end in zeros (z of vectors in the plane), be all the same (sizes of particles) or hold labels that need few bits.
/// Threads may set different rows at once.
class Numbers {
 public:
  /// Of type float64.
  Numbers() = default;
  Numbers(std::initializer_list<double> values) : Numbers(std::vector<double>(values)) {}
  Numbers(std::vector<double> values) : data_(std::move(values)), rows_(std::get<0>(data_).size()) {}
  explicit Numbers(NumberType type) : Numbers(type, 0, 1, 1) {}
  /// Zeros: `rows` times `shown` of them. Only the first `kept` (1 <= kept <= shown) of a row take memory and can be set.
  Numbers(NumberType type, std::size_t rows, int shown, int kept);
  /// From memory, as a file holds it; bytes that do not fill a number are left out.
  Numbers(NumberType type, std::span<const char> bytes);
  /// `rows` times the same row.
  static Numbers repeated(NumberType type, std::size_t rows, const std::vector<double>& row);
  /// Zeros of type int64 in the memory of T (std::uint16_t or std::uint32_t), which also bounds what they can be set to.
  template <class T>
  static Numbers labels(std::size_t rows) {
    Numbers out(NumberType::int64);
    out.data_ = std::vector<T>(rows);
    out.rows_ = rows;
    return out;
  }

  NumberType type() const { return type_; }
  std::size_t size() const { return rows_ * shown_; }
  bool empty() const { return rows_ == 0; }
  double operator[](std::size_t i) const;
  /// Numbers first, first + 1, ... `count` of them.
  void copy(std::size_t first, std::size_t count, double* to) const;
  std::vector<double> doubles() const;

  /// Puts the first of `values`, as many as are kept, into a row.
  void set_row(std::size_t row, const double* values);
  /// Only where a row is one number, like push_back.
  void set(std::size_t i, double value) { set_row(i, &value); }
  void push_back(double value);
  /// The same numbers as another type: cut to whole ones or rounded. What is of that type already is not copied.
  Numbers as(NumberType type) &&;

  /// Bytes in a file.
  std::size_t bytes() const;
  /// Bytes [from, from + count) of a file, whole numbers. They may lie in `room`, until it is next used.
  std::span<const char> block(std::size_t from, std::size_t count, std::vector<char>& room) const;

  /// Equal numbers stored alike.
  bool operator==(const Numbers&) const = default;

  class Iterator {
   public:
    Iterator(const Numbers& numbers, std::size_t at) : numbers_(&numbers), at_(at) {}
    double operator*() const { return (*numbers_)[at_]; }
    Iterator& operator++() { return ++at_, *this; }
    bool operator==(const Iterator&) const = default;

   private:
    const Numbers* numbers_;
    std::size_t at_;
  };
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size()}; }

 private:
  template <class T, class To>
  void fill(const std::vector<T>& kept, std::size_t first, std::size_t count, To* to) const;

  NumberType type_ = NumberType::float64;
  std::variant<std::vector<double>, std::vector<float>, std::vector<std::int32_t>, std::vector<std::int64_t>, std::vector<std::uint16_t>,
               std::vector<std::uint32_t>>
      data_;
  std::size_t rows_ = 0, shown_ = 1, kept_ = 1;
  std::size_t stride_ = 1;  // from row to row in data_: kept_, or 0 where all are the same
};

}  // namespace crampon
