// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/output/motion_file.h"

#include <charconv>
#include <cmath>
#include <functional>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "planners/world/length.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

constexpr double kGcodeTolerance = 0.01;  // mm
constexpr double kGcodeSeconds = 0.05;    // of a line
constexpr int kFinerTolerances = 10;      // by a quarter each
constexpr int kMostHalvings = 60;

std::string YamlPoint(const Vector3d& p) {
  return "[" + FormatDouble(p.x()) + ", " + FormatDouble(p.y()) + ", " +
         FormatDouble(p.z()) + "]\n";
}

std::string YamlXyz(const Vector3d& p) {
  return "{x: " + FormatDouble(p.x()) + ", y: " + FormatDouble(p.y()) +
         ", z: " + FormatDouble(p.z()) + "}";
}

struct RosSample {
  Vector3d position, velocity, acceleration;  // metres
};

// A message of ROS 2 in YAML: `head`, then what `text` says of each row, and
// its time.
std::string RosPoints(
    const Trajectory& trajectory, double rate, const std::string& unit,
    std::string head,
    const std::function<std::string(const RosSample&)>& text) {
  RequireUnit(unit, "ROS");
  const double metres = MetresOf(unit);
  if (trajectory.empty()) return head + "points: []\n";
  RequireFewRows(trajectory.duration(), rate);
  head += "points:\n";
  for (const Trajectory::Sample& sample : trajectory.Samples(rate)) {
    double seconds = std::floor(sample.time);
    double nanoseconds = std::round(1e9 * (sample.time - seconds));
    if (nanoseconds >= 1e9) {
      seconds += 1.0;
      nanoseconds = 0.0;
    }
    head += text({metres * sample.position, metres * sample.velocity,
                  metres * sample.acceleration}) +
            "  time_from_start: {sec: " +
            std::to_string(static_cast<long long>(seconds)) + ", nanosec: " +
            std::to_string(static_cast<long long>(nanoseconds)) + "}\n";
  }
  return head;
}

// In mm, as it is written: to 10 nm.
std::string Millimetres(double length) {
  char text[512];
  const auto end = std::to_chars(text, text + sizeof text, length,
                                 std::chars_format::fixed, 5);
  return {text, end.ptr};
}

struct Line {
  Vector3d end;  // mm, as it is written
  double seconds = 0.0;
};

Vector3d Written(const Vector3d& mm) {
  return mm.unaryExpr(
      [](double x) { return ParseDouble(Millimetres(x), "G-code"); });
}

// So that a part of the curve is no farther from its line than the tolerance,
// which is in the curve's own unit.
void Divide(const CurvePiece& piece, double tolerance, double to_mm,
            int halvings, std::vector<Line>* lines) {
  if (piece.Bend() > tolerance || piece.duration() > kGcodeSeconds) {
    if (halvings == kMostHalvings) {
      throw InputError("G-code: expected a curve whose coordinates tell " +
                       Rounded(tolerance * to_mm) + " mm apart, found one at " +
                       FormatPoint(piece.front()));
    }
    if (static_cast<double>(lines->size()) > kMostTimedRows) {
      throw InputError("G-code: expected at most " +
                       FormatDouble(kMostTimedRows) +
                       " lines for the motion, found more");
    }
    const auto halves = piece.Split(0.5);
    for (const CurvePiece& half : halves) {
      Divide(half, tolerance, to_mm, halvings + 1, lines);
    }
    return;
  }
  const Line line = {Written(to_mm * piece.back()), piece.duration()};
  // Less than is written; nothing leads to the first.
  if (lines->size() > 1 && lines->back().end == line.end) {
    lines->back().seconds += line.seconds;
  } else {
    lines->push_back(line);
  }
}

// The first is where it begins.
std::vector<Line> LinesWithin(const Trajectory& trajectory, double tolerance,
                              double to_mm) {
  std::vector<Line> lines = {
      {Written(to_mm * trajectory.pieces().front().front()), 0.0}};
  for (const CurvePiece& piece : trajectory.pieces()) {
    // A rest is a line of its own.
    const bool rests = piece.Bend() == 0.0 && piece.front() == piece.back();
    if (rests) {
      lines.push_back({lines.back().end, piece.duration()});
      continue;
    }
    Divide(piece, tolerance, to_mm, 0, &lines);
  }
  return lines;
}

bool AreFree(const FreeSpace& space, const std::vector<Line>& lines,
             double to_mm) {
  std::vector<Vector3d> path;
  for (const Line& line : lines) path.push_back(line.end / to_mm);
  return CheckPath(space, path).free;
}

std::string Words(const Vector3d& p) {
  return "X" + Millimetres(p.x()) + " Y" + Millimetres(p.y()) + " Z" +
         Millimetres(p.z());
}

}  // namespace

void RequireUnit(const std::string& unit, const std::string& what) {
  if (!unit.empty()) return;
  throw InputError(what +
                   ": expected a scene with a \"unit\", to know how long a "
                   "millimetre is, found none");
}

void RequireFewRows(double seconds, double rate) {
  if (seconds * rate <= kMostTimedRows) return;
  throw InputError("--rate: expected at most " + FormatDouble(kMostTimedRows) +
                   " rows for a motion that takes " + Rounded(seconds) +
                   " s at least, found " + FormatDouble(rate) + " Hz");
}

std::string TimedCsv(const Trajectory& trajectory, double rate) {
  std::string text = "t,x,y,z,vx,vy,vz,ax,ay,az\n";
  if (trajectory.empty()) return text;
  RequireFewRows(trajectory.duration(), rate);
  for (const Trajectory::Sample& sample : trajectory.Samples(rate)) {
    text += FormatDouble(sample.time) + ',' + FormatPoint(sample.position) +
            ',' + FormatPoint(sample.velocity) + ',' +
            FormatPoint(sample.acceleration) + '\n';
  }
  return text;
}

std::string RosTrajectory(const Trajectory& trajectory, double rate,
                          const std::string& unit, const std::string& robot) {
  const std::string of = robot.empty() ? "" : robot + "_";
  return RosPoints(trajectory, rate, unit,
                   "# trajectory_msgs/JointTrajectory, metres and seconds\n"
                   "joint_names: [" +
                       of + "x, " + of + "y, " + of + "z]\n",
                   [](const RosSample& s) {
                     return "- positions: " + YamlPoint(s.position) +
                            "  velocities: " + YamlPoint(s.velocity) +
                            "  accelerations: " + YamlPoint(s.acceleration);
                   });
}

std::string RosMultiDofTrajectory(const Trajectory& trajectory, double rate,
                                  const std::string& unit,
                                  const std::string& robot) {
  const auto twist = [](const char* name, const Vector3d& linear) {
    return std::string("  ") + name + ": [{linear: " + YamlXyz(linear) +
           ", angular: {x: 0, y: 0, z: 0}}]\n";
  };
  return RosPoints(
      trajectory, rate, unit,
      "# trajectory_msgs/MultiDOFJointTrajectory, metres and seconds\n"
      "joint_names: [" +
          robot + "]\n",
      [&twist](const RosSample& s) {
        return "- transforms: [{translation: " + YamlXyz(s.position) +
               ", rotation: {x: 0, y: 0, z: 0, w: 1}}]\n" +
               twist("velocities", s.velocity) +
               twist("accelerations", s.acceleration);
      });
}

std::string MotionGcode(const FreeSpace& space, const Trajectory& trajectory,
                        const std::string& unit) {
  RequireUnit(unit, "G-code");
  if (trajectory.empty()) return "; no motion\n";
  if (trajectory.duration() / kGcodeSeconds > kMostTimedRows) {
    throw InputError("G-code: expected a motion of at most " +
                     FormatDouble(kMostTimedRows * kGcodeSeconds) +
                     " s, found " + Rounded(trajectory.duration()) + " s");
  }
  const double to_mm = 1e3 * MetresOf(unit);
  double tolerance = kGcodeTolerance;
  std::vector<Line> lines;
  for (int i = 0;; ++i, tolerance *= 0.25) {
    lines = LinesWithin(trajectory, tolerance / to_mm, to_mm);
    if (AreFree(space, lines, to_mm)) break;
    if (i < kFinerTolerances) continue;
    throw InputError(
        "G-code: expected a curve whose lines to 10 nm are free, found one "
        "closer to contact");
  }
  std::string text =
      "; " + Rounded(trajectory.duration(), 6) + " s, " +
      std::to_string(lines.size() - 1) + " lines within " +
      Rounded(tolerance, 3) +
      " mm of the certified curve, free by the exact judge\n"
      "; begins at " +
      Words(lines.front().end) +
      ": nothing here leads there\n"
      "G21 ; mm\nG90 ; positions, not steps\nG94 ; mm a minute\n";
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const double length = (lines[i].end - lines[i - 1].end).norm();
    text += length > 0.0
                ? "G1 " + Words(lines[i].end) + " F" +
                      Millimetres(60.0 * length / lines[i].seconds) + "\n"
                : "G4 P" + FormatDouble(lines[i].seconds) + " ; s\n";
  }
  return text;
}

}  // namespace phongpd
