#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <string_view>

#include "endowire/base/stage.hpp"

namespace endowire::bench {

/// A value for each stage, in the order of base::Stage.
using StageTimes = std::array<double, base::kStages>;

/// Names as they stand in tables, in the order of base::Stage.
inline constexpr std::array<std::string_view, base::kStages> stage_names{
    "outside",       "predict",   "place",       "detect", "linearise",
    "contact model", "factorise", "line search", "verify", "rest"};

/// The clock outside the core: charges time to the stage that a step is in. Costs two readings of the clock a scope.
class StageClock final : public base::StageObserver {
 public:
  base::Stage enter(base::Stage stage) noexcept override {
    const auto now = std::chrono::steady_clock::now();
    us_[static_cast<std::size_t>(stage_)] += std::chrono::duration<double, std::micro>(now - since_).count();
    since_ = now;
    const base::Stage before = stage_;
    stage_ = stage;
    return before;
  }
  /// What has been charged since the last call. [µs]
  [[nodiscard]] StageTimes take() {
    const StageTimes taken = us_;
    us_.fill(0.0);
    return taken;
  }

 private:
  std::chrono::steady_clock::time_point since_ = std::chrono::steady_clock::now();
  base::Stage stage_ = base::Stage::outside;
  StageTimes us_{};
};

}  // namespace endowire::bench
