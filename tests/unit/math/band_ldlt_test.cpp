#include "endowire/math/band_ldlt.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <tuple>

#include "support/frames.hpp"

namespace endowire::math {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A random symmetric matrix that fills every place of the band, and the same as a dense one.
struct Pair {
  BandMatrix band;
  MatrixXd dense;
};

Pair random_band(int size, test::Random& random, double diagonal, int block = BandMatrix::kBlock) {
  Pair p;
  p.band.resize(size, block);
  p.band.set_zero();
  p.dense = MatrixXd::Zero(size, size);
  for (int r = 0; r < size; ++r) {
    for (int c = 0; c <= r; ++c) {
      if (!p.band.holds(r, c)) continue;
      const double value = random.normal() + (r == c ? diagonal : 0.0);
      p.band.add(c, r, value);  // the upper place of the pair: add() must find the lower one
      p.dense(r, c) = p.dense(c, r) = value;
    }
  }
  return p;
}

std::vector<double> random_vector(int size, test::Random& random) {
  std::vector<double> v(static_cast<std::size_t>(size));
  for (double& x : v) x = random.normal();
  return v;
}

Eigen::Map<const VectorXd> view(const std::vector<double>& v) {
  return {v.data(), static_cast<Eigen::Index>(v.size())};
}

/// Unknowns, and how many of them a joint has: 4 for one instrument, more for several on one centreline.
class Sizes : public testing::TestWithParam<std::tuple<int, int>> {
 protected:
  [[nodiscard]] static int size() { return std::get<0>(GetParam()); }
  [[nodiscard]] static int block() { return std::get<1>(GetParam()); }
};

// Breaks with any wrong index at the borders of the band or of the matrix, which the sizes around the width reach.
TEST_P(Sizes, SolvesPositiveDefiniteSystemsAsEigenDoes) {
  test::Random random(static_cast<std::uint64_t>(100 + size()));
  for (int trial = 0; trial < 10; ++trial) {
    const int n = size();
    Pair p = random_band(n, random, 40.0, block());
    ASSERT_GT(p.dense.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0.0);
    EXPECT_EQ(p.band.factorise(), 0);
    std::vector<double> x = random_vector(n, random);
    const VectorXd b = view(x);
    p.band.solve(x);
    const VectorXd exact = p.dense.llt().solve(b);
    EXPECT_LT((view(x) - exact).norm(), 1e-12 * exact.norm());
  }
}

// Breaks with a transposed or doubled entry.
TEST_P(Sizes, MultipliesAsEigenDoes) {
  test::Random random(static_cast<std::uint64_t>(200 + size()));
  Pair p = random_band(size(), random, 0.0, block());
  const std::vector<double> x = random_vector(size(), random);
  std::vector<double> y(x.size(), 77.0);  // must be overwritten
  p.band.multiply(x, y);
  const VectorXd exact = p.dense * view(x);
  EXPECT_LT((view(y) - exact).norm(), 1e-13 * (1.0 + exact.norm()));
}

// Sylvester: pivots count the negative eigenvalues. Breaks when a pivot's sign is lost; Newton would then walk to a
// saddle.
TEST_P(Sizes, CountsNegativeEigenvalues) {
  test::Random random(static_cast<std::uint64_t>(300 + size()));
  int indefinite = 0;
  for (int trial = 0; trial < 20; ++trial) {
    Pair p = random_band(size(), random, random.uniform(-3.0, 12.0), block());
    const VectorXd eigenvalues = p.dense.selfadjointView<Eigen::Lower>().eigenvalues();
    const auto negative = static_cast<int>((eigenvalues.array() < 0.0).count());
    const auto pivots = [&](double shift) {
      BandMatrix copy = p.band;  // the factors take its place
      return copy.factorise(shift);
    };
    EXPECT_EQ(pivots(0.0), negative);
    indefinite += negative > 0 && negative < size();
    // The shift moves every eigenvalue: above the smallest one the matrix is definite, below it is not.
    const double lowest = eigenvalues.minCoeff();
    EXPECT_EQ(pivots(std::abs(lowest) + 1e-3), 0);
    if (lowest < -0.01) {
      EXPECT_GE(pivots(-lowest - 1e-3), 1);
    }
  }
  if (size() > 2) {
    EXPECT_GT(indefinite, 3) << "the trials were all definite: nothing was tested";
  }
}

// Breaks when the fixed unknown still couples on either side.
TEST_P(Sizes, FixMakesAnIdentityRow) {
  test::Random random(static_cast<std::uint64_t>(400 + size()));
  const int n = size();
  for (const int index : {0, n / 2, n - 1}) {
    Pair p = random_band(n, random, 40.0, block());
    p.band.fix(index);
    p.dense.row(index).setZero();
    p.dense.col(index).setZero();
    p.dense(index, index) = 1.0;
    EXPECT_EQ(p.band.factorise(), 0);
    std::vector<double> x = random_vector(n, random);
    x[static_cast<std::size_t>(index)] = 0.0;
    const VectorXd exact = p.dense.llt().solve(view(x));
    p.band.solve(x);
    EXPECT_EQ(x[static_cast<std::size_t>(index)], 0.0);
    EXPECT_LT((view(x) - exact).norm(), 1e-12 * (1.0 + exact.norm()));
  }
}

INSTANTIATE_TEST_SUITE_P(All, Sizes,
                         testing::Combine(testing::Values(1, 2, 4, 7, 8, 10, 11, 12, 13, 44, 120),
                                          testing::Values(4, 5, 7)));

// Breaks when a matrix that changes its block keeps places of the old one.
TEST(BandMatrix, TakesAnotherBlockAnew) {
  test::Random random(600);
  BandMatrix m;
  for (const int block : {4, 6, 5, 4}) {
    const int n = 5 * block;
    Pair p = random_band(n, random, 40.0, block);
    m.resize(n, block);
    m.set_zero();
    for (int r = 0; r < n; ++r)
      for (int c = 0; c <= r; ++c)
        if (m.holds(r, c)) m.lower(r, c) = p.dense(r, c);
    std::vector<double> x = random_vector(n, random);
    const VectorXd exact = p.dense.llt().solve(view(x));
    EXPECT_EQ(m.factorise(), 0);
    m.solve(x);
    EXPECT_LT((view(x) - exact).norm(), 1e-12 * exact.norm()) << block;
  }
}

// A rod is a million times stiffer along its axis than across: the residual must stay at rounding of the large part.
TEST(BandMatrix, SolvesBadlyScaledChains) {
  test::Random random(500);
  const int n = 80;
  Pair p = random_band(n, random, 0.0);
  p.band.set_zero();
  p.dense.setZero();
  for (int k = 0; k + 4 < n; ++k) {  // a chain of springs 1 … 1e6, anchored at one end
    const double stiffness = k % 4 == 0 ? 1e6 : 1.0;
    for (const auto& [r, c, sign] :
         {std::tuple{k, k, 1.0}, std::tuple{k + 4, k + 4, 1.0}, std::tuple{k + 4, k, -1.0}}) {
      p.band.add(r, c, sign * stiffness);
      p.dense(r, c) += sign * stiffness;
      if (r != c) p.dense(c, r) += sign * stiffness;
    }
  }
  for (int k = 0; k < 4; ++k) {
    p.band.add(k, k, 1.0);
    p.dense(k, k) += 1.0;
  }
  EXPECT_EQ(p.band.factorise(), 0);
  std::vector<double> x = random_vector(n, random);
  const VectorXd b = view(x);
  p.band.solve(x);
  EXPECT_LT((p.dense * view(x) - b).norm(), 1e-8 * b.norm());
}

// A singular matrix must never pass as positive definite. Breaks when a zero pivot counts as positive.
TEST(BandMatrix, ASingularMatrixIsNotDefinite) {
  BandMatrix m;
  m.resize(8);
  m.set_zero();
  EXPECT_EQ(m.factorise(), 8);
  m.set_zero();
  for (int i = 0; i < 8; ++i) m.add(i, i, 1.0);
  m.add(3, 2, 1.0);  // rows 2 and 3 become equal
  EXPECT_EQ(m.factorise(), 1);
}

// Breaks when NaN compares as a positive pivot.
TEST(BandMatrix, NotANumberIsNotDefinite) {
  BandMatrix m;
  m.resize(4);
  m.set_zero();
  for (int i = 0; i < 4; ++i) m.add(i, i, 1.0);
  m.add(2, 1, std::nan(""));
  EXPECT_GT(m.factorise(), 0);
}

}  // namespace
}  // namespace endowire::math
