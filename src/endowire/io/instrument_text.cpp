#include "endowire/io/instrument_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "endowire/io/instrument_facts.hpp"
#include "endowire/io/text_table.hpp"

namespace endowire::io {

namespace {

constexpr int columns = 72;
constexpr int profile_rows = 8;
constexpr int most_shape_rows = 18;
constexpr double cell_aspect = 2.0;  // a character is twice as high as wide

/// Four digits that count, without a power of ten where that is longer to read than the number.
std::string number_text(double value) {
  if (!std::isfinite(value)) return "none";
  if (std::abs(value) < 1e4) return fmt::format("{:.4g}", value);
  const double last = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 3.0);
  return fmt::format("{:.0f}", last * std::round(value / last));
}

std::string ends_text(const rod::Taper& taper) {
  const std::string tip = number_text(taper.at_tip_side);
  const std::string hand = number_text(taper.at_hand_side);
  return tip == hand ? tip : tip + ".." + hand;
}

std::string without_blanks_behind(std::string row) {
  row.erase(row.find_last_not_of(' ') + 1);
  return row + '\n';
}

}  // namespace

std::string profile_text(const rod::MaterialLine& line) {
  const std::vector<double> arcs = profile_arcs_mm(line, columns);
  std::vector<double> rigidity;
  rigidity.reserve(arcs.size());
  for (const double arc : arcs) rigidity.push_back(line.flexural_rigidity_n_mm2(arc));
  const auto [least, most] = std::minmax_element(rigidity.begin(), rigidity.end());
  const double low = std::log10(*least) - 0.1;
  const double high = std::max(std::log10(*most), low + 0.2);
  std::string text = "EI [N mm2] from the tip to the hand\n";
  for (int row = profile_rows - 1; row >= 0; --row) {
    const double level = low + (high - low) * (row + 0.5) / profile_rows;
    const bool labelled = row == profile_rows - 1 || row == 0;
    const double label = row == 0 ? *least : *most;
    std::string bars;
    for (const double value : rigidity) bars += std::log10(value) >= level ? '#' : ' ';
    text += without_blanks_behind((labelled ? fmt::format("{:>8.4g} |", label) : fmt::format("{:>8} |", "")) +
                                  bars);
  }
  std::string axis(static_cast<std::size_t>(columns), ' ');
  for (const int tick : {0, columns / 4, columns / 2, 3 * columns / 4}) {
    const std::string label = fmt::format("{:.0f}", arcs[static_cast<std::size_t>(tick)]);
    axis.replace(static_cast<std::size_t>(tick), label.size(), label);
  }
  const std::string end = fmt::format("{:.0f} mm", line.length_mm());
  axis.replace(axis.size() - end.size(), end.size(), end);
  return text + fmt::format("{:>8} +{}\n{:>8}  {}\n", "", std::string(static_cast<std::size_t>(columns), '-'),
                            "", axis);
}

std::string shape_text(const rod::MaterialLine& line) {
  const std::vector<Eigen::Vector3d> joints = unloaded_end_mm(line);
  Eigen::Array2d low = joints.front().head<2>().array();
  Eigen::Array2d high = low;
  for (const Eigen::Vector3d& p : joints) {
    low = low.min(p.head<2>().array());
    high = high.max(p.head<2>().array());
  }
  const Eigen::Array2d size = (high - low).max(1e-9);
  // Millimetres of a column: the shape fits both ways.
  const double scale = std::max(size.x() / (columns - 1), size.y() / (cell_aspect * (most_shape_rows - 1)));
  const auto rows = static_cast<std::size_t>(std::lround(size.y() / (cell_aspect * scale))) + 1;
  std::vector<std::string> picture(rows, std::string(static_cast<std::size_t>(columns), ' '));
  for (std::size_t i = joints.size(); i-- > 0;) {
    const Eigen::Array2d at = joints[i].head<2>().array() - low;
    const auto column = static_cast<std::size_t>(std::lround(at.x() / scale));
    const auto row = rows - 1 - static_cast<std::size_t>(std::lround(at.y() / (cell_aspect * scale)));
    picture[std::min(row, rows - 1)][std::min(column, static_cast<std::size_t>(columns - 1))] =
        i == 0 ? 'o' : '*';
  }
  std::string text = fmt::format("unloaded end, {:.3g} mm a column; o is the tip\n", scale);
  for (const std::string& row : picture) text += without_blanks_behind("  " + row);
  return text;
}

std::string sections_text(const rod::MaterialLine& line) {
  TextTable table({{"from mm"},
                   {"length mm"},
                   {"EI N mm2"},
                   {"GJ N mm2"},
                   {"EA N"},
                   {"radius mm"},
                   {"friction"},
                   {"bend 1/mm"},
                   {"kink 1/mm"},
                   {"mass mg/mm"}});
  double start = 0.0;
  for (const rod::Section& s : line.instrument().sections) {
    rod::Taper mass = s.linear_density_g_per_mm;
    mass.at_tip_side *= 1e3;
    mass.at_hand_side *= 1e3;
    table.add({number_text(start), number_text(s.length_mm), ends_text(s.flexural_rigidity_n_mm2),
               ends_text(s.torsional_rigidity_n_mm2), ends_text(s.axial_rigidity_n), ends_text(s.radius_mm),
               number_text(s.friction), number_text(s.rest_curvature_per_mm),
               ends_text(s.kink_curvature_per_mm), ends_text(mass)});
    start += s.length_mm;
  }
  return table.text();
}

std::string values_text(const InstrumentFile& file) {
  constexpr auto left = TextTable::Align::left;
  TextTable table({{"field", left}, {"value", left}, {"source", left}});
  for (const SourcedValue& value : file.values) table.add({value.field, value.value, value.source});
  return table.text();
}

std::string library_text(const std::vector<InstrumentFile>& files) {
  constexpr auto left = TextTable::Align::left;
  TextTable table({{"model", left},
                   {"diameter mm"},
                   {"length cm"},
                   {"EI at tip N mm2"},
                   {"EI at hand N mm2"},
                   {"description", left}});
  for (const InstrumentFile& file : files) {
    const InstrumentFacts facts = facts_of(rod::MaterialLine(file.instrument));
    table.add({file.instrument.model, fmt::format("{:.3f}", facts.diameter_mm),
               number_text(0.1 * facts.length_mm), number_text(facts.tip_rigidity_n_mm2),
               number_text(facts.shaft_rigidity_n_mm2), file.description});
  }
  return table.text();
}

}  // namespace endowire::io
