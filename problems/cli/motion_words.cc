// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/motion_words.h"

#include <utility>

#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "planners/world/bare_length.h"
#include "problems/cli/flags.h"

namespace phongpd::cli {
namespace {

using Eigen::Vector3d;

// "a,b,,c" at the commas.
std::vector<std::string> CutAt(char separator, const std::string& text) {
  std::vector<std::string> cells(1);
  for (const char c : text) {
    if (c == separator) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

// With the name of the unit behind numbers, 500mm, where it has one.
Vector3d ParseLimit(const std::string& text, const std::string& what,
                    const std::string& unit) {
  std::vector<std::string> cells = CutAt('/', text);
  if (cells.size() == 1) cells.resize(3, cells.front());
  if (cells.size() != 3) {
    throw InputError(what +
                     ": expected one number, or three as x/y/z, found '" +
                     text + "'");
  }
  Vector3d limit;
  for (int axis = 0; axis < 3; ++axis) {
    std::string cell = cells[static_cast<std::size_t>(axis)];
    if (!unit.empty() && UnitNamedIn(cell) == unit) {
      cell.resize(cell.size() - unit.size());
    }
    const std::string which = what + " of " + "xyz"[axis];
    limit[axis] = ParseDouble(cell, which);
    if (limit[axis] > 0.0) continue;
    throw InputError(which + ": expected a number above 0, found " + cell);
  }
  return limit;
}

}  // namespace

MotionLimits ParseLimits(const std::string& text, const std::string& what,
                         const std::string& unit) {
  const std::vector<std::string> cells = CutAt(',', text);
  MotionLimits limits;
  limits.by_norm = cells.size() == 4 && cells[3] == "norm";
  if (cells.size() != 3 && !limits.by_norm) {
    throw InputError(what +
                     ": expected V,A,J, limits of velocity, acceleration and "
                     "jerk, each a number or x/y/z, or V,A,J,norm, found '" +
                     text + "'");
  }
  if (limits.by_norm && text.find('/') != std::string::npos) {
    throw InputError(what + ": expected one number each with norm, found '" +
                     text + "'");
  }
  limits.velocity = ParseLimit(cells[0], what + ": velocity", unit);
  limits.acceleration = ParseLimit(cells[1], what + ": acceleration", unit);
  limits.jerk = ParseLimit(cells[2], what + ": jerk", unit);
  return limits;
}

Via ParseVia(const std::string& text, const std::string& what, double diagonal,
             const std::string& unit) {
  const std::vector<std::string> cells = CutAt(',', text);
  if (cells.size() < 3 || cells.size() > 5) {
    throw InputError(what +
                     ": expected X,Y,Z[,LENGTH[,DWELL]], a place, how close to "
                     "come and seconds to rest there, found '" +
                     text + "'");
  }
  Via via;
  for (int axis = 0; axis < 3; ++axis) {
    via.point[axis] = ParseDouble(cells[static_cast<std::size_t>(axis)],
                                  what + ": " + "xyz"[axis]);
  }
  if (cells.size() > 3) {
    via.tolerance = ParseClearance(cells[3], what + ": LENGTH", diagonal, unit);
  }
  if (cells.size() > 4) via.dwell = ParseSeconds(cells[4], what + ": DWELL");
  return via;
}

CurveEnd ParseCurveEnd(const std::string& text, const std::string& what) {
  const std::vector<std::string> cells = CutAt(',', text);
  if (cells.size() != 3 && cells.size() != 6) {
    throw InputError(what +
                     ": expected VX,VY,VZ[,AX,AY,AZ], a velocity and an "
                     "acceleration, found '" +
                     text + "'");
  }
  CurveEnd end;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool is_velocity = i < 3;
    const auto axis = static_cast<Eigen::Index>(i % 3);
    Vector3d& vector = is_velocity ? end.velocity : end.acceleration;
    vector[axis] = ParseDouble(
        cells[i], what + ": " + (is_velocity ? "velocity" : "acceleration") +
                      " of " + "xyz"[axis]);
  }
  return end;
}

void AddMotion(CLI::App* app, const std::string& without_limits,
               const std::string& without_task, MotionWords* words) {
  app->add_option("--limits", words->limits,
                  "V,A,J: of velocity, acceleration and jerk, in the scene's "
                  "unit and seconds, each one number or x/y/z, of each axis; "
                  "V,A,J,norm: of the norm (" +
                      without_limits + ")")
      ->type_name("V,A,J[,norm]");
  app->add_option(
         "--via", words->via,
         "A place to pass on the way, again for the next one: LENGTH is "
         "how close to come, more than 0 and at most D (0.001D if not "
         "set; 0.01D is a share of D, 0.5unit in the scene's unit), "
         "DWELL seconds to rest there, at the place itself (" +
             without_task + ")")
      ->type_name("X,Y,Z[,LENGTH[,DWELL]]")
      ->allow_extra_args(false);
  app->add_option(
         "--duration", words->duration,
         "Seconds that the motion takes, with as little jerk as can be "
         "found; 0: as few as can be (" +
             without_task + ")")
      ->transform(SecondsFromZero())
      ->type_name("S");
  const auto add_end = [&](const char* flag, const std::string& verb,
                           std::string* text) {
    app->add_option(flag, *text,
                    "Velocity and acceleration with which the motion " + verb +
                        ", in the scene's unit and seconds (" + without_task +
                        ")")
        ->type_name("VX,VY,VZ[,AX,AY,AZ]");
  };
  add_end("--departure", "begins", &words->departure);
  add_end("--arrival", "ends", &words->arrival);
  app->add_option("--rate", words->rate,
                  "Rows a second of an --output FILE.csv or FILE.yaml, more "
                  "than 0 and at most 1e6 (100 if not set)")
      ->type_name("HZ");
}

std::optional<MotionLimits> LimitsOf(const MotionWords& words,
                                     const Scene& scene) {
  if (words.limits == "none") return std::nullopt;
  if (words.limits.empty()) return scene.limits;
  return ParseLimits(words.limits, "--limits", scene.workspace.unit);
}

void RequireNoMotion(const MotionWords& words) {
  for (const auto& [flag, is_given] :
       {std::pair("--rate", !words.rate.empty()),
        std::pair("--via", !words.via.empty()),
        std::pair("--duration", !words.duration.empty()),
        std::pair("--departure", !words.departure.empty()),
        std::pair("--arrival", !words.arrival.empty())}) {
    if (!is_given) continue;
    throw InputError(std::string(flag) +
                     ": expected --limits with it, found none");
  }
}

void SetTask(const MotionWords& words, Scene* scene) {
  if (!words.duration.empty()) {
    scene->duration = ParseSeconds(words.duration, "--duration");
  }
  if (!words.departure.empty()) {
    scene->departure = ParseCurveEnd(words.departure, "--departure");
  }
  if (!words.arrival.empty()) {
    scene->arrival = ParseCurveEnd(words.arrival, "--arrival");
  }
  if (words.via.empty()) return;
  scene->via.clear();
  const double diagonal = ContactBounds(scene->workspace).Diagonal();
  for (const std::string& text : words.via) {
    scene->via.push_back(
        ParseVia(text, "--via", diagonal, scene->workspace.unit));
  }
}

}  // namespace phongpd::cli
