#include "crampon/output/numbers.hpp"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace crampon {
namespace {

// f<T>() for a type of files.
template <class F>
auto with_type(NumberType type, F f) {
  switch (type) {
    case NumberType::float32:
      return f.template operator()<float>();
    case NumberType::float64:
      return f.template operator()<double>();
    case NumberType::int32:
      return f.template operator()<std::int32_t>();
    case NumberType::int64:
      break;
  }
  return f.template operator()<std::int64_t>();
}

}  // namespace

Numbers::Numbers(NumberType type, std::size_t rows, int shown, int kept)
    : type_(type), rows_(rows), shown_(static_cast<std::size_t>(shown)), kept_(static_cast<std::size_t>(kept)), stride_(kept_) {
  with_type(type, [&]<class T>() { data_ = std::vector<T>(rows * kept_); });
}

Numbers::Numbers(NumberType type, std::span<const char> bytes) : type_(type) {
  with_type(type, [&]<class T>() {
    std::vector<T> values(bytes.size() / sizeof(T));
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    rows_ = values.size();
    data_ = std::move(values);
  });
}

Numbers Numbers::repeated(NumberType type, std::size_t rows, const std::vector<double>& row) {
  const int length = static_cast<int>(row.size());
  Numbers out(type, 1, length, length);
  out.set_row(0, row.data());
  out.rows_ = rows;
  out.stride_ = 0;
  return out;
}

double Numbers::operator[](std::size_t i) const {
  double value = 0;
  copy(i, 1, &value);
  return value;
}

template <class T, class To>
void Numbers::fill(const std::vector<T>& kept, std::size_t first, std::size_t count, To* to) const {
  if (shown_ == stride_) {
    std::transform(kept.data() + first, kept.data() + first + count, to, [](T v) { return static_cast<To>(v); });
    return;
  }
  std::size_t at = first / shown_ * stride_, column = first % shown_;
  for (std::size_t i = 0; i < count; ++i) {
    to[i] = column < kept_ ? static_cast<To>(kept[at + column]) : To{0};
    if (++column == shown_) at += stride_, column = 0;
  }
}

void Numbers::copy(std::size_t first, std::size_t count, double* to) const {
  std::visit([&](const auto& kept) { fill(kept, first, count, to); }, data_);
}

std::vector<double> Numbers::doubles() const {
  std::vector<double> out(size());
  copy(0, out.size(), out.data());
  return out;
}

void Numbers::set_row(std::size_t row, const double* values) {
  std::visit(
      [&]<class T>(std::vector<T>& kept) {
        std::transform(values, values + kept_, kept.data() + row * stride_, [](double v) { return static_cast<T>(v); });
      },
      data_);
}

void Numbers::push_back(double value) {
  std::visit([&]<class T>(std::vector<T>& kept) { kept.push_back(static_cast<T>(value)); }, data_);
  ++rows_;
}

Numbers Numbers::as(NumberType type) && {
  if (type != type_) {
    with_type(type,
              [&]<class T>() { data_ = std::visit([](const auto& kept) { return std::vector<T>(kept.begin(), kept.end()); }, data_); });
    type_ = type;
  }
  return std::move(*this);
}

std::size_t Numbers::bytes() const {
  return size() * with_type(type_, []<class T>() { return sizeof(T); });
}

std::span<const char> Numbers::block(std::size_t from, std::size_t count, std::vector<char>& room) const {
  return std::visit(
      [&]<class T>(const std::vector<T>& kept) {
        return with_type(type_, [&]<class To>() -> std::span<const char> {
          if (std::is_same_v<T, To> && shown_ == stride_) return {reinterpret_cast<const char*>(kept.data()) + from, count};
          room.resize(count);
          fill(kept, from / sizeof(To), count / sizeof(To), reinterpret_cast<To*>(room.data()));
          return room;
        });
      },
      data_);
}

}  // namespace crampon
