// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/studies/motion.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/projection/penetration_tracker.h"
#include "problems/output/gnuplot.h"
#include "problems/output/json_text.h"
#include "problems/output/metric_color.h"
#include "problems/output/text.h"

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;

// Told apart by width and dash without any colour; thin lines come later and
// stay visible on top of wide ones.
constexpr std::array<const char*, 5> kLineStyles = {"lw 5", "lw 3 dt (9,5)",
                                                    "lw 1.3", "lw 1.8 dt (2,3)",
                                                    "lw 1.8 dt (12,4,2,4)"};

std::string DataBlock(const MotionTrace& trace, std::size_t number) {
  std::string block = "$trace" + std::to_string(number) + " << EOD\n";
  for (std::size_t i = 0; i < trace.pd.size(); ++i) {
    const Eigen::Vector3d& pd = trace.pd[i];
    block += std::to_string(i);
    for (const double value : {pd.x(), pd.y(), pd.z(), pd.norm()}) {
      block += ' ' + FormatDouble(value);
    }
    block += '\n';
  }
  return block + "EOD\n";
}

}  // namespace

Eigen::Vector3d StraightMotion::At(int frame) const {
  if (frame == 0) return from;
  if (frame == frames - 1) return to;
  const double t = static_cast<double>(frame) / (frames - 1);
  return from + t * (to - from);
}

MotionTrace TraceMotion(const PenetrationMetric& metric,
                        const StraightMotion& motion, std::string name,
                        std::string label) {
  MotionTrace trace;
  trace.metric = std::move(name);
  trace.label = std::move(label);
  Branch branch;
  for (int frame = 0; frame < motion.frames; ++frame) {
    const Eigen::Vector3d q = motion.At(frame);
    trace.results.push_back(metric.Query(q, branch));
    trace.status.push_back(trace.results.back().status);
    trace.pd.push_back(trace.results.back().PenetrationVector(q));
    branch = trace.results.back().branch;
  }
  return trace;
}

MotionSummary Summarize(const MotionTrace& trace, double jump_length) {
  MotionSummary summary;
  for (std::size_t i = 0; i < trace.pd.size(); ++i) {
    const PenetrationResult& result = trace.results[i];
    summary.inside += result.inside ? 1 : 0;
    summary.branch_ends += result.status == QueryStatus::kBranchEnded ? 1 : 0;
    summary.fallbacks +=
        result.status == QueryStatus::kEuclideanFallback ? 1 : 0;
    summary.sliding += trace.status[i] == QueryStatus::kSliding ? 1 : 0;
    summary.left_elsewhere +=
        trace.status[i] == QueryStatus::kLeftElsewhere ? 1 : 0;
    summary.max_magnitude = std::max(summary.max_magnitude, trace.pd[i].norm());
    if (i == 0) continue;
    const double change = (trace.pd[i] - trace.pd[i - 1]).norm();
    summary.largest_change = std::max(summary.largest_change, change);
    summary.jumps += change > jump_length ? 1 : 0;
  }
  return summary;
}

std::string MotionCsv(const std::vector<MotionTrace>& traces) {
  std::string csv = "frame,metric,status,pd_x,pd_y,pd_z,magnitude\n";
  const std::size_t frames = traces.empty() ? 0 : traces.front().pd.size();
  for (std::size_t i = 0; i < frames; ++i) {
    for (const MotionTrace& trace : traces) {
      csv += std::to_string(i) + ',' + trace.metric + ',' +
             ToString(trace.status[i]) + ',' + FormatPoint(trace.pd[i]) + ',' +
             FormatDouble(trace.pd[i].norm()) + '\n';
    }
  }
  return csv;
}

std::string MotionJson(const StraightMotion& motion,
                       const std::vector<MotionTrace>& traces) {
  const auto point = [](const Eigen::Vector3d& v) {
    return Json({v[0], v[1], v[2]});
  };
  std::string lines;
  for (int frame = 0; frame < motion.frames; ++frame) {
    const auto i = static_cast<std::size_t>(frame);
    for (const MotionTrace& trace : traces) {
      const Json row = {
          {"frame", frame},           {"position", point(motion.At(frame))},
          {"metric", trace.metric},   {"status", ToString(trace.status[i])},
          {"pd", point(trace.pd[i])}, {"magnitude", trace.pd[i].norm()}};
      lines += JsonText(row) + '\n';
    }
  }
  return lines;
}

std::string MotionPage(const std::vector<MotionTrace>& traces,
                       const std::string& title) {
  std::string script;
  std::vector<std::string> labels;
  for (std::size_t k = 0; k < traces.size(); ++k) {
    script += DataBlock(traces[k], k);
    labels.push_back(traces[k].label);
  }
  const std::vector<std::string> colors = LineColors(labels);
  script += "set multiplot layout 4,1 title " + GnuplotText(title) +
            " noenhanced font ',16' margins 0.11,0.97,0.07,0.89 "
            "spacing 0,0.025\n"
            "set grid lc rgb '#DDDDDD'\nset offsets 0,0,graph 0.08,graph "
            "0.08\nset xzeroaxis lc rgb '#888888'\nset format x ''\n";
  const std::array<const char*, 4> names = {
      "x of PD [length]", "y of PD [length]", "z of PD [length]",
      "|PD| [length]"};
  for (std::size_t panel = 0; panel < names.size(); ++panel) {
    script += std::string("set ylabel '") + names[panel] + "' offset 1,0\n";
    script += panel == 0
                  ? "set key at screen 0.54,0.93 center center horizontal "
                    "samplen 5 width 2 noenhanced\n"
                  : "unset key\n";
    if (panel + 1 == names.size()) {
      script += "set format x '%g'\nset xlabel 'frame'\n";
    }
    script += "plot ";
    for (std::size_t k = 0; k < traces.size(); ++k) {
      script += (k == 0 ? "$trace" : ", $trace") + std::to_string(k) +
                " using 1:" + std::to_string(panel + 2) +
                " with lines lc rgb '" + colors[k] + "' " +
                kLineStyles[k % kLineStyles.size()] + " title " +
                GnuplotText(traces[k].label);
    }
    script += '\n';
  }
  return RenderSvg(script + "unset multiplot\n", 900, 1000);
}

}  // namespace phongpd
