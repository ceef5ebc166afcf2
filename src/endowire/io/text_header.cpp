#include "endowire/io/text_header.hpp"

#include <fmt/format.h>

#include <cmath>

#include "endowire/base/error.hpp"
#include "endowire/io/file.hpp"
#include "endowire/vessel/text_tokens.hpp"

namespace endowire::io {

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

void TextHeader::set(std::string_view key, std::string_view value) {
  values_.insert_or_assign(std::string(trimmed(key)), std::string(trimmed(value)));
}

std::string TextHeader::text(const std::string& key) const {
  const auto found = values_.find(key);
  return found == values_.end() ? std::string() : found->second;
}

void TextHeader::refuse(const std::string& key, const std::string& allowed) const {
  throw base::InputError(fmt::format("{}: {} is {}; must be {}", file_, key,
                                     has(key) ? '"' + one_line(text(key).substr(0, 60)) + '"' : "missing",
                                     allowed));
}

std::vector<double> TextHeader::numbers(const std::string& key, std::size_t count) const {
  std::string plain = text(key);
  for (char& c : plain)
    if (c == ',' || c == '(' || c == ')') c = ' ';
  vessel::Tokens words(plain);
  std::vector<double> numbers;
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    numbers.push_back(vessel::parse_number(word));
    if (!std::isfinite(numbers.back())) refuse(key, fmt::format("{} finite numbers", count));
  }
  if (numbers.size() != count) refuse(key, fmt::format("{} finite numbers", count));
  return numbers;
}

std::array<std::int64_t, 3> TextHeader::sizes(const std::string& key) const {
  const std::vector<double> given = numbers(key, 3);
  std::array<std::int64_t, 3> sizes{};
  for (std::size_t k = 0; k < 3; ++k) {
    if (given[k] != std::floor(given[k]) || std::abs(given[k]) > 1e15) refuse(key, "3 whole numbers");
    sizes[k] = static_cast<std::int64_t>(given[k]);
  }
  return sizes;
}

}  // namespace endowire::io
