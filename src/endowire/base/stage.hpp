#pragma once

#include <cstdint>

namespace endowire::base {

/// What a step is busy with, as far as its time is told apart.
enum class Stage : std::uint8_t {
  outside,        ///< not in a step
  predict,        ///< feed, trace, drift, what enters the sheath, rods divided and joined
  place,          ///< samples along the predicted wire
  detect,         ///< walls near samples, anew where they proved wrong
  linearise,      ///< merit, gradient and Hessian of all but the contacts
  contact_model,  ///< contacts of the quadratic model, once a round
  factorise,      ///< band LDLᵀ and its solve, once a round
  line_search,    ///< trial states and their merit
  verify,         ///< walls held against the field
  rest,           ///< Newton's bookkeeping, saving the state, measuring forces, events
};
inline constexpr int kStages = 10;

/// Watches a computation go from stage to stage. It only listens: nothing that is computed depends on it, and the core knows no
/// clock.
class StageObserver {
 public:
  virtual ~StageObserver() = default;
  /// @return the stage that this one interrupts
  virtual Stage enter(Stage stage) noexcept = 0;
};

/// Says which stage a block belongs to; at its end the stage around it goes on. Without an observer it costs a comparison.
class StageScope {
 public:
  StageScope(StageObserver* observer, Stage stage)
      : observer_(observer), around_(observer == nullptr ? Stage::outside : observer->enter(stage)) {}
  ~StageScope() {
    if (observer_ != nullptr) observer_->enter(around_);
  }
  StageScope(const StageScope&) = delete;
  StageScope& operator=(const StageScope&) = delete;

 private:
  StageObserver* observer_;
  Stage around_;
};

}  // namespace endowire::base
