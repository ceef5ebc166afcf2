#pragma once

#include <string>

namespace endowire::paper {

/// What is said of a claim: a rule decides, not the author.
enum class Verdict { holds, partly, fails };

[[nodiscard]] inline Verdict verdict(bool all, bool some) {
  return all ? Verdict::holds : some ? Verdict::partly : Verdict::fails;
}

[[nodiscard]] inline std::string text_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds:
      return "**holds**";
    case Verdict::partly:
      return "**holds partly**";
    case Verdict::fails:
      return "**does not hold here**";
  }
  return "";
}

/// A line of the list of claims.
[[nodiscard]] inline std::string claim(const std::string& what, Verdict verdict, const std::string& rule) {
  return "- " + what + ": " + text_of(verdict) + ". *Rule: " + rule + "*\n";
}

}  // namespace endowire::paper
