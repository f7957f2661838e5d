#include "crampon/core/saved_state.hpp"

#include <fmt/format.h>

namespace crampon {

namespace {

/// A number as text that tells it from its neighbours.
std::string text_of(Scalar scalar, const std::byte* at) {
  const auto read = [&]<class T>(T value) {
    std::memcpy(&value, at, sizeof value);
    if constexpr (sizeof(T) == 1) return fmt::format("{}", static_cast<int>(value));
    return fmt::format("{}", value);
  };
  switch (scalar) {
    case Scalar::f64:
      return read(double{});
    case Scalar::i64:
      return read(std::int64_t{});
    case Scalar::u64:
      return read(std::uint64_t{});
    case Scalar::i32:
      return read(std::int32_t{});
    case Scalar::u32:
      return read(std::uint32_t{});
    case Scalar::i16:
      return read(std::int16_t{});
    case Scalar::u16:
      return read(std::uint16_t{});
    case Scalar::i8:
      return read(std::int8_t{});
    case Scalar::u8:
      return read(std::uint8_t{});
  }
  return "";
}

const char* name_of(Scalar scalar) {
  static constexpr const char* names[] = {"f64", "i64", "u64", "i32", "u32", "i16", "u16", "i8", "u8"};
  return names[static_cast<std::size_t>(scalar)];
}

}  // namespace

std::string StateDifference::text() const {
  return fmt::format("{}, row {}, component {}: {} and {}", name, row, component, before, after);
}

void SavedState::add(const std::string& name, const Member& member, const ArrayLayout& layout, const void* data) {
  if (!index_.emplace(name, arrays_.size()).second) throw std::logic_error("two members are named " + name);
  NamedArray& a = arrays_.emplace_back(NamedArray{name, member.unit, member.use, layout, {}});
  const auto* bytes = static_cast<const std::byte*>(data);
  if (layout.bytes() > 0) a.data.assign(bytes, bytes + layout.bytes());
}

const NamedArray* SavedState::find(const std::string& name) const {
  const auto at = index_.find(name);
  return at == index_.end() ? nullptr : &arrays_[at->second];
}

const NamedArray& SavedState::get(const std::string& name, Scalar scalar, std::size_t width) const {
  const NamedArray* a = find(name);
  if (!a) throw std::runtime_error(name + ": it was not kept");
  if (a->layout.scalar != scalar || a->layout.width != width) {
    throw std::runtime_error(fmt::format("{}: {} numbers {} a row were kept, not {} numbers {}", name, a->layout.width,
                                         name_of(a->layout.scalar), width, name_of(scalar)));
  }
  return *a;
}

std::size_t SavedState::bytes() const {
  std::size_t sum = 0;
  for (const NamedArray& a : arrays_) sum += a.data.size();
  return sum;
}

std::optional<StateDifference> first_difference(const SavedState& before, const SavedState& after) {
  for (const NamedArray& a : before.arrays()) {
    const NamedArray* b = after.find(a.name);
    if (!b) return StateDifference{a.name, 0, 0, "there", "missing"};
    const std::size_t size = size_of(a.layout.scalar), width = a.layout.width;
    if (b->layout.scalar != a.layout.scalar || b->layout.width != width) return StateDifference{a.name, 0, 0, "one kind", "another kind"};
    const std::size_t shared = std::min(a.data.size(), b->data.size());
    if (shared > 0 && std::memcmp(a.data.data(), b->data.data(), shared) != 0) {
      for (std::size_t i = 0; i < shared / size; ++i) {
        if (std::memcmp(&a.data[i * size], &b->data[i * size], size) == 0) continue;
        return StateDifference{a.name, i / width, i % width, text_of(a.layout.scalar, &a.data[i * size]),
                               text_of(a.layout.scalar, &b->data[i * size])};
      }
    }
    if (a.layout.rows != b->layout.rows) {
      return StateDifference{a.name, std::min(a.layout.rows, b->layout.rows), 0, fmt::format("{} rows", a.layout.rows),
                             fmt::format("{} rows", b->layout.rows)};
    }
  }
  for (const NamedArray& b : after.arrays()) {
    if (!before.find(b.name)) return StateDifference{b.name, 0, 0, "missing", "there"};
  }
  return std::nullopt;
}

void BitHash::add(const void* data, std::size_t bytes) {
  const auto* at = static_cast<const unsigned char*>(data);
  for (; bytes >= 8; bytes -= 8, at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, at, 8);
    h_ = mixed(h_ ^ word) + 0x9e3779b97f4a7c15ull;
  }
  if (bytes > 0) {
    std::uint64_t word = bytes;  // tells a short rest from one that ends in zeros
    for (std::size_t k = 0; k < bytes; ++k) word = word << 8 | at[k];
    h_ = mixed(h_ ^ word) + 0x9e3779b97f4a7c15ull;
  }
}

}  // namespace crampon
