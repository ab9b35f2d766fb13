// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/optimize_flags.h"

#include "problems/cli/command.h"
#include "problems/cli/flags.h"

namespace phongpd::cli {

void AddMetricFlags(CLI::App* app, OptimizeFlags* flags) {
  app->add_option(
         "--metric", flags->metric,
         "Penetration depth inside obstacles (scene's own if not set); "
         "smoothed: the Euclidean depth, and as direction the gradient of "
         "occupancy smoothed over twice the smoothing length, at the position "
         "(smoothed-foot: at the contact)")
      ->check(CLI::IsMember(MetricNames()));
  app->add_option("--smoothing-length", flags->smoothing_length,
                  "Of the Phong field, 0 (the paper) to D, or of the smoothed "
                  "metrics, above 0; D is the diagonal of the "
                  "obstacles' contact space: 0.1 or 0.1D is a share of D, "
                  "0.5unit is in the scene's unit; where that has a name, "
                  "20mm and 20 are in it (scene's own if not set)")
      ->type_name("LENGTH");
  app->add_option("--margin", flags->margin,
                  "Distance to keep, more than 0 and at most D, told like "
                  "--smoothing-length; a share above 0.1 has to say D "
                  "(scene's own if not set)")
      ->type_name("LENGTH");
  app->add_flag("--require", flags->require,
                "Less than the margin is no answer: status_class "
                "clearance_missed, exit code 1");
  app->add_option("--jacobian", flags->jacobian,
                  "Of Phong depth (the others have direction alone): its "
                  "continuous direction, or the exact gradient (scene's own if "
                  "not set)")
      ->check(CLI::IsMember({"direction", "exact"}));
}

void AddStartFlags(CLI::App* app, OptimizeFlags* flags) {
  app->add_option("--start", flags->start,
                  "First path: the line, or if it collides the path of the "
                  "complete planner (repaired and planner mean the same)")
      ->check(CLI::IsMember({"straight", "repaired", "planner"}))
      ->capture_default_str();
  app->add_option("--start-noise", flags->noise,
                  "Of the waypoints of a straight start, as a fraction of its "
                  "length")
      ->check(Between(0, 10))
      ->type_name("F")
      ->capture_default_str();
  app->add_option("--routes", flags->routes,
                  "Ways around the obstacles to optimise, 1 to 8 (preset's own "
                  "if not set)")
      ->check(Between(1, 8))
      ->type_name("N");
  app->add_flag("--line,!--no-line", flags->line,
                "Optimise from the colliding line as well as from the "
                "repaired start, or not (preset's own if not set)");
}

void AddSolverFlags(CLI::App* app, OptimizeFlags* flags) {
  app->add_option("--rows", flags->rows, "Constraint rows a sample, 1 to 8")
      ->check(Between(1, 8))
      ->type_name("K")
      ->capture_default_str();
  app->add_option("--mu-strategy", flags->mu_strategy, "Ipopt's own")
      ->check(CLI::IsMember({"adaptive", "monotone"}))
      ->capture_default_str();
  app->add_option("--polish", flags->polish,
                  "Corridor polish: never, where Ipopt did not converge to a "
                  "free path, or always (preset's own if not set)")
      ->check(CLI::IsMember({"never", "needed", "always"}));
  app->add_flag("--per-obstacle", flags->per_obstacle,
                "One contact space for each obstacle instead of a merged one");
}

void AddOutputFlags(CLI::App* app, OptimizeFlags* flags) {
  AddRowOutput(app, flags);
  CLI::Option* const output = app->get_option("--output");
  output->description(output->get_description() +
                      ". With --limits Bézier pieces as JSON, rows in time as "
                      "FILE.csv or, for ROS 2, FILE.yaml (joints x, y, z) or "
                      "FILE.multidof.yaml, lines as FILE.gcode; of several "
                      "robots one FILE.ID.csv or .yaml each");
  AddPictures(app, flags);
}

}  // namespace phongpd::cli
