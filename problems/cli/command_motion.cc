// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/mesh/counted.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "planners/exact/verification.h"
#include "problems/cli/command.h"
#include "problems/cli/contact_space_file.h"
#include "problems/cli/flags.h"
#include "problems/cli/operands.h"
#include "problems/meshes/operand_notes.h"
#include "problems/output/gnuplot.h"
#include "problems/output/output_files.h"
#include "problems/output/text.h"
#include "problems/studies/motion.h"
#include "problems/studies/sliding.h"
#include "viewer/view_page.h"

namespace phongpd::cli {
namespace {

// A change of PD between two frames that counts as a jump, in diagonals.
constexpr double kJump = 0.05;

struct MotionFlags {
  std::string contact_space;
  std::string robot;
  std::string obstacle;
  std::string repair = "reject";
  std::vector<std::string> from;
  std::vector<std::string> to;
  int frames = 0;
  std::vector<std::string> smoothing_lengths = {
      FormatDouble(kDefaultSmoothingLength)};
  std::string field = "normal";
  PenetrationTrackerOptions sliding;
  std::string output;
  std::string svg;
  std::string html;
  bool json = false;
  bool no_cache = false;
  bool verify = true;
};

// The two meshes, where they are given.
std::optional<Workspace> ReadSolids(const MotionFlags& flags) {
  if (!flags.contact_space.empty()) return std::nullopt;
  Workspace workspace;
  const Repair repair = ParseRepair(flags.repair, "--repair");
  workspace.robot = LoadSolid(flags.robot, repair);
  workspace.obstacles = {LoadSolid(flags.obstacle, repair)};
  return workspace;
}

ContactSpace ContactSpaceOf(const MotionFlags& flags,
                            const std::optional<Workspace>& solids) {
  if (!solids) return LoadContactSpace(flags.contact_space);
  return LoadOrBuild(solids->robot, solids->obstacles[0], {}, !flags.no_cache);
}

// Judges the depths of all frames again; returns a line for people.  Throws
// std::runtime_error for the first that is wrong.
std::string VerifyDepths(const Workspace& solids, const StraightMotion& motion,
                         const ContactSpace& contact,
                         const std::vector<MotionTrace>& traces) {
  const Verifier verifier(solids);
  int confirmed = 0, all = 0;
  for (const MotionTrace& trace : traces) {
    for (int frame = 0; frame < motion.frames; ++frame, ++all) {
      ProgressOf("verifying depths", static_cast<std::size_t>(all),
                 traces.size() * static_cast<std::size_t>(motion.frames));
      const auto i = static_cast<std::size_t>(frame);
      PenetrationResult result = trace.results[i];
      // On its way a contact need not be where PD itself leaves the surface.
      if (trace.status[i] == QueryStatus::kSliding) {
        result.direction =
            contact.normals()[static_cast<std::size_t>(result.triangle)];
      }
      const Verification found = verifier.VerifyDepth(motion.At(frame), result);
      confirmed += found.verdict == Verdict::kConfirmed ? 1 : 0;
      if (found.verdict != Verdict::kRefuted) continue;
      FailVerification(trace.metric + ", frame " + std::to_string(frame) +
                       ": " + found.reason);
    }
  }
  return "verified on the original solids: " + std::to_string(confirmed) +
         " of " + std::to_string(all) + " depths, the others within rounding\n";
}

std::vector<Length> SmoothingLengths(const MotionFlags& flags) {
  std::vector<Length> lengths;
  std::set<std::string> seen;
  for (const std::string& text : flags.smoothing_lengths) {
    lengths.push_back(
        LengthFlag(text, "--smoothing-length", LengthRange::kFromZero));
    if (!seen.insert(lengths.back().Text()).second) {
      throw InputError("--smoothing-length: expected different values, found " +
                       text + " twice");
    }
  }
  return lengths;
}

std::vector<MotionTrace> Trace(const MotionFlags& flags,
                               const ContactSpace& contact,
                               const std::vector<Length>& lengths,
                               const StraightMotion& motion) {
  std::vector<MotionTrace> traces;
  Progress("following euclidean");
  traces.push_back(TraceMotion(EuclideanMetric(contact), motion, "euclidean",
                               "Euclidean PD"));
  for (const Length& length : lengths) {
    const PhongMetricOptions options =
        MetricOptions(flags.field, length, contact);
    const std::string value = length.Text();
    const std::string name = lengths.size() == 1 ? "phong" : "phong@" + value;
    Progress("following " + name);
    traces.push_back(TraceMotion(PhongMetric(contact, options), motion, name,
                                 "PhongPD, ℓ = " + value));
  }
  Progress("following sliding");
  traces.push_back(TraceSliding(contact, flags.sliding, motion));
  return traces;
}

std::string Summary(const MotionFlags& flags,
                    const std::vector<MotionTrace>& traces, double diagonal) {
  TextStream text;
  for (const MotionTrace& trace : traces) {
    const MotionSummary s = Summarize(trace, kJump * diagonal);
    text << trace.metric << ": " << s.inside << " of " << flags.frames
         << " frames inside, |PD| up to " << FormatDouble(s.max_magnitude)
         << ", largest change " << FormatDouble(s.largest_change) << ", "
         << Counted(s.jumps, "jump") << " > " << Rounded(kJump * diagonal)
         << " (5 % of the diagonal), ";
    if (trace.is_sliding) {
      text << Counted(s.sliding, "frame") << " sliding, "
           << Counted(s.left_elsewhere, "exit") << " elsewhere\n";
    } else {
      text << Counted(s.branch_ends, "branch end") << ", "
           << Counted(s.fallbacks, "Euclidean fallback") << '\n';
    }
  }
  return text.str();
}

// The robot is a point where only the contact space is given.
View MotionView(const ContactSpace& contact,
                const std::optional<Workspace>& solids,
                const StraightMotion& motion,
                const std::vector<MotionTrace>& traces) {
  View view;
  view.title = "Penetration depth along a motion";
  view.meshes = {{"contact space", ViewRole::kContactSpace, contact.mesh()}};
  if (solids) {
    view.robot = solids->robot;
    for (const Solid& obstacle : solids->obstacles) {
      view.meshes.push_back(
          {obstacle.name(), ViewRole::kObstacle, obstacle.mesh()});
    }
  } else {
    view.notes = {
        "The robot is drawn as a ball: with --robot and --obstacle it would "
        "be itself."};
  }
  for (int frame = 0; frame < motion.frames; ++frame) {
    view.motion.positions.push_back(motion.At(frame));
  }
  for (const MotionTrace& trace : traces) {
    std::vector<std::string> status;
    for (const QueryStatus one : trace.status) status.push_back(ToString(one));
    view.motion.traces.push_back({trace.label, trace.pd, status});
  }
  return view;
}

int Follow(const MotionFlags& flags) {
  const bool pair = !flags.robot.empty() && !flags.obstacle.empty();
  const bool either = !flags.robot.empty() || !flags.obstacle.empty();
  if (either != pair || either == !flags.contact_space.empty()) {
    throw InputError(
        "motion: expected --contact-space, or --robot and --obstacle, found " +
        std::string(!flags.contact_space.empty() ? "both"
                    : flags.robot.empty()        ? "no --robot"
                                                 : "no --obstacle"));
  }
  if (flags.frames < 2) {
    throw InputError("--frames: expected at least 2, found " +
                     std::to_string(flags.frames));
  }
  StraightMotion motion;
  motion.from = ParsePoint(flags.from, "--from");
  motion.to = ParsePoint(flags.to, "--to");
  motion.frames = flags.frames;
  const std::vector<Length> lengths = SmoothingLengths(flags);
  flags.sliding.Validate();
  const bool is_json = FormOf(flags.output, flags.json) == AnswerForm::kJson;
  const std::string target = AnswerTarget(flags.output);
  OutputFiles outputs;
  DeclareTable(&outputs, target, "--output");
  DeclareIfNamed(&outputs, flags.html, "--html", {".html", ".htm"});
  DeclareIfNamed(&outputs, flags.svg, "--svg", {".svg"});
  if (!flags.html.empty()) RequireViewer();
  if (!flags.svg.empty()) RequireGnuplot();

  const std::optional<Workspace> solids = ReadSolids(flags);
  const ContactSpace contact = ContactSpaceOf(flags, solids);
  const std::vector<MotionTrace> traces =
      Trace(flags, contact, lengths, motion);
  std::string verified;
  if (solids && flags.verify)
    verified = VerifyDepths(*solids, motion, contact, traces);
  outputs.Write(target,
                is_json ? MotionJson(motion, traces) : MotionCsv(traces));
  if (!flags.svg.empty()) {
    outputs.Write(flags.svg,
                  MotionPage(traces, "Penetration depth from (" +
                                         FormatPoint(motion.from) + ") to (" +
                                         FormatPoint(motion.to) + ")"));
  }
  if (!flags.html.empty()) {
    outputs.Write(flags.html,
                  ViewPage(MotionView(contact, solids, motion, traces)));
  }
  CommitAndTell(&outputs, Summary(flags, traces, contact.length()) + verified);
  if (!solids) TellIfTaken(flags.contact_space);
  return kDone;
}

}  // namespace

Command AddMotion(CLI::App* app) {
  auto flags = std::make_shared<MotionFlags>();
  AddContactSpaceFile(app, &flags->contact_space);
  app->add_option("--robot", flags->robot,
                  "Or: mesh of the translating robot ...")
      ->type_name("FILE");
  app->add_option("--obstacle", flags->obstacle,
                  "... and mesh of the fixed obstacle")
      ->type_name("FILE");
  AddRepair(app, &flags->repair);
  app->add_option("--from", flags->from, "First robot position")
      ->required()
      ->expected(3)
      ->delimiter(',')
      ->type_name("X Y Z");
  app->add_option("--to", flags->to, "Last robot position")
      ->required()
      ->expected(3)
      ->delimiter(',')
      ->type_name("X Y Z");
  app->add_option("--frames", flags->frames, "Number of positions, at least 2")
      ->required()
      ->type_name("N");
  app->add_option("--smoothing-length", flags->smoothing_lengths,
                  std::string(kSmoothingLengthHelp) +
                      ". Several values give the metrics phong@VALUE instead "
                      "of phong")
      ->expected(1, -1)
      ->type_name("LENGTH")
      ->capture_default_str();
  AddField(app, &flags->field);
  AddSliding(app, &flags->sliding);
  app->add_option("--output", flags->output,
                  "CSV file, one row a frame and metric (standard output if "
                  "not set); JSON Lines where its name ends in .json or .jsonl")
      ->type_name("FILE");
  AddJson(app, &flags->json,
          "JSON Lines instead of CSV, with the position of every frame");
  app->add_option("--svg", flags->svg,
                  "Plot of x, y, z and magnitude (needs gnuplot)")
      ->type_name("FILE");
  app->add_option("--html", flags->html,
                  "Page with the moving robot and the arrow of PD, a picture "
                  "for each metric side by side (as view makes it)")
      ->type_name("FILE");
  AddVerify(app, &flags->verify);
  AddNoCache(app, &flags->no_cache);
  AddExamples(
      app, {"phongpd motion --robot robot.off --obstacle wrench.stl --from 0 "
            "-1 0 --to 0 1 0 --frames 400",
            "phongpd motion --contact-space contact.pcs --from 0 -1 0 --to 0 "
            "1 0 --frames 400 --smoothing-length 0 0.1 --output motion.csv "
            "--svg motion.svg"});
  return [flags] { return Follow(*flags); };
}

}  // namespace phongpd::cli
