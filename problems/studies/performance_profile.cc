// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/studies/performance_profile.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/mesh/counted.h"
#include "core/projection/phong_field.h"
#include "problems/output/text.h"
#include "problems/pictures/gnuplot.h"
#include "problems/studies/trajectory_comparison.h"

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;

// The profile ends there.
constexpr double kLargest = 100.0;

// Of a curve: Euclidean PD black, the recommended metric thickest, the others
// apart for colour-blind readers (Okabe and Ito, and two of Tol's), by dash
// once more.
std::string LineStyle(const std::string& method, std::size_t* others) {
  if (method == "euclidean") return "lc rgb '#000000' lw 2 dt (10,4)";
  const std::string recommended =
      "phong@" + FormatDouble(kDefaultSmoothingLength);
  if (method == recommended) return "lc rgb '#0060B0' lw 4";
  constexpr std::array<const char*, 8> kColors = {
      "#E69F00", "#009E73", "#CC79A7", "#56B4E9",
      "#D55E00", "#882255", "#999933", "#888888"};
  constexpr std::array<const char*, 3> kDashes = {"1", "(4,3)", "(12,4,2,4)"};
  const std::size_t k = (*others)++;
  return std::string("lc rgb '") + kColors[k % kColors.size()] +
         "' lw 1.8 dt " + kDashes[k % kDashes.size()];
}

std::string ColorOf(const std::string& style) {
  return style.substr(style.find('#'), 7);
}

int MostProblems(const std::vector<ProfileCurve>& curves) {
  int most = 0;
  for (const ProfileCurve& curve : curves) {
    most = std::max(most, curve.problems);
  }
  return most;
}

// With the number of its problems, where others were asked more.
std::string NameOf(const ProfileCurve& curve, int most) {
  return curve.problems == most
             ? curve.method
             : curve.method + " (" + std::to_string(curve.problems) + ")";
}

// Their names beside the ends of the curves, evenly apart, the best on top.
std::string CurveLabels(const std::vector<ProfileCurve>& curves,
                        const std::vector<std::string>& styles) {
  std::vector<std::size_t> order(curves.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(
      order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
        return curves[i].Share(kLargest) > curves[j].Share(kLargest);
      });
  const int most = MostProblems(curves);
  TextStream script;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const ProfileCurve& curve = curves[order[i]];
    const std::string color = ColorOf(styles[order[i]]);
    const double height = 0.96 - 0.062 * static_cast<double>(i);
    script << "set arrow from " << kLargest << ',' << curve.Share(kLargest)
           << " to graph 1.025, graph " << height << " nohead lc rgb '" << color
           << "' lw 0.7\nset label " << GnuplotText(NameOf(curve, most))
           << " at graph 1.03, graph " << height << " left noenhanced tc rgb '"
           << color << "'\n";
  }
  return script.str();
}

}  // namespace

std::string PerformanceProfile(const std::vector<Json>& rows,
                               const std::string& protocol,
                               const std::string& measure) {
  const std::vector<ProfileCurve> curves =
      ProfileCurves(rows, protocol, measure);
  TextStream script;
  std::string plots;
  std::vector<std::string> styles;
  std::size_t others = 0;
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const ProfileCurve& curve = curves[k];
    script << "$m" << k << " << EOD\n1 0\n";
    for (const double ratio : curve.ratios) {
      if (ratio > kLargest) break;
      script << FormatDouble(ratio) << ' ' << curve.Share(ratio) << '\n';
    }
    script << kLargest << ' ' << curve.Share(kLargest) << "\nEOD\n";
    styles.push_back(LineStyle(curve.method, &others));
    plots += (plots.empty() ? "plot $m" : ", $m") + std::to_string(k) +
             " using 1:2 with steps " + styles.back() + " notitle";
  }
  // Names of methods hold '@', which is markup to gnuplot.
  script << "set logscale x\nset xrange [1:" << kLargest
         << "]\nset yrange [0:1.03]\nset ytics 0,0.2,1\nset rmargin 19\n"
         << "set grid lc rgb '#DDDDDD'\n"
         << "set xlabel '" << measure << " over the least of all methods'\n"
         << "set ylabel 'share of problems solved'\nset title "
         << GnuplotText(protocol + ", " +
                        Counted(MostProblems(curves), "problem") +
                        "; higher and further left is better")
         << " noenhanced\n"
         << CurveLabels(curves, styles) << plots << '\n';
  return RenderSvg(script.str(), 760, 440);
}

}  // namespace phongpd
