#pragma once
/// Arrays of records for the hot loops: cache-line aligned, never initialised by construction, grown without copying.

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

namespace crampon {

inline constexpr std::size_t cache_line = 64;  // bytes

/// Memory on cache lines, or null. What is large asks for large pages: to touch ten million particles for the first time in pages of 4 KiB
/// takes as long as several steps.
inline void* allocate_aligned(std::size_t bytes) {
  constexpr std::size_t large_page = std::size_t{2} << 20;
  const std::size_t alignment = bytes < 2 * large_page ? cache_line : large_page;
  void* memory = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
#ifdef MADV_HUGEPAGE
  if (memory && alignment == large_page) ::madvise(memory, bytes / large_page * large_page, MADV_HUGEPAGE);  // it is a wish
#endif
  return memory;
}

template <class T>
class AlignedArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  AlignedArray() = default;
  explicit AlignedArray(std::size_t n) { resize_discarding(n); }

  /// Room for n items; what was there is lost, what is there now is indeterminate. Throws std::bad_alloc.
  void resize_discarding(std::size_t n) {
    if (n > capacity_) {
      data_.reset();
      capacity_ = n;
      data_.reset(static_cast<T*>(allocate_aligned(n * sizeof(T))));
      if (!data_) throw std::bad_alloc();
    }
    size_ = n;
  }

  std::size_t size() const { return size_; }
  std::size_t bytes() const { return capacity_ * sizeof(T); }
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  T& operator[](std::size_t i) { return data_.get()[i]; }
  const T& operator[](std::size_t i) const { return data_.get()[i]; }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }
  void swap(AlignedArray& b) noexcept {
    std::swap(data_, b.data_);
    std::swap(size_, b.size_);
    std::swap(capacity_, b.capacity_);
  }

 private:
  struct Free {
    void operator()(T* p) const { std::free(p); }
  };
  std::unique_ptr<T[], Free> data_;
  std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace crampon
