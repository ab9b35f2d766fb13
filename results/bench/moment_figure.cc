// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/moment_figure.h"

#include "problems/output/gnuplot.h"
#include "problems/output/text.h"

namespace phongpd::bench {
namespace {

// "y z" of a point as gnuplot data.
std::string Row(const Eigen::Vector3d& p) {
  return FormatDouble(p.y()) + ' ' + FormatDouble(p.z()) + '\n';
}

// The cut of a mesh with the plane x = `x`, as line segments.
std::string CutAt(const TriangleMesh& mesh, double x) {
  std::string data;
  for (const Triangle& triangle : mesh.triangles) {
    std::vector<Eigen::Vector3d> ends;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = [&](std::size_t corner) {
        return mesh.vertices[static_cast<std::size_t>(triangle[corner % 3])];
      };
      const Eigen::Vector3d a = at(k);
      const Eigen::Vector3d b = at(k + 1);
      if ((a.x() < x) == (b.x() < x)) continue;
      ends.emplace_back(a + (x - a.x()) / (b.x() - a.x()) * (b - a));
    }
    if (ends.size() == 2) data += Row(ends[0]) + Row(ends[1]) + '\n';
  }
  return data;
}

std::string Block(const std::string& name, const std::string& data) {
  return "$" + name + " << EOD\n" + data + "EOD\n";
}

std::string Arrows(const StraightMotion& motion, const MotionTrace& trace) {
  std::string data;
  for (int frame = 0; frame < motion.frames; ++frame) {
    const Eigen::Vector3d& pd = trace.pd[static_cast<std::size_t>(frame)];
    const Eigen::Vector3d q = motion.At(frame);
    data += FormatDouble(q.y()) + ' ' + FormatDouble(q.z()) + ' ' +
            FormatDouble(pd.y()) + ' ' + FormatDouble(pd.z()) + '\n';
  }
  return data;
}

}  // namespace

std::string MomentFigure(const PaperBenchmark& benchmark,
                         const TriangleMesh& contact,
                         const StraightMotion& motion,
                         const std::vector<MotionTrace>& traces) {
  const double x = motion.from.x();
  std::string script =
      Block("obstacle", CutAt(benchmark.obstacle, x)) +
      Block("contact", CutAt(contact, x)) +
      Block("first", CutAt(Translated(benchmark.robot, motion.from), x)) +
      Block("last", CutAt(Translated(benchmark.robot, motion.to), x));
  for (std::size_t k = 0; k < traces.size(); ++k) {
    script += Block("pd" + std::to_string(k), Arrows(motion, traces[k]));
  }
  script += "set multiplot layout 1," + std::to_string(traces.size()) +
            " title 'Pushed over the handle of the wrench: PD at consecutive "
            "frames (cut x = " +
            FormatDouble(x) +
            ")' font ',16'\n"
            "set size ratio -1\nset xrange [-1.13:1.13]\n"
            "set yrange [-1.13:1.13]\nset xlabel 'y [length]'\n"
            "set ylabel 'z [length]'\nset key bottom center outside "
            "horizontal maxcols 2 samplen 3\n";
  for (std::size_t k = 0; k < traces.size(); ++k) {
    const std::string number = std::to_string(k);
    script += "set title '" + traces[k].label +
              "' noenhanced\n"
              "plot $obstacle w l lc rgb '#404040' lw 3 t 'obstacle', "
              "$contact w l lc rgb '#909090' lw 2 dt (7,4) t 'contact space', "
              "$first w l lc rgb '#B8D0E8' lw 1.5 t 'robot, first', "
              "$last w l lc rgb '#E8C8A0' lw 1.5 t 'robot, last', "
              "$pd" +
              number +
              " u 1:2:3:4 w vectors head filled size 0.05,20 lw 1.3 lc rgb "
              "'#0060B0' t 'PD', $pd" +
              number +
              " u 1:2 w p pt 7 ps 0.35 lc rgb '#000000' t 'robot centre'\n";
  }
  return RenderSvg(script + "unset multiplot\n", 1250, 520);
}

}  // namespace phongpd::bench
