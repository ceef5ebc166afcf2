#include "harness/stage_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "endowire/io/markup.hpp"

namespace endowire::bench {

namespace {

constexpr double kWidth = 1060.0;
constexpr double kHeight = 560.0;
constexpr double kLeft = 70.0;
constexpr double kRight = 806.0;
constexpr double kTop = 92.0;
constexpr double kBase = 382.0;  // of the stack
constexpr double kStripTop = 408.0;
constexpr double kStripBase = 490.0;
constexpr std::size_t kMostBins = 245;  // three pixels each

/// By base::Stage. Neighbours in the stack differ in lightness too.
constexpr std::array<std::string_view, base::kStages> kColours{"#ffffff", "#cccccc", "#E8A33D", "#F5D67B",
                                                               "#0072B2", "#56B4E9", "#003F66", "#009E73",
                                                               "#CC6677", "#8C8C8C"};

/// Some steps, one after the other.
struct Bin {
  double from_mm = 0.0, to_mm = 0.0;
  double inserted_mm = 0.0, iterations = 0.0, cpu_us = 0.0;
  StageTimes stage_us{};
  bool snapped = false;
};

struct Axes {
  double most_mm = 1.0, most_us = 1.0, most_inserted_mm = 1.0, most_iterations = 1.0;
  [[nodiscard]] double x(double mm) const { return kLeft + mm / most_mm * (kRight - kLeft); }
  [[nodiscard]] double y(double us) const { return kBase - std::min(us / most_us, 1.0) * (kBase - kTop); }
  [[nodiscard]] double strip(double share) const { return kStripBase - share * (kStripBase - kStripTop); }
};

/// A hand that turns in place travels too, or its steps would lie on each other.
constexpr double kTurnAsTravel_mm = 1.0;

std::vector<Bin> bins_of(const std::vector<StepRow>& rows) {
  const std::size_t count = std::min(kMostBins, rows.size());
  std::vector<Bin> bins;
  double travel = 0.0;
  double before_mm = 0.0;
  const double least = rows.size() > 5000 ? 0.0 : kTurnAsTravel_mm;
  for (std::size_t b = 0; b < count; ++b) {
    const std::size_t from = b * rows.size() / count;
    const std::size_t to = (b + 1) * rows.size() / count;
    Bin bin;
    bin.from_mm = travel;
    double calm = 0.0;
    for (std::size_t i = from; i < to; ++i) {
      const StepRow& row = rows[i];
      const double moved = row.travel_mm - before_mm;
      before_mm = row.travel_mm;
      travel += moved > 0.0 ? moved : least;
      bin.inserted_mm = row.inserted_mm;
      bin.snapped = bin.snapped || row.snapped;
      if (row.snapped) continue;
      calm += 1.0;
      bin.iterations += row.iterations;
      bin.cpu_us += row.cpu_us;
      for (std::size_t s = 0; s < row.stage_us.size(); ++s) bin.stage_us[s] += row.stage_us[s];
    }
    bin.to_mm = travel;
    if (calm > 0.0) {
      bin.iterations /= calm;
      bin.cpu_us /= calm;
      for (double& us : bin.stage_us) us /= calm;
    }
    bins.push_back(bin);
  }
  return bins;
}

double sum_of(const StageTimes& us) {
  double sum = 0.0;
  for (const double value : us) sum += value;
  return sum;
}

/// Rounded up to 1, 2 or 5 times a power of ten.
double round_up(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double digit : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (digit * decade >= value) return digit * decade;
  return 10.0 * decade;
}

double tick_step(double most, double ticks) {
  const double rough = most / ticks;
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  return decade * (rough / decade > 5.0   ? 10.0
                   : rough / decade > 2.0 ? 5.0
                   : rough / decade > 1.0 ? 2.0
                                          : 1.0);
}

std::string text(double x, double y, std::string_view more, std::string_view words) {
  return fmt::format("<text x='{:.1f}' y='{:.1f}' {}>{}</text>\n", x, y, more, io::escaped_markup(words));
}

std::string grid(const Axes& axes) {
  std::string out;
  const double us_step = tick_step(axes.most_us, 6.0);
  for (double us = 0.0; us <= axes.most_us * 1.0001; us += us_step) {
    out += fmt::format("<path d='M{0} {1:.1f}H{2}' stroke='#e6e6e6'/>\n", kLeft, axes.y(us), kRight);
    out += text(kLeft - 8.0, axes.y(us) + 4.0, "text-anchor='end'", fmt::format("{:g}", us));
  }
  const double mm_step = tick_step(axes.most_mm, 8.0);
  for (double mm = 0.0; mm <= axes.most_mm * 1.0001; mm += mm_step) {
    out += fmt::format("<path d='M{0:.1f} {1}V{2}' stroke='#efefef'/>\n", axes.x(mm), kStripTop, kStripBase);
    out += text(axes.x(mm), kStripBase + 18.0, "text-anchor='middle'", fmt::format("{:g}", mm));
  }
  out += text(kLeft, kTop - 10.0, "fill='#555'", "computing time of a step [µs], steps without a snap");
  out += text(0.5 * (kLeft + kRight), kStripBase + 40.0, "text-anchor='middle' fill='#555'",
              "travel of the hand, to and fro [mm]");
  return out;
}

/// The stages one upon the other, drawn as steps.
std::string stack(const std::vector<Bin>& bins, const Axes& axes) {
  std::string out;
  std::vector<double> below(bins.size(), 0.0);
  for (std::size_t s = 1; s < base::kStages; ++s) {
    std::string upper;
    std::string lower;
    for (std::size_t b = 0; b < bins.size(); ++b) {
      const double from = below[b];
      below[b] += bins[b].stage_us[s];
      upper += fmt::format("{}{:.1f} {:.1f}H{:.1f}", b == 0 ? "M" : "L", axes.x(bins[b].from_mm),
                           axes.y(below[b]), axes.x(bins[b].to_mm));
      lower =
          fmt::format("L{:.1f} {:.1f}H{:.1f}", axes.x(bins[b].to_mm), axes.y(from), axes.x(bins[b].from_mm)) +
          lower;
    }
    out += fmt::format("<path d='{}{}Z' fill='{}'/>\n", upper, lower, kColours[s]);
  }
  return out;
}

std::string snaps(const std::vector<Bin>& bins, const Axes& axes) {
  std::string out;
  for (const Bin& bin : bins)
    if (bin.snapped)
      out += fmt::format("<path d='M{0:.1f} {1}v9' stroke='#D55E00' stroke-width='2'/>\n",
                         axes.x(0.5 * (bin.from_mm + bin.to_mm)), kBase + 3.0);
  return out;
}

std::string strip(const std::vector<Bin>& bins, const Axes& axes) {
  std::string inserted;
  std::string iterations;
  for (const Bin& bin : bins) {
    const double x = axes.x(0.5 * (bin.from_mm + bin.to_mm));
    const char* go = inserted.empty() ? "M" : "L";
    inserted += fmt::format("{}{:.1f} {:.1f}", go, x, axes.strip(bin.inserted_mm / axes.most_inserted_mm));
    iterations += fmt::format("{}{:.1f} {:.1f}", go, x,
                              axes.strip(std::min(1.0, bin.iterations / axes.most_iterations)));
  }
  std::string out = fmt::format("<rect x='{}' y='{}' width='{}' height='{}' fill='none' stroke='#bbb'/>\n",
                                kLeft, kStripTop, kRight - kLeft, kStripBase - kStripTop);
  out += fmt::format("<path d='{}' fill='none' stroke='#0072B2' stroke-width='1.2'/>\n", iterations);
  out += fmt::format("<path d='{}' fill='none' stroke='#222' stroke-width='1.8'/>\n", inserted);
  out +=
      text(kLeft - 8.0, kStripTop + 10.0, "text-anchor='end'", fmt::format("{:.0f}", axes.most_inserted_mm));
  out += text(kLeft - 8.0, kStripBase, "text-anchor='end'", "0");
  out += text(kRight + 14.0, kStripTop + 18.0, "fill='#222'",
              fmt::format("wire inside, 0 to {:.0f} mm", axes.most_inserted_mm));
  out += text(kRight + 14.0, kStripTop + 38.0, "fill='#0072B2'",
              fmt::format("Newton iterations, 0 to {:g}", axes.most_iterations));
  return out;
}

std::string legend(const Measured& m) {
  std::string out;
  const double whole = std::max(1e-9, sum_of(m.mean_stage_us));
  double y = kTop + 8.0;
  out += text(kRight + 14.0, y - 14.0, "fill='#555'", "mean of a step");
  for (std::size_t s = base::kStages; s-- > 1;) {
    y += 22.0;
    out += fmt::format("<rect x='{}' y='{:.1f}' width='13' height='13' fill='{}'/>\n", kRight + 14.0,
                       y - 11.0, kColours[s]);
    out += text(kRight + 34.0, y, "", stage_names[s]);
    out += text(kWidth - 66.0, y, "text-anchor='end'", fmt::format("{:.0f} µs", m.mean_stage_us[s]));
    out += text(kWidth - 20.0, y, "text-anchor='end' fill='#777'",
                fmt::format("{:.0f} %", 100.0 * m.mean_stage_us[s] / whole));
  }
  y += 26.0;
  out += text(kRight + 34.0, y, "font-weight='bold'", "sum");
  out += text(kWidth - 66.0, y, "text-anchor='end' font-weight='bold'", fmt::format("{:.0f} µs", whole));
  if (m.snaps > 0) {
    y += 24.0;
    out +=
        fmt::format("<path d='M{0} {1:.1f}v9' stroke='#D55E00' stroke-width='2'/>\n", kRight + 20.0, y - 9.0);
    out += text(kRight + 34.0, y, "fill='#555'", fmt::format("{} steps with a snap", m.snaps));
  }
  return out;
}

}  // namespace

std::string stage_picture_svg(const Measured& m) {
  const std::vector<Bin> bins = bins_of(m.rows);
  Axes axes;
  std::vector<double> heights;
  for (const Bin& bin : bins) {
    heights.push_back(sum_of(bin.stage_us));
    axes.most_mm = std::max(axes.most_mm, bin.to_mm);
    axes.most_inserted_mm = std::max(axes.most_inserted_mm, bin.inserted_mm);
    axes.most_iterations = std::max(axes.most_iterations, bin.iterations);
  }
  std::sort(heights.begin(), heights.end());
  // A few tall bins would press all others flat: they are cut off at the frame.
  const double tall = heights[heights.size() * 98 / 100];
  axes.most_us = round_up(std::max(1.0, std::min(heights.back(), 1.25 * tall)));
  axes.most_iterations = round_up(axes.most_iterations);
  std::string out = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0:.0f} {1:.0f}' width='{0:.0f}' "
      "height='{1:.0f}' "
      "font-family='sans-serif' font-size='12' fill='#222'>\n<rect width='100%' height='100%' "
      "fill='white'/>\n",
      kWidth, kHeight);
  out += text(kLeft, 30.0, "font-size='19' font-weight='bold'", m.scenario.name);
  out += text(kLeft, 50.0, "fill='#555'", m.scenario.what);
  out += text(kWidth - 20.0, 30.0, "text-anchor='end'",
              fmt::format("p50 {:.0f} µs, p99 {:.0f} µs, p99.9 {:.0f} µs without a snap", m.calm.p50,
                          m.calm.p99, m.calm.p999));
  out += text(kWidth - 20.0, 50.0, "text-anchor='end' fill='#555'",
              fmt::format("{} steps; {:.0f} rods, {:.0f} samples, {:.1f} iterations in the mean", m.steps,
                          m.mean_rods, m.mean_samples, m.mean_iterations));
  out += grid(axes) + stack(bins, axes) + snaps(bins, axes) + strip(bins, axes) + legend(m);
  if (heights.back() > axes.most_us)
    out += text(kRight, kTop - 10.0, "text-anchor='end' fill='#555'",
                fmt::format("cut off; tallest mean {:.0f} µs", heights.back()));
  out += text(
      kLeft, kHeight - 12.0, "fill='#777' font-size='11'",
      fmt::format("{}, {}, one thread; calibration {:.2f} ns before, {:.2f} ns after; state {:016x}",
                  m.processor, m.compiler, m.calibration_before_ns, m.calibration_after_ns, m.state_hash));
  return out + "</svg>\n";
}

}  // namespace endowire::bench
