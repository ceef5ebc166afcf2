#include "endowire/vessel/anatomy/parameters.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "endowire/base/contract.hpp"
#include "endowire/base/error.hpp"
#include "endowire/vessel/random.hpp"

namespace endowire::vessel::anatomy {
namespace {

/// How much of a number's deviation is its trait's. Two that share a trait are correlated by the square.
constexpr double trait_share = 0.85;
/// How often a whole number is the usual one: variants of the arch are seen in some four of ten people.
constexpr double usual_share = 0.6;

double normal(SplitMix& random) {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) sum += random.uniform();
  return sum;
}

std::string range_text(const Parameter& parameter) {
  return std::string(parameter.whole ? "a whole number " : "") + "between " + text_of(parameter.low) +
         " and " + text_of(parameter.high);
}

bool allowed(const Parameter& parameter, double number) {
  return number >= parameter.low && number <= parameter.high &&
         (!parameter.whole || number == std::floor(number));
}

void refuse_unknown(std::span<const Parameter> table, const std::string& name, const std::string& prefix) {
  std::string known;
  for (const Parameter& parameter : table) known += (known.empty() ? "" : ", ") + std::string(parameter.name);
  throw base::InputError(prefix + name + " is unknown; known here: " + known);
}

}  // namespace

std::string text_of(double number) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", number);
  return text.data();
}

std::size_t Values::index_of(std::string_view name) const {
  for (std::size_t i = 0; i < table_.size(); ++i)
    if (name == table_[i].name) return i;
  ENDOWIRE_EXPECTS(false, "an anatomy reads the parameters of its own table");
  return 0;
}

double Values::operator[](std::string_view name) const {
  return numbers_[index_of(name)];
}

void Values::set(std::string_view name, double number) {
  numbers_[index_of(name)] = number;
}

std::string first_wider(const Values& values, std::span<const Narrower> order) {
  for (const Narrower& pair : order) {
    const double most = pair.factor * values[pair.wide];
    if (values[pair.narrow] > most)
      return std::string(pair.narrow) + " is " + text_of(values[pair.narrow]) +
             "; must be <= " + text_of(0.01 * std::floor(100.0 * most)) + ", " + text_of(pair.factor) +
             " of " + pair.wide;
  }
  return {};
}

Values complete(std::span<const Parameter> table, const Settings& given, const std::string& prefix) {
  std::vector<double> numbers;
  numbers.reserve(table.size());
  for (const Parameter& parameter : table) numbers.push_back(parameter.usual);
  for (const auto& [name, number] : given) {
    std::size_t i = 0;
    while (i < table.size() && name != table[i].name) ++i;
    if (i == table.size()) refuse_unknown(table, name, prefix);
    if (!allowed(table[i], number))
      throw base::InputError(prefix + name + " is " + text_of(number) + "; must be " + range_text(table[i]));
    numbers[i] = number;
  }
  return {table, std::move(numbers)};
}

Values drawn(std::span<const Parameter> table, const Settings& given, const std::string& prefix,
             std::uint64_t seed, std::uint64_t attempt) {
  Values values = complete(table, given, prefix);
  SplitMix random(seed ^ (attempt << 48));
  const std::array<double, 3> trait{0.0, normal(random), normal(random)};
  const double own_share = std::sqrt(1.0 - trait_share * trait_share);
  for (const Parameter& parameter : table) {
    // A stream of its own for each parameter: giving one by hand leaves the others as they were.
    SplitMix own(random.next());
    if (given.contains(parameter.name)) continue;
    if (parameter.whole) {
      const bool usual = own.uniform() < usual_share;
      const double other = parameter.low + std::floor((parameter.high - parameter.low) * own.uniform());
      values.set(parameter.name, usual ? parameter.usual : other + (other >= parameter.usual ? 1.0 : 0.0));
      continue;
    }
    const double spread = 0.25 * (parameter.high - parameter.low);
    const double shared = trait[static_cast<std::size_t>(parameter.trait)];
    double number = parameter.low - 1.0;
    for (int tries = 0; !allowed(parameter, number); ++tries) {
      const double deviation = parameter.trait == Trait::own || tries > 20
                                   ? normal(own)
                                   : trait_share * shared + own_share * normal(own);
      number = parameter.usual + spread * deviation;
    }
    values.set(parameter.name, number);
  }
  return values;
}

}  // namespace endowire::vessel::anatomy
