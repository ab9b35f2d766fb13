// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/output/step_figure.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "problems/output/gnuplot.h"
#include "problems/output/metric_color.h"
#include "problems/output/text.h"

namespace phongpd {
namespace {

// The others' colours are Okabe and Ito's, and two of Tol's.
std::string LineStyle(StepCurve::Role role, std::size_t* others) {
  if (role == StepCurve::Role::kBaseline)
    return std::string("lc rgb '") + kEuclideanColor + "' lw 2 dt (10,4)";
  if (role == StepCurve::Role::kMain)
    return std::string("lc rgb '") + kPhongColor + "' lw 4";
  constexpr std::array<const char*, 8> kCurveColors = {
      "#E69F00", "#009E73", "#CC79A7", "#56B4E9",
      "#000000", "#882255", "#999933", "#888888"};
  constexpr std::array<const char*, 3> kDashes = {"1", "(4,3)", "(12,4,2,4)"};
  const std::size_t k = (*others)++;
  return std::string("lc rgb '") + kCurveColors[k % kCurveColors.size()] +
         "' lw 1.8 dt " + kDashes[k % kDashes.size()];
}

std::string ColorOf(const std::string& style) {
  return style.substr(style.find('#'), 7);
}

// At x.
double HeightOf(const StepCurve& curve, double x) {
  double height = 0.0;
  for (const auto& [at, to] : curve.points) {
    if (at <= x) height = to;
  }
  return height;
}

// Where half of its steps are done; 0 without any.
double MiddleOf(const StepCurve& curve) {
  const std::size_t count = curve.points.size();
  return count == 0 ? 0.0 : curve.points[count / 2].first;
}

// Their names beside the ends of the curves, evenly apart.
std::string CurveLabels(const std::vector<StepCurve>& curves,
                        const std::vector<std::string>& styles, double end) {
  std::vector<std::size_t> order(curves.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(
      order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
        const double a = HeightOf(curves[i], end);
        const double b = HeightOf(curves[j], end);
        return a != b ? a > b : MiddleOf(curves[i]) < MiddleOf(curves[j]);
      });
  TextStream script;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const StepCurve& curve = curves[order[i]];
    const std::string color = ColorOf(styles[order[i]]);
    const double height = 0.96 - 0.062 * static_cast<double>(i);
    script << "set arrow from " << end << ',' << HeightOf(curve, end)
           << " to graph 1.025, graph " << height << " nohead lc rgb '" << color
           << "' lw 0.7\nset label " << GnuplotText(curve.name)
           << " at graph 1.03, graph " << height << " left noenhanced tc rgb '"
           << color << "'\n";
  }
  return script.str();
}

}  // namespace

std::string StepFigure(const std::vector<StepCurve>& curves,
                       const StepFrame& frame) {
  TextStream script;
  std::string plots;
  std::vector<std::string> styles;
  std::size_t others = 0, longest = 0;
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const StepCurve& curve = curves[k];
    script << "$m" << k << " << EOD\n" << FormatDouble(frame.least) << " 0\n";
    for (const auto& [x, y] : curve.points) {
      if (x > frame.most) break;
      script << FormatDouble(std::max(x, frame.least)) << ' ' << y << '\n';
    }
    script << frame.most << ' ' << HeightOf(curve, frame.most) << "\nEOD\n";
    styles.push_back(LineStyle(curve.role, &others));
    plots += (plots.empty() ? "plot $m" : ", $m") + std::to_string(k) +
             " using 1:2 with steps " + styles.back() + " notitle";
    longest = std::max(longest, curve.name.size());
  }
  // Names hold '@' and '_', which are markup to gnuplot.
  script << "set logscale x\nset xrange [" << frame.least << ':' << frame.most
         << "]\nset yrange [0:1.03]\nset ytics 0,0.2,1\nset rmargin "
         << 3 + 4 * std::max<std::size_t>(longest, 18) / 5
         << "\nset format x '%g'\n"
         << "set grid lc rgb '#DDDDDD'\n"
         << "set xlabel " << GnuplotText(frame.x) << " noenhanced\n"
         << "set ylabel " << GnuplotText(frame.y) << " noenhanced\n"
         << "set title " << GnuplotText(frame.title) << " noenhanced\n"
         << CurveLabels(curves, styles, frame.most) << plots << '\n';
  return RenderSvg(script.str(), 760, 440);
}

}  // namespace phongpd
