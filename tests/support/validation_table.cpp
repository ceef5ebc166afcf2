#include "support/validation_table.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <vector>

namespace endowire::test {

namespace {

std::string fixed(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  const std::string result = text;
  // No negative zero.
  return result.find_first_of("123456789") == std::string::npos && result.front() == '-' ? result.substr(1)
                                                                                         : result;
}

/// Decimals that show about a hundredth of a size: not less, up to ten times more.
int decimals_of(double size) {
  return std::max(0, static_cast<int>(std::floor(2.0 - std::log10(size) + 1e-9)));
}

/// A size as a power of ten below a thousandth, else plain.
std::string plain(double size) {
  char text[64];
  std::snprintf(text, sizeof text, "%.3g", size);
  return text;
}

std::string row(const Check& c) {
  const bool relative = c.kind == ErrorKind::relative;
  const double scale = relative && c.reference != 0.0 ? std::abs(c.reference) : 1.0;
  const int value_decimals = decimals_of(c.tolerance * scale);
  // Tiny tolerances read better as they are than in percent.
  const bool percent = relative && c.tolerance >= 1e-6;
  const double unit = percent ? 1e2 : 1.0;
  const int error_decimals = decimals_of(c.tolerance * unit);
  std::ostringstream text;
  text << "| " << c.quantity << " | " << c.formula << " | " << fixed(c.reference, value_decimals) << " | "
       << fixed(c.ours, value_decimals) << " | " << fixed(unit * c.error(), error_decimals)
       << (percent ? " %" : "") << " | " << (std::isfinite(c.order) ? fixed(c.order, 1) : "") << " | "
       << plain(unit * c.tolerance) << (percent ? " %" : "") << " | " << c.source << " |\n";
  return text.str();
}

struct Token {
  std::string text;
  bool number = false;
};

/// Numbers and what stands between them; blanks do not count.
std::vector<Token> tokens(const std::string& text) {
  std::vector<Token> result;
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  for (std::size_t i = 0; i < text.size();) {
    const bool negative = text[i] == '-' && i + 1 < text.size() && digit(text[i + 1]);
    const bool number = digit(text[i]) || negative;
    std::size_t end = i + 1;
    while (number && end < text.size() && (digit(text[end]) || text[end] == '.')) ++end;
    if (number || std::isspace(static_cast<unsigned char>(text[i])) == 0)
      result.push_back({text.substr(i, end - i), number});
    i = end;
  }
  return result;
}

bool same_number(const std::string& a, const std::string& b) {
  const auto decimals = [](const std::string& t) {
    const std::size_t point = t.find('.');
    return point == std::string::npos ? 0 : static_cast<int>(t.size() - point - 1);
  };
  if (decimals(a) != decimals(b)) return false;
  return std::abs(std::stod(a) - std::stod(b)) <= 1.001 * std::pow(10.0, -decimals(a));
}

}  // namespace

std::string validation_table(const Checks& checks) {
  std::ostringstream text;
  text << "| quantity | closed form | its value | ours | error | order | allowed | source |\n"
          "|---|---|---|---|---|---|---|---|\n";
  for (const Check& c : checks) text << row(c);
  return text.str();
}

std::string validation_document(const std::vector<Section>& sections) {
  std::ostringstream text;
  text << "# Validation\n\n"
          "What the simulator gives beside closed forms of rod mechanics, contact and friction. `make "
          "validation` writes this file and its "
          "pictures\nfrom the code that the tests in `tests/physics` assert; a value that moves beyond what "
          "is allowed fails a test. Do not "
          "edit.\n\n"
          "Statics uses 100 rods unless it says so. *Order* is that at which the error fell since half as "
          "many rods. Sources are keys of "
          "`references.bib`, or the\nprinciple from which the closed form follows in a line.\n";
  for (const Section& section : sections) {
    text << "\n## " << section.title << "\n\n" << section.text << "\n\n";
    for (const Figure& figure : section.figures)
      text << "![" << figure.title << "](images/validation/" << figure.name << ".svg)\n";
    if (!section.figures.empty()) text << "\n";
    if (!section.checks.empty()) text << validation_table(section.checks);
  }
  text << "\n## Limitations\n\n"
          "Nothing above is a comparison with a physical phantom: no public data set holds geometry, wire, "
          "commands and shapes together. Not "
          "modelled: blood flow, motion of heart and\nbreath, motion of the vessel as a whole (its wall "
          "yields locally), inertia, loops that "
          "touch each other, and, for now, coaxial instruments in a vessel.\n";
  return text.str();
}

std::string table_difference(const std::string& committed, const std::string& generated) {
  std::istringstream old_lines(committed);
  std::istringstream new_lines(generated);
  std::string old_line;
  std::string new_line;
  for (;;) {
    const bool more_old = static_cast<bool>(std::getline(old_lines, old_line));
    const bool more_new = static_cast<bool>(std::getline(new_lines, new_line));
    if (!more_old && !more_new) return "";
    if (more_old != more_new)
      return more_old ? "no longer generated: " + old_line : "not committed: " + new_line;
    const std::vector<Token> a = tokens(old_line);
    const std::vector<Token> b = tokens(new_line);
    const bool same = std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Token& x, const Token& y) {
      return x.text == y.text || (x.number && y.number && same_number(x.text, y.text));
    });
    if (!same) return "committed: " + old_line + "\ngenerated: " + new_line;
  }
}

}  // namespace endowire::test
