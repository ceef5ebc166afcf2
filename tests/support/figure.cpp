#include "support/figure.hpp"

#include "support/chart.hpp"

namespace endowire::test {

namespace {

drawing::Series drawn(const Series& series) {
  drawing::Series out;
  for (const PlanePoint& p : series.points) out.points.push_back({p.x, p.y});
  out.line = series.mark != Mark::rings;
  out.mark = series.mark == Mark::rings ? drawing::Mark::ring : drawing::Mark::none;
  out.colour = series.mark == Mark::guide ? -1 : series.mark == Mark::rings ? 1 : 0;
  out.broken = series.mark == Mark::guide;
  out.label = series.label;
  return out;
}

}  // namespace

std::string svg(const Figure& figure) {
  drawing::Chart chart;
  chart.title = figure.title;
  chart.x = {figure.x_label, figure.log_x};
  chart.y = {figure.y_label, figure.log_y};
  chart.true_to_scale = figure.equal_axes;
  bool exact = false;
  bool ours = false;
  for (const Series& series : figure.series) {
    chart.series.push_back(drawn(series));
    bool& named = series.mark == Mark::rings ? ours : exact;
    if (series.mark == Mark::guide || named) continue;
    named = true;
    chart.series.back().name = series.mark == Mark::rings ? "endowire" : "closed form";
  }
  return drawing::svg({chart});
}

}  // namespace endowire::test
