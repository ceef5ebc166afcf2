#pragma once

#include <stdexcept>
#include <string>

namespace endowire::base {

/// A broken contract is our own bug, never the user's input.
class ContractError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

[[noreturn]] inline void contract_failed(const char* expression, const char* reason, const char* file,
                                         int line) {
  throw ContractError(std::string(file) + ":" + std::to_string(line) + ": " + reason + " (" + expression +
                      ")");
}

}  // namespace endowire::base

/// Checks what our own code promises, in every build but release (NDEBUG); `reason` says why it must hold.
#ifdef NDEBUG
#define ENDOWIRE_EXPECTS(condition, reason) static_cast<void>(0)
#else
#define ENDOWIRE_EXPECTS(condition, reason) \
  ((condition) ? static_cast<void>(0)       \
               : ::endowire::base::contract_failed(#condition, reason, __FILE__, __LINE__))
#endif
