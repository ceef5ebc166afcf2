#include "endowire/vessel/text_tokens.hpp"

#include <cmath>
#include <limits>

namespace endowire::vessel {
namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v';
}

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

}  // namespace

std::string_view Tokens::next() {
  while (at_ < text_.size() && is_space(text_[at_])) ++at_;
  const std::size_t begin = at_;
  while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
  return text_.substr(begin, at_ - begin);
}

void Tokens::skip_line() {
  while (at_ < text_.size() && text_[at_] != '\n') ++at_;
}

std::string_view Tokens::line() {
  const std::size_t begin = at_;
  skip_line();
  std::string_view line = text_.substr(begin, at_ - begin);
  if (at_ < text_.size()) ++at_;
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

bool equals(std::string_view token, std::string_view word) {
  if (token.size() != word.size()) return false;
  for (std::size_t i = 0; i < token.size(); ++i)
    if (lower(token[i]) != word[i]) return false;
  return true;
}

double parse_number(std::string_view text) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::size_t i = 0;
  const bool negative = i < text.size() && text[i] == '-';
  if (i < text.size() && (text[i] == '-' || text[i] == '+')) ++i;
  double mantissa = 0.0;
  int exponent = 0;
  bool digits = false;
  bool point = false;
  for (; i < text.size(); ++i) {
    const char c = text[i];
    if (c >= '0' && c <= '9') {
      digits = true;
      if (mantissa < 9e15) {
        mantissa = 10.0 * mantissa + (c - '0');
        if (point) --exponent;
      } else if (!point) {
        ++exponent;
      }
    } else if (c == '.' && !point) {
      point = true;
    } else {
      break;
    }
  }
  if (!digits) return none;
  if (i < text.size() && lower(text[i]) == 'e') {
    ++i;
    const bool minus = i < text.size() && text[i] == '-';
    if (i < text.size() && (text[i] == '-' || text[i] == '+')) ++i;
    if (i == text.size()) return none;
    int power = 0;
    for (; i < text.size(); ++i) {
      if (text[i] < '0' || text[i] > '9') return none;
      if (power < 10000) power = 10 * power + (text[i] - '0');
    }
    exponent += minus ? -power : power;
  }
  if (i != text.size()) return none;
  const double scaled =
      exponent < 0 ? mantissa / std::pow(10.0, -exponent) : mantissa * std::pow(10.0, exponent);
  const double value = mantissa == 0.0 ? 0.0 : scaled;
  return negative ? -value : value;
}

std::string quoted(std::string_view token) {
  std::string text;
  for (char c : token.substr(0, 24)) text += (c >= ' ' && c <= '~') ? c : '?';
  return text;
}

}  // namespace endowire::vessel
