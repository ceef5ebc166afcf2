#pragma once

namespace endowire::vessel::anatomy {

/// A value with two derivatives by a parameter.
template <class T>
struct Jet {
  T value, first, second;
};

/// p(t) on [0, 1] with value, first and second derivative given at both ends: the quintic Hermite interpolant.
template <class T>
struct Quintic {
  T c0, c1, c2, c3, c4, c5;

  Quintic(const Jet<T>& a, const Jet<T>& b)
      : c0(a.value),
        c1(a.first),
        c2(0.5 * a.second),
        c3(10.0 * (b.value - a.value) - 6.0 * a.first - 4.0 * b.first - 1.5 * a.second + 0.5 * b.second),
        c4(-15.0 * (b.value - a.value) + 8.0 * a.first + 7.0 * b.first + 1.5 * a.second - b.second),
        c5(6.0 * (b.value - a.value) - 3.0 * a.first - 3.0 * b.first - 0.5 * a.second + 0.5 * b.second) {}

  [[nodiscard]] Jet<T> at(double t) const {
    return {c0 + t * (c1 + t * (c2 + t * (c3 + t * (c4 + t * c5)))),
            c1 + t * (2.0 * c2 + t * (3.0 * c3 + t * (4.0 * c4 + t * 5.0 * c5))),
            2.0 * c2 + t * (6.0 * c3 + t * (12.0 * c4 + t * 20.0 * c5))};
  }
};

}  // namespace endowire::vessel::anatomy
