// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/mesh/counted.h"
#include "core/projection/query_batch.h"
#include "planners/world/penetration_spec.h"
#include "problems/cli/command.h"
#include "problems/cli/contact_space_file.h"
#include "problems/cli/flags.h"
#include "problems/output/json_text.h"
#include "problems/output/output_files.h"
#include "problems/output/points_csv.h"
#include "problems/output/text.h"
#include "problems/studies/sliding.h"
#include "viewer/page_numbers.h"

namespace phongpd::cli {
namespace {

using internal::PointJson;
using Json = nlohmann::ordered_json;

struct QueryFlags {
  std::string contact_space;
  std::string points;
  std::string output;
  std::string metric = "phong";
  std::string field = "normal";
  std::string smoothing_length = FormatDouble(kDefaultSmoothingLength);
  std::string jacobian = "exact";
  bool tracked = false;
  bool json = false;
  PenetrationTrackerOptions sliding;
};

constexpr char kSliding[] = "sliding";

// What --metric names: one of those that rows of an optimiser follow, or, none,
// the tracker.
std::optional<MetricKind> MetricOf(const QueryFlags& flags) {
  if (flags.metric == kSliding) return std::nullopt;
  return ParseMetricKind(flags.metric, "--metric");
}

std::shared_ptr<const PenetrationMetric> MakeMetric(
    const QueryFlags& flags, MetricKind kind, const ContactSpace& contact) {
  PenetrationSpec spec;
  spec.metric = kind;
  spec.field = ParseFieldKind(flags.field, "--field");
  if (HasLength(spec.metric)) {
    const std::string what = "--smoothing-length";
    spec.smoothing_length = ParseLength(flags.smoothing_length, what);
    RequireLength(spec.smoothing_length, LengthRangeOf(spec.metric),
                  contact.length(), what);
  }
  try {
    return MakePenetrationMetric(contact, spec.Options(contact.length()));
  } catch (const InputError& error) {
    throw InputError(flags.contact_space + ": " + error.what());
  }
}

// Refuses what would be ignored, or not what it says.
void RequireSense(const CLI::App& app, const QueryFlags& flags,
                  std::optional<MetricKind> kind) {
  if (!kind) {
    if (!flags.tracked) {
      throw InputError(
          "--metric sliding: expected --tracked, for its contact depends on "
          "the rows before, found none");
    }
    flags.sliding.Validate();
    return;
  }
  for (const char* flag : {"--slide-ratio", "--slide-speed"}) {
    if (app.count(flag) > 0) {
      throw InputError(std::string(flag) +
                       ": expected with --metric sliding, found with " +
                       ToString(*kind));
    }
  }
}

struct Answers {
  std::vector<PenetrationResult> results;
  std::vector<QueryStatus> statuses;
};

// Those of a sequence one after the other, all others on all cores.
Answers Ask(const QueryFlags& flags, std::optional<MetricKind> kind,
            const ContactSpace& contact,
            const std::vector<Eigen::Vector3d>& points) {
  Answers answers;
  answers.statuses.reserve(points.size());
  if (!kind) {
    SlidingQuery query(contact, flags.sliding);
    for (const Eigen::Vector3d& q : points) {
      ProgressOf("points", answers.results.size(), points.size());
      const SlidingAnswer answer = query.Next(q);
      answers.results.push_back(answer.result);
      answers.statuses.push_back(answer.status);
    }
    return answers;
  }
  const auto metric = MakeMetric(flags, *kind, contact);
  if (flags.tracked) {
    Branch branch;
    for (const Eigen::Vector3d& q : points) {
      ProgressOf("points", answers.results.size(), points.size());
      answers.results.push_back(metric->Query(q, branch));
      branch = answers.results.back().branch;
    }
  } else {
    constexpr std::size_t kBatch = 1 << 16;
    answers.results.resize(points.size());
    for (std::size_t i = 0; i < points.size(); i += kBatch) {
      ProgressOf("points", i, points.size());
      QueryBatch(*metric, &points[i], std::min(kBatch, points.size() - i),
                 &answers.results[i]);
    }
  }
  for (const PenetrationResult& result : answers.results) {
    answers.statuses.push_back(result.status);
  }
  return answers;
}

// Is that status an answer like any other?
bool IsUsual(QueryStatus status) {
  return status == QueryStatus::kOk || status == QueryStatus::kFollowing ||
         status == QueryStatus::kOutside;
}

constexpr char kQueryHeader[] =
    "x,y,z,status,inside,signed_distance,contact_x,contact_y,contact_z,"
    "direction_x,direction_y,direction_z,gradient_x,gradient_y,gradient_z,"
    "triangle\n";

std::string QueryRow(const Eigen::Vector3d& q, QueryStatus status,
                     const PenetrationResult& result, bool exact_gradient) {
  return FormatPoint(q) + ',' + ToString(status) + ',' +
         (result.inside ? "1," : "0,") + FormatDouble(result.signed_distance) +
         ',' + FormatPoint(result.contact) + ',' +
         FormatPoint(result.direction) + ',' +
         FormatPoint(exact_gradient ? result.gradient : result.direction) +
         ',' + std::to_string(result.triangle) + '\n';
}

// The same as one line of JSON.
std::string JsonRow(const Eigen::Vector3d& q, QueryStatus status,
                    const PenetrationResult& result, bool exact_gradient) {
  const Json row = {{"position", PointJson(q)},
                    {"status", ToString(status)},
                    {"inside", result.inside},
                    {"signed_distance", result.signed_distance},
                    {"contact", PointJson(result.contact)},
                    {"direction", PointJson(result.direction)},
                    {"gradient", PointJson(exact_gradient ? result.gradient
                                                          : result.direction)},
                    {"triangle", result.triangle}};
  return JsonText(row) + '\n';
}

int Query(const CLI::App& app, const QueryFlags& flags) {
  const std::optional<MetricKind> kind = MetricOf(flags);
  const bool is_exact =
      ParseJacobianKind(flags.jacobian, "--jacobian") == JacobianKind::kExact;
  RequireSense(app, flags, kind);
  const bool is_json = FormOf(flags.output, flags.json) == AnswerForm::kJson;
  const std::string target = AnswerTarget(flags.output);
  OutputFiles outputs;
  DeclareTable(&outputs, target, "--output");
  const std::vector<Eigen::Vector3d> points = ReadPointsCsv(flags.points);
  const ContactSpace contact = LoadContactSpace(flags.contact_space);
  Progress("building the metric");
  const Answers answers = Ask(flags, kind, contact, points);

  std::string text = is_json ? "" : kQueryHeader;
  std::size_t inside = 0;
  std::size_t unusual = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PenetrationResult& result = answers.results[i];
    const QueryStatus status = answers.statuses[i];
    inside += result.inside ? 1 : 0;
    unusual += IsUsual(status) ? 0 : 1;
    text += (is_json ? JsonRow : QueryRow)(points[i], status, result, is_exact);
  }
  outputs.Write(target, text);
  CommitAndTell(&outputs,
                (outputs.UseStandardOutput() ? "" : flags.output + ": ") +
                    Counted(points.size(), "point") + ", " +
                    std::to_string(inside) + " inside, " +
                    std::to_string(unusual) + " with another status than " +
                    (kind ? "ok" : "following or outside") + "\n");
  TellIfTaken(flags.contact_space);
  return kDone;
}

// Those that rows of an optimiser follow, and the tracker.
std::vector<std::string> QueryMetrics() {
  std::vector<std::string> names = MetricNames();
  names.emplace_back(kSliding);
  return names;
}

}  // namespace

Command AddQuery(CLI::App* app) {
  auto flags = std::make_shared<QueryFlags>();
  AddContactSpaceFile(app, &flags->contact_space)->required();
  app->add_option("--points", flags->points, "CSV file with the columns x,y,z")
      ->required()
      ->type_name("FILE");
  app->add_option("--output", flags->output,
                  "CSV file, one row a point (standard output if not set); "
                  "JSON Lines where its name ends in .json or .jsonl")
      ->type_name("FILE");
  AddJson(app, &flags->json, "JSON Lines instead of CSV, one object a point");
  app->add_option("--metric", flags->metric)
      ->description(
          "smoothed: the Euclidean depth; its direction the gradient of "
          "occupancy smoothed over twice the smoothing length at the point "
          "(smoothed-foot: at the contact).  sliding: a contact that does not "
          "jump inside, it slides over the "
          "contact surface along the motion that the rows are; needs "
          "--tracked.  Its "
          "status is following, sliding (the contact is on its way), outside, "
          "left_elsewhere (outside, the depth jumped to zero) or invalid; its "
          "gradient that with the contact held, equal to direction")
      ->check(CLI::IsMember(QueryMetrics()))
      ->capture_default_str();
  AddField(app, &flags->field);
  app->add_option("--smoothing-length", flags->smoothing_length,
                  kSmoothingLengthHelp)
      ->type_name("LENGTH")
      ->capture_default_str();
  app->add_option("--jacobian", flags->jacobian,
                  "What the gradient columns hold: the exact gradient of "
                  "signed_distance, or the direction")
      ->check(CLI::IsMember({"exact", "direction"}))
      ->capture_default_str();
  app->add_flag("--tracked", flags->tracked,
                "Carry the branch (phong) or the contact (sliding) from row to "
                "row");
  AddSliding(app, &flags->sliding);
  AddExamples(app, {"phongpd query --contact-space contact.pcs --points p.csv",
                    "phongpd query --contact-space contact.off --points p.csv "
                    "--tracked --smoothing-length 0.1 --output depth.csv",
                    "phongpd query --contact-space contact.pcs --points p.csv "
                    "--json | head -1"});
  return [app, flags] { return Query(*app, *flags); };
}

}  // namespace phongpd::cli
