// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/contact/depth.h"
#include "core/mesh/counted.h"
#include "core/mesh/mesh_io.h"
#include "problems/cli/command.h"
#include "problems/cli/depth_beside.h"
#include "problems/cli/depth_row.h"
#include "problems/cli/flags.h"
#include "problems/cli/operands.h"
#include "problems/cli/view_rows.h"
#include "problems/cli/view_windows.h"
#include "problems/meshes/any_mesh.h"
#include "problems/meshes/operand_notes.h"
#include "problems/output/json_text.h"
#include "problems/output/output_files.h"
#include "problems/output/points_csv.h"
#include "problems/output/text.h"
#include "viewer/view_page.h"

namespace phongpd::cli {
namespace {

using Json = nlohmann::ordered_json;

struct DepthFlags {
  std::string a;
  std::string b;
  std::vector<std::string> at;
  std::string poses;
  std::string output = kStandardOutput;
  std::string html;
  std::string max_radius;
  std::string unit;
  std::string metric;
  std::string smoothing_length;
  std::string repair = "reject";
  double max_seconds = 0.0;
  bool json = false;
};

std::vector<int> VerticesOf(const ContactFeature& feature) {
  return {feature.vertices.begin(), feature.vertices.begin() + feature.kind};
}

// "edge 3 7"
std::string Described(const ContactFeature& feature) {
  std::string text = ToString(feature.kind);
  for (const int v : VerticesOf(feature)) text += ' ' + std::to_string(v);
  return text;
}

constexpr const char* kDepthHeader =
    "x,y,z,qw,qx,qy,qz,status,depth,clearance,direction_x,direction_y,"
    "direction_z,contact_x,contact_y,contact_z,on_a_x,on_a_y,on_a_z,on_b_x,"
    "on_b_y,on_b_z,feature_a,feature_b,certified,explored_radius,level,"
    "seconds";

std::string DepthRow(const RobotPose& pose, const DepthResult& r) {
  const Eigen::Quaterniond& turn = pose.orientation;
  std::string row = FormatPoint(pose.position);
  for (const double x : {turn.w(), turn.x(), turn.y(), turn.z()}) {
    row += ',' + FormatDouble(x);
  }
  row += std::string(",") + ToString(r.status) + ',' + FormatDouble(r.depth) +
         ',' + FormatDouble(r.clearance);
  for (const Eigen::Vector3d& v :
       {r.direction, r.contact, r.on_robot, r.on_obstacle}) {
    row += ',' + FormatPoint(v);
  }
  return row + ',' + Described(r.robot_feature) + ',' +
         Described(r.obstacle_feature) + (r.certified ? ",1," : ",0,") +
         FormatDouble(r.explored_radius) + ',' + ToString(r.level) + ',' +
         FormatDouble(r.seconds);
}

// For people.
std::string Sentence(const DepthFlags& flags, const DepthResult& r) {
  TextStream text;
  switch (r.status) {
    case DepthStatus::kSeparate:
      text << "separate: " << Rounded(r.clearance, kDigits) << " apart\n";
      break;
    case DepthStatus::kTouching:
      text << "touching: free along " << RoundedPoint(r.direction) << '\n';
      break;
    case DepthStatus::kPenetrating:
      text << "penetrating: depth "
           << (r.certified
                   ? ""
                   : "between " + Rounded(r.explored_radius, kDigits) + " and ")
           << Rounded(r.depth, kDigits) << ", out along "
           << RoundedPoint(r.direction) << '\n';
      break;
    case DepthStatus::kInvalid:  // of poses that were refused
      break;
  }
  if (r.robot_feature.kind != ContactFeature::kNone) {
    text << flags.a << ": " << RoundedPoint(r.on_robot) << " on "
         << Described(r.robot_feature) << '\n'
         << flags.b << ": " << RoundedPoint(r.on_obstacle) << " on "
         << Described(r.obstacle_feature) << '\n';
  }
  text << (r.certified ? "certified" : "NOT CERTIFIED") << ", level "
       << ToString(r.level) << ", " << Counted(r.arranged_faces, "face")
       << " arranged, " << Rounded(r.seconds) << " s\n";
  return text.str();
}

std::vector<RobotPose> PosesOf(const DepthFlags& flags) {
  if (!flags.poses.empty()) return ReadPosesCsv(flags.poses);
  RobotPose pose;
  if (!flags.at.empty()) {
    std::vector<std::string> cells = flags.at;
    for (std::string& cell : cells) {
      const std::string named = UnitNamedIn(cell);
      if (named.empty()) continue;
      if (named != flags.unit) {
        throw InputError(
            "--at: expected a finite number, found '" + cell + "'; " +
            (flags.unit.empty()
                 ? "--unit " + named + " says that it is theirs"
                 : "that is " + flags.unit + ", and nothing is converted"));
      }
      cell.resize(cell.size() - named.size());
    }
    pose.position = ParsePoint(cells, "--at");
  }
  return {pose};
}

// As it is where it must be a solid, which the query sees to; its features are
// told by the vertices of the file then.
TriangleMesh Operand(const std::string& path, const DepthFlags& flags) {
  const Repair repair = ParseRepair(flags.repair, "--repair");
  return repair == Repair::kReject ? LoadMesh(path) : LoadSolid(path, repair);
}

void DeclareDepthOutputs(const DepthFlags& flags, OutputFiles* outputs) {
  DeclareTable(outputs, flags.output, "--output");
  DeclareIfNamed(outputs, flags.html, "--html", {".html", ".htm"});
  if (!flags.html.empty()) RequireViewer();
}

DepthOptions DepthOptionsOf(const DepthFlags& flags) {
  DepthOptions options;
  options.robot_name = flags.a;
  options.obstacle_name = flags.b;
  options.max_seconds = flags.max_seconds;
  if (!flags.max_radius.empty()) {
    options.max_radius =
        MeshLengthFlag(flags.max_radius, "--max-radius", flags.unit);
    if (!(options.max_radius > 0.0)) {
      throw InputError("--max-radius: expected a length > 0, found " +
                       flags.max_radius);
    }
  }
  return options;
}

// That which stands beside the Euclidean depth; none: it stands alone.
std::optional<MetricKind> MetricBeside(const DepthFlags& flags) {
  if (flags.metric.empty()) {
    if (flags.smoothing_length.empty()) return std::nullopt;
    return MetricKind::kPhong;
  }
  const MetricKind metric = ParseMetricKind(flags.metric, "--metric");
  if (HasLength(metric)) return metric;
  if (!flags.smoothing_length.empty()) {
    throw InputError("--smoothing-length: expected none with metric " +
                     flags.metric + ", found " + flags.smoothing_length);
  }
  return std::nullopt;
}

// The answers as text, in the form that is asked for, with another metric's
// beside the Euclidean depth where one, or a smoothing length, is.
class DepthText {
 public:
  // The flags outlive this.
  DepthText(const DepthFlags& flags, AnswerForm form, const TriangleMesh& a,
            const TriangleMesh& b)
      : flags_(flags),
        is_json_(form == AnswerForm::kJson),
        is_table_(!is_json_ &&
                  (form == AnswerForm::kCsv || !flags.poses.empty())) {
    if (const std::optional<MetricKind> metric = MetricBeside(flags)) {
      ContactSpaceOptions limits;
      limits.robot_name = flags.a;
      limits.obstacle_name = flags.b;
      limits.max_seconds = flags.max_seconds;
      beside_.emplace(*metric,
                      WithoutUnitName(flags.smoothing_length, flags.unit), a, b,
                      limits);
    }
    if (is_table_) {
      text_ = std::string(kDepthHeader) + (beside_ ? beside_->Columns() : "") +
              '\n';
    }
  }

  void Add(const RobotPose& pose, const DepthResult& result) {
    std::optional<WindowResult> other;
    if (beside_) other = beside_->At(pose);
    if (is_json_) {
      Json answer = DepthAnswerRow(pose, result);
      if (beside_) answer[beside_->Key()] = beside_->AsJson(*other);
      text_ += JsonText(answer) + '\n';
    } else if (is_table_) {
      text_ += DepthRow(pose, result) +
               (beside_ ? DepthBeside::AsCells(*other) : "") + '\n';
    } else {
      text_ += Sentence(flags_, result) +
               (beside_ ? beside_->AsSentence(*other) : "");
    }
  }

  const std::string& text() const { return text_; }

 private:
  const DepthFlags& flags_;
  bool is_json_, is_table_;
  std::optional<DepthBeside> beside_;
  std::string text_;
};

// Completes a page that holds the answers.
void WriteDepthPage(const DepthFlags& flags, const TriangleMesh& a,
                    const TriangleMesh& b, View* view, OutputFiles* outputs) {
  view->title = flags.a + " in " + flags.b;
  if (!flags.unit.empty()) view->unit = flags.unit;
  view->robot = a;
  view->meshes.push_back({flags.b, ViewRole::kObstacle, b});
  TellOfDepthWindows(false, view);
  outputs->Write(flags.html, ViewPage(*view));
}

int AnswerDepth(const DepthFlags& flags) {
  const AnswerForm form = FormOf(flags.output, flags.json);
  OutputFiles outputs;
  DeclareDepthOutputs(flags, &outputs);
  const std::vector<RobotPose> poses = PosesOf(flags);
  const DepthOptions options = DepthOptionsOf(flags);
  const TriangleMesh a = Operand(flags.a, flags), b = Operand(flags.b, flags);
  const DepthQuery query(a, b, options);
  WarnOfUnits(a, flags.a, b, flags.b);
  for (const std::string& warning : query.warnings()) Warn(warning);
  DepthText text(flags, form, a, b);
  View view;
  bool is_certified = true;
  std::size_t done = 0;
  for (const RobotPose& pose : poses) {
    ProgressOf("poses", done++, poses.size());
    const DepthResult result = query.At(pose);
    is_certified = is_certified && result.certified;
    if (!flags.html.empty()) {
      view.answers.push_back(ViewAnswerOf(pose, result));
    }
    text.Add(pose, result);
  }
  outputs.Write(flags.output, text.text());
  if (!flags.html.empty()) WriteDepthPage(flags, a, b, &view, &outputs);
  outputs.Commit();
  return is_certified ? kDone : kNoAnswer;
}

// What is asked about, and where it lies.
void AddDepthOperands(CLI::App* app, DepthFlags* flags) {
  app->add_option("A", flags->a,
                  std::string("Mesh of a solid (") + kMeshFormats + ")")
      ->required()
      ->type_name("FILE");
  app->add_option("B", flags->b, "Mesh of the other, which stays")
      ->required()
      ->type_name("FILE");
  CLI::Option* const at =
      app->add_option("--at", flags->at, "Move A by this first")
          ->expected(3)
          ->delimiter(',')
          ->type_name("X Y Z");
  app->add_option("--pose", flags->poses,
                  "CSV file with the columns x,y,z,qw,qx,qy,qz: turn A, then "
                  "move it; an answer for each")
      ->excludes(at)
      ->type_name("FILE");
  AddRepair(app, &flags->repair);
}

void AddDepthOutputs(CLI::App* app, DepthFlags* flags) {
  app->add_option("--output", flags->output,
                  "Where the answers go: rows of CSV or objects of JSON, as "
                  "its name says, FILE.csv or FILE.json; else CSV with --pose, "
                  "and a few sentences without")
      ->capture_default_str()
      ->type_name("FILE");
  app->add_flag("--json", flags->json, "One JSON object for each pose");
  app->add_option("--html", flags->html,
                  "Page with both meshes, the way out, the points that touch "
                  "after it and the windows that were built (as view makes it)")
      ->type_name("FILE");
}

// The metric beside the Euclidean one.
void AddDepthMetric(CLI::App* app, DepthFlags* flags) {
  app->add_option("--metric", flags->metric,
                  "Beside the Euclidean depth: phong, PhongPD; smoothed, the "
                  "gradient of smoothed occupancy as its direction, at the "
                  "position (smoothed-foot: at the contact); euclidean, none; "
                  "phong if only a smoothing length is set")
      ->check(CLI::IsMember(MetricNames()));
  app->add_option("--smoothing-length", flags->smoothing_length,
                  "Of that metric (0.2 if not set). PhongPD: 0 from windows "
                  "around the position, any other from the whole contact "
                  "space; smoothed: from what is within twice the length "
                  "(share of its diagonal D, or 0.5unit)")
      ->type_name("LENGTH");
}

// Where looking ends.
void AddDepthLimits(CLI::App* app, DepthFlags* flags) {
  app->add_option("--max-radius", flags->max_radius,
                  "Look no farther than this, in the meshes' unit; what is "
                  "deeper comes as a bound, with exit code 1")
      ->type_name("LENGTH");
  AddMeshUnit(app, &flags->unit);
  app->add_option("--max-seconds", flags->max_seconds,
                  "Look no farther after this time for one pose (0: no limit); "
                  "PhongPD that takes longer is refused")
      ->type_name("S")
      ->transform(SecondsFromZero());
}

}  // namespace

Command AddDepth(CLI::App* app) {
  auto flags = std::make_shared<DepthFlags>();
  AddDepthOperands(app, flags.get());
  AddDepthOutputs(app, flags.get());
  AddDepthMetric(app, flags.get());
  AddDepthLimits(app, flags.get());
  AddExamples(app, {"phongpd depth robot.off obstacle.stl",
                    "phongpd depth robot.off obstacle.stl --at 0.3 0 0.1 "
                    "--html depth.html",
                    "phongpd depth robot.off obstacle.stl --json",
                    "phongpd depth robot.off obstacle.stl --smoothing-length 0",
                    "phongpd depth robot.off obstacle.stl --metric smoothed "
                    "--smoothing-length 0.05",
                    "phongpd depth robot.off obstacle.stl --pose poses.csv "
                    "--output depth.csv"});
  return [flags] { return AnswerDepth(*flags); };
}

}  // namespace phongpd::cli
