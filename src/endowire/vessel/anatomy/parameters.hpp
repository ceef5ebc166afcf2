#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace endowire::vessel::anatomy {

/// What a person's size makes vary together: who has a wide aorta has wide iliacs.
enum class Trait : std::uint8_t { own, calibre, stature };

/// One number that shapes an anatomy.
struct Parameter {
  const char* name;  ///< ends with its unit
  const char* unit;
  double usual;  ///< the default
  double low;    ///< the published range, mean ± 2 standard deviations where the source gives them
  double high;
  bool whole;  ///< only whole numbers
  Trait trait;
  const char* meaning;
  const char* source;  ///< keys of docs/references.bib, or `estimate:` and why
};

/// Tables one after the other.
template <std::size_t... N>
[[nodiscard]] constexpr auto joined(const std::array<Parameter, N>&... tables) {
  std::array<Parameter, (N + ...)> all{};
  std::size_t i = 0;
  const auto append = [&](const auto& table) {
    for (const Parameter& parameter : table) all[i++] = parameter;
  };
  (append(tables), ...);
  return all;
}

/// The numbers of one vessel, each within its range.
class Values {
 public:
  Values(std::span<const Parameter> table, std::vector<double> numbers)
      : table_(table), numbers_(std::move(numbers)) {}
  /// The value of a parameter of the table.
  [[nodiscard]] double operator[](std::string_view name) const;
  void set(std::string_view name, double number);
  [[nodiscard]] std::span<const Parameter> table() const { return table_; }
  [[nodiscard]] const std::vector<double>& numbers() const { return numbers_; }

 private:
  [[nodiscard]] std::size_t index_of(std::string_view name) const;
  std::span<const Parameter> table_;
  std::vector<double> numbers_;
};

using Settings = std::map<std::string, double, std::less<>>;

/// Checks given numbers and completes them with the defaults.
/// @param prefix  begins every message: `scene.toml: vessel.parameters.` or `--set: `
/// @throws base::InputError `prefix` name ` is 3; must be between 27 and 42`; for an unknown name, all known ones
[[nodiscard]] Values complete(std::span<const Parameter> table, const Settings& given,
                              const std::string& prefix);

/// The same, but every number that is not given is drawn.
///
/// Real numbers come from a normal distribution around the default with a quarter of the range as standard
/// deviation, drawn again while outside the range; those that share a trait are correlated by 0.72 (an
/// estimate: calibres of one person go together, and not quite). A whole number is the default in six cases of
/// ten, else one of the others. A normal number is the sum of twelve even ones less six, so that every machine
/// gets the same bits.
/// @param attempt  0, 1, …: further draws for the same seed, should the first give an impossible vessel
[[nodiscard]] Values drawn(std::span<const Parameter> table, const Settings& given, const std::string& prefix,
                           std::uint64_t seed, std::uint64_t attempt = 0);

/// One vessel that is not wider than another.
struct Narrower {
  const char* narrow;
  const char* wide;
  double factor;  ///< narrow <= factor · wide
};
/// The first of these that does not hold, as the end of a message: `narrow is 5; must be <= 4.2, 0.9 of wide`.
[[nodiscard]] std::string first_wider(const Values& values, std::span<const Narrower> order);

/// A number as messages show it: up to six digits.
[[nodiscard]] std::string text_of(double number);

}  // namespace endowire::vessel::anatomy
