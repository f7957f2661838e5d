#include "crampon/core/predicates.hpp"

namespace crampon {

namespace {

/// high + low is exactly the result of the operation, high its rounded value.
struct Exact {
  double high, low;
};

Exact add(double a, double b) {  // D. E. Knuth: six operations, no assumption on magnitudes
  const double sum = a + b;
  const double b_part = sum - a;
  const double a_part = sum - b_part;
  return {sum, (a - a_part) + (b - b_part)};
}

Exact multiply(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

int sign_of(double x) { return (x > 0) - (x < 0); }

/// An exact sum as non-overlapping doubles of increasing magnitude, zeros left out (Shewchuk 1997, section 2.4):
/// the last one carries the sign.
class Expansion {
 public:
  void add_term(double x) {
    int kept = 0;
    for (int i = 0; i < size_; ++i) {
      const Exact s = add(x, term_[i]);
      if (s.low != 0) term_[kept++] = s.low;
      x = s.high;
    }
    if (x != 0) term_[kept++] = x;
    size_ = kept;
  }
  void add_product(double a, double b) {
    const Exact p = multiply(a, b);
    add_term(p.low);
    add_term(p.high);
  }
  int sign() const { return size_ == 0 ? 0 : sign_of(term_[size_ - 1]); }

 private:
  double term_[16];  // eight products of two parts
  int size_ = 0;
};

}  // namespace

int orient_sign_exact(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c) {
  const Exact bx = add(b[0], -a[0]), by = add(b[1], -a[1]);
  const Exact cx = add(c[0], -a[0]), cy = add(c[1], -a[1]);
  if (bx.low == 0 && by.low == 0 && cx.low == 0 && cy.low == 0) {
    // Differences without rounding, the usual case near a grid-aligned crack. Rounding is monotonic, so unequal rounded products
    // are in the order of the exact ones, and equal ones leave the order to their exact remainders.
    const Exact left = multiply(bx.high, cy.high), right = multiply(by.high, cx.high);
    return left.high != right.high ? sign_of(left.high - right.high) : (left.low > right.low) - (left.low < right.low);
  }
  Expansion determinant;
  for (const double x : {bx.low, bx.high}) {
    for (const double y : {cy.low, cy.high}) determinant.add_product(x, y);
  }
  for (const double y : {by.low, by.high}) {
    for (const double x : {cx.low, cx.high}) determinant.add_product(-y, x);
  }
  return determinant.sign();
}

}  // namespace crampon
