// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <string>
#include <vector>

#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "problems/cli/command.h"
#include "problems/cli/contact_space_file.h"
#include "problems/output/output_files.h"
#include "problems/output/points_csv.h"
#include "problems/output/text.h"

namespace phongpd::cli {
namespace {

struct Flags {
  std::string contact_space;
  std::string points;
  std::string output;
  std::string metric = "phong";
  std::string field = "normal";
  std::string smoothing_length = "0";
  std::string jacobian = "exact";
  bool tracked = false;
};

std::unique_ptr<PenetrationMetric> MakeMetric(const Flags& flags,
                                              const ContactSpace& contact) {
  if (flags.metric == "euclidean") {
    return std::make_unique<EuclideanMetric>(contact);
  }
  return std::make_unique<PhongMetric>(
      contact,
      MetricOptions(flags.field,
                    ParseLength(flags.smoothing_length, "--smoothing-length"),
                    contact));
}

std::string Row(const Eigen::Vector3d& q, const PenetrationResult& result,
                bool exact_gradient) {
  return FormatPoint(q) + ',' + StatusName(result.status) + ',' +
         (result.inside ? "1," : "0,") + FormatDouble(result.signed_distance) +
         ',' + FormatPoint(result.contact) + ',' +
         FormatPoint(result.direction) + ',' +
         FormatPoint(exact_gradient ? result.gradient : result.direction) +
         ',' + std::to_string(result.triangle) + '\n';
}

int Query(const Flags& flags) {
  OutputFiles outputs;
  outputs.Declare(flags.output);
  const std::vector<Eigen::Vector3d> points = ReadPointsCsv(flags.points);
  const ContactSpace contact = LoadContactSpace(flags.contact_space);
  Progress("building the metric");
  const std::unique_ptr<PenetrationMetric> metric = MakeMetric(flags, contact);

  std::string csv =
      "x,y,z,status,inside,signed_distance,contact_x,contact_y,contact_z,"
      "direction_x,direction_y,direction_z,gradient_x,gradient_y,gradient_z,"
      "triangle\n";
  std::size_t inside = 0;
  std::size_t not_ok = 0;
  Branch branch;
  for (const Eigen::Vector3d& q : points) {
    const PenetrationResult result = metric->Query(q, branch);
    if (flags.tracked) branch = result.branch;
    inside += result.inside ? 1 : 0;
    not_ok += result.status == QueryStatus::kOk ? 0 : 1;
    csv += Row(q, result, flags.jacobian == "exact");
  }
  outputs.Write(flags.output, csv);
  CommitAndTell(&outputs, flags.output + ": " + std::to_string(points.size()) +
                              " points, " + std::to_string(inside) +
                              " inside, " + std::to_string(not_ok) +
                              " with another status than ok\n");
  TellIfTaken(flags.contact_space);
  return kDone;
}

}  // namespace

Command AddQuery(CLI::App* app) {
  auto flags = std::make_shared<Flags>();
  AddContactSpaceFile(app, &flags->contact_space)->required();
  app->add_option("--points", flags->points, "CSV file with the columns x,y,z")
      ->required()
      ->type_name("FILE");
  app->add_option("--output", flags->output, "CSV file, one row a point")
      ->required()
      ->type_name("FILE");
  app->add_option("--metric", flags->metric)
      ->check(CLI::IsMember({"phong", "euclidean"}))
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
                "Carry the branch from row to row (phong only)");
  return [flags] { return Query(*flags); };
}

}  // namespace phongpd::cli
