#pragma once
/// All members of a struct as a list of named arrays of numbers: what saving, loading, comparing and hashing have in common. Names are paths,
/// "cracks[0].plane" or "contacts.entries.node"; an array of structs is one array for each of their members.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

#include "crampon/core/aligned_array.hpp"
#include "crampon/core/members.hpp"

namespace crampon {

/// Rows of `width` numbers.
struct ArrayLayout {
  Scalar scalar = Scalar::f64;
  std::size_t width = 1, rows = 0;
  std::size_t bytes() const { return rows * width * size_of(scalar); }
  bool operator==(const ArrayLayout&) const = default;
};

/// A kept array.
struct NamedArray {
  std::string name, unit;
  Use use = Use::course;
  ArrayLayout layout;
  std::vector<std::byte> data;
};

/// Where two states differ first: the array, the row and the component, and the two values as text.
struct StateDifference {
  std::string name;
  std::size_t row = 0, component = 0;
  std::string before, after;
  /// "particles.stress, row 12, component 2: 3.5 and 3.6".
  std::string text() const;
};

/// What is kept of a struct, in the order of its members.
class SavedState {
 public:
  /// Copies an array.
  void add(const std::string& name, const Member& member, const ArrayLayout& layout, const void* data);
  /// nullptr: there is none.
  const NamedArray* find(const std::string& name) const;
  /// The array for a member of so many numbers a row. Throws std::runtime_error that says how it is missing or of another kind.
  const NamedArray& get(const std::string& name, Scalar scalar, std::size_t width) const;
  const std::vector<NamedArray>& arrays() const { return arrays_; }
  std::size_t bytes() const;

 private:
  std::vector<NamedArray> arrays_;
  std::unordered_map<std::string, std::size_t> index_;
};

/// The first member and entry in which two saved states of one type differ, in the order of members; nothing: they are equal to the bit.
std::optional<StateDifference> first_difference(const SavedState& before, const SavedState& after);

/// A hash of bytes that follow each other, eight at a time.
class BitHash {
 public:
  void add(const void* data, std::size_t bytes);
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void add(const T& value) { add(&value, sizeof value); }
  std::uint64_t value() const { return mixed(h_); }

 private:
  static std::uint64_t mixed(std::uint64_t h) {
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9ull;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebull;
    return h ^ (h >> 31);
  }
  std::uint64_t h_ = 0x9e3779b97f4a7c15ull;
};

namespace detail {

template <class T>
struct IsVector : std::false_type {};
template <class T, class A>
struct IsVector<std::vector<T, A>> : std::true_type {};
template <class T>
struct IsAlignedArray : std::false_type {};
template <class T>
struct IsAlignedArray<AlignedArray<T>> : std::true_type {};
template <class T>
struct IsMap : std::false_type {};
template <class K, class V>
struct IsMap<std::unordered_map<K, V>> : std::true_type {};

/// A struct of numbers alone: arrays of it are kept member by member (gaps between members are not).
template <class T>
concept IsRow = HasMembers<T> && std::is_trivially_copyable_v<T>;

inline std::string joined(const std::string& path, const char* name) { return path.empty() ? name : path + "." + name; }

/// f(number) for all numbers of a struct of numbers, in their order.
template <class T, class F>
void for_numbers(T& row, F& f) {
  std::remove_const_t<T>::for_members(row, [&](const Member&, auto& value) {
    using V = std::remove_cvref_t<decltype(value)>;
    if constexpr (HasMembers<V>) {
      for_numbers(value, f);
    } else {
      static_assert(IsNumeric<V>, "a member of a struct in an array must be a number, an array of numbers, or a struct of them");
      f(value);
    }
  });
}

/// A number in every row of an array of structs.
struct Column {
  std::string name;
  Member member;
  ArrayLayout layout;
  std::size_t bytes_of_row() const { return layout.width * size_of(layout.scalar); }
};
template <class T>
void add_columns(const T& row, const std::string& path, std::vector<Column>& out) {
  T::for_members(row, [&](const Member& m, const auto& value) {
    using V = std::remove_cvref_t<decltype(value)>;
    if constexpr (HasMembers<V>) {
      add_columns(value, joined(path, m.name), out);
    } else {
      out.push_back({joined(path, m.name), m, {Numeric<V>::scalar, Numeric<V>::count, 0}});
    }
  });
}
template <class T>
std::vector<Column> columns_of(const std::string& path) {
  std::vector<Column> out;
  add_columns(T{}, path, out);
  return out;
}

}  // namespace detail

/// Hands all numbers of a member to sink(name, member, layout, data), array by array.
template <class T, class Sink>
void write_member(const T& value, const std::string& path, const Member& member, Sink&& sink) {
  if constexpr (IsNumeric<T>) {
    sink(path, member, ArrayLayout{Numeric<T>::scalar, Numeric<T>::count, 1}, static_cast<const void*>(&value));
  } else if constexpr (std::is_same_v<T, std::string>) {
    sink(path, member, ArrayLayout{Scalar::u8, 1, value.size()}, static_cast<const void*>(value.data()));
  } else if constexpr (std::is_same_v<T, std::vector<bool>>) {
    const std::vector<std::uint8_t> bytes(value.begin(), value.end());
    sink(path, member, ArrayLayout{Scalar::u8, 1, bytes.size()}, static_cast<const void*>(bytes.data()));
  } else if constexpr (HasMembers<T>) {
    T::for_members(value, [&](const Member& m, const auto& part) { write_member(part, detail::joined(path, m.name), m, sink); });
  } else if constexpr (detail::IsMap<T>::value) {
    std::vector<std::pair<typename T::key_type, typename T::mapped_type>> sorted(value.begin(), value.end());
    std::sort(sorted.begin(), sorted.end());
    std::vector<typename T::key_type> keys;
    std::vector<typename T::mapped_type> values;
    for (const auto& [key, mapped] : sorted) keys.push_back(key), values.push_back(mapped);
    write_member(keys, path + ".key", Member{member.name, "1", member.use}, sink);
    write_member(values, path + ".value", member, sink);
  } else {
    static_assert(detail::IsVector<T>::value || detail::IsAlignedArray<T>::value, "a member of this type cannot be kept");
    using E = std::remove_cvref_t<decltype(value[0])>;
    if constexpr (IsNumeric<E>) {
      sink(path, member, ArrayLayout{Numeric<E>::scalar, Numeric<E>::count, value.size()}, static_cast<const void*>(value.data()));
    } else if constexpr (detail::IsRow<E>) {
      std::vector<detail::Column> columns = detail::columns_of<E>(path);
      std::vector<std::vector<std::byte>> data;
      for (const detail::Column& c : columns) data.emplace_back(value.size() * c.bytes_of_row());
      for (std::size_t i = 0; i < value.size(); ++i) {
        std::size_t c = 0;
        const auto put = [&](const auto& number) {
          std::memcpy(data[c].data() + i * sizeof(number), &number, sizeof(number));
          ++c;
        };
        detail::for_numbers(value[i], put);
      }
      for (std::size_t c = 0; c < columns.size(); ++c) {
        columns[c].layout.rows = value.size();
        sink(columns[c].name, columns[c].member, columns[c].layout, static_cast<const void*>(data[c].data()));
      }
    } else if constexpr (detail::IsVector<E>::value) {
      // Lists of lists: how many each has, and all of them one after another.
      std::vector<std::uint64_t> counts;
      E all;
      for (const E& list : value) counts.push_back(list.size()), all.insert(all.end(), list.begin(), list.end());
      write_member(counts, path + ".count", Member{member.name, "1", member.use}, sink);
      write_member(all, path, member, sink);
    } else {
      write_member(std::uint64_t{value.size()}, path + ".count", Member{member.name, "1", member.use}, sink);
      for (std::size_t i = 0; i < value.size(); ++i) write_member(value[i], path + "[" + std::to_string(i) + "]", member, sink);
    }
  }
}

/// Fills a member with what was saved under its name. Throws std::runtime_error for what is missing or of another kind.
template <class T>
void read_member(T& value, const std::string& path, const SavedState& from) {
  if constexpr (IsNumeric<T>) {
    const NamedArray& a = from.get(path, Numeric<T>::scalar, Numeric<T>::count);
    if (a.layout.rows != 1) throw std::runtime_error(path + ": one row was expected, not " + std::to_string(a.layout.rows));
    std::memcpy(&value, a.data.data(), sizeof value);
  } else if constexpr (std::is_same_v<T, std::string>) {
    const NamedArray& a = from.get(path, Scalar::u8, 1);
    value.assign(reinterpret_cast<const char*>(a.data.data()), a.data.size());
  } else if constexpr (std::is_same_v<T, std::vector<bool>>) {
    const NamedArray& a = from.get(path, Scalar::u8, 1);
    value.assign(a.layout.rows, false);
    for (std::size_t i = 0; i < a.layout.rows; ++i) value[i] = a.data[i] != std::byte{0};
  } else if constexpr (HasMembers<T>) {
    T::for_members(value, [&](const Member& m, auto& part) { read_member(part, detail::joined(path, m.name), from); });
  } else if constexpr (detail::IsMap<T>::value) {
    std::vector<typename T::key_type> keys;
    std::vector<typename T::mapped_type> values;
    read_member(keys, path + ".key", from);
    read_member(values, path + ".value", from);
    if (keys.size() != values.size()) throw std::runtime_error(path + ": there are not as many keys as values");
    value.clear();
    for (std::size_t i = 0; i < keys.size(); ++i) value.emplace(keys[i], values[i]);
  } else {
    using E = std::remove_cvref_t<decltype(value[0])>;
    const auto resize = [&value](std::size_t n) {
      if constexpr (detail::IsAlignedArray<T>::value) {
        value.resize_discarding(n);
      } else {
        value.assign(n, E{});
      }
    };
    if constexpr (IsNumeric<E>) {
      const NamedArray& a = from.get(path, Numeric<E>::scalar, Numeric<E>::count);
      resize(a.layout.rows);
      if (!a.data.empty()) std::memcpy(static_cast<void*>(value.data()), a.data.data(), a.data.size());
    } else if constexpr (detail::IsRow<E>) {
      std::vector<const std::byte*> columns;
      std::optional<std::size_t> rows;
      for (const detail::Column& c : detail::columns_of<E>(path)) {
        const NamedArray& a = from.get(c.name, c.layout.scalar, c.layout.width);
        if (rows && *rows != a.layout.rows) throw std::runtime_error(c.name + ": it has not as many rows as the others of " + path);
        rows = a.layout.rows;
        columns.push_back(a.data.data());
      }
      resize(rows.value_or(0));
      for (std::size_t i = 0; i < value.size(); ++i) {
        std::size_t c = 0;
        const auto take = [&](auto& number) { std::memcpy(&number, columns[c++] + i * sizeof(number), sizeof(number)); };
        detail::for_numbers(value[i], take);
      }
    } else if constexpr (detail::IsVector<E>::value) {
      std::vector<std::uint64_t> counts;
      E all;
      read_member(counts, path + ".count", from);
      read_member(all, path, from);
      value.clear();
      auto at = all.begin();
      for (const std::uint64_t n : counts) {
        if (n > static_cast<std::uint64_t>(all.end() - at)) throw std::runtime_error(path + ": it has fewer entries than its lists say");
        value.emplace_back(at, at + static_cast<std::ptrdiff_t>(n));
        at += static_cast<std::ptrdiff_t>(n);
      }
    } else {
      std::uint64_t n = 0;
      read_member(n, path + ".count", from);
      value.clear();
      value.resize(n);
      for (std::size_t i = 0; i < value.size(); ++i) read_member(value[i], path + "[" + std::to_string(i) + "]", from);
    }
  }
}

/// Copies all members.
template <class T>
SavedState save_state(const T& object) {
  SavedState out;
  write_member(object, "", Member{""}, [&](const std::string& name, const Member& m, const ArrayLayout& layout, const void* data) {
    out.add(name, m, layout, data);
  });
  return out;
}

/// Sets all members from what was saved of the same type. Throws std::runtime_error that names what is missing or of another kind; the object
/// is then neither what it was nor what was kept.
template <class T>
void load_state(T& object, const SavedState& from) {
  read_member(object, "", from);
}

}  // namespace crampon
