// V15: distance fields, analytic ones and those of meshes.
#include <gtest/gtest.h>

#include "cases/cases.hpp"
#include "support/expect_checks.hpp"

namespace endowire::test {
namespace {

TEST(V15DistanceField, OfRoundShapesIsExact) {
  expect_to_hold(analytic_fields());
}
TEST(V15DistanceField, OfMeshesIsWithinSagittaAndStatedError) {
  expect_to_hold(faceted_vessels());
}

}  // namespace
}  // namespace endowire::test
