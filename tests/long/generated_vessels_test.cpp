// Two hundred people of every anatomy.

#include <gtest/gtest.h>

#include "endowire/vessel/generate.hpp"
#include "support/anatomy_checks.hpp"

namespace endowire::vessel {
namespace {

class GeneratedVessels : public ::testing::TestWithParam<const char*> {};

TEST_P(GeneratedVessels, TwoHundredSeedsAreSound) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    GenerateRequest request;
    request.name = GetParam();
    request.seed = seed;
    request.open_ends = seed % 2 == 1;
    const GeneratedVessel made = generate(request);
    test::expect_sound_mesh(made, !request.open_ends);
    test::expect_smooth_axes(made);
    test::expect_parameters_measured_back(GetParam(), test::MeasuredVessel(made));
  }
}

INSTANTIATE_TEST_SUITE_P(All, GeneratedVessels, ::testing::ValuesIn(test::generator_names));

}  // namespace
}  // namespace endowire::vessel
