// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh/triangle_mesh.h"

// What a picture shows, as plain data: the same for the page, for glTF and for
// still pictures.  Coordinates are in the user's unit.
namespace phongpd {

enum class ViewRole {
  kObstacle,      // solid and fixed
  kContactSpace,  // positions of the robot at which it touches; translucent
  kMesh,          // any other
};

// "obstacle", "contact" or "mesh".
const char* ToString(ViewRole role);

// The name of a mesh that is all that is known of a contact space where only
// free space was modelled: it, and facets that it hides (ConvolutionModel).
inline constexpr char kConvolutionName[] = "facets of free space's model";

// The name of one that is a part of a contact space, where no more was built.
inline constexpr char kExploredName[] = "contact space that was explored";

struct ViewMesh {
  std::string name;
  ViewRole role = ViewRole::kMesh;
  TriangleMesh mesh;
};

// Configurations and the straight motions between them, by their numbers.
struct ViewGraph {
  std::string name;  // in the legend: "retraction tree"
  std::vector<Eigen::Vector3d> points;
  std::vector<std::pair<int, int>> edges;
};

// A plane beside a path, drawn as a square.
struct ViewPlane {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();   // its middle
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // unit
  double size = 0.0;                                 // its side
};

// The path as it was in an iteration of the optimiser.
struct ViewIterate {
  std::size_t number = 0;  // of all iterations of the run, from 0
  std::string stage;       // "Ipopt from the line", "corridor, round 2"
  bool is_restoration = false;
  bool is_free = false;    // the exact judge's word
  double objective = 0.0;  // energy of the path; the line has 1
  double violation = 0.0;  // of the worst row, share of D
  std::vector<Eigen::Vector3d> points;
};

// The iterations of a run, or evenly some of them with the first and the last.
struct ViewIterates {
  std::size_t count = 0;  // of all
  std::vector<ViewIterate> kept;
};

// What lies behind a path; shown with it.
struct ViewBehind {
  ViewGraph graph;                // that a planner grew; no points: none
  std::vector<ViewPlane> planes;  // of the corridor it was optimised in
  ViewIterates iterates;          // that led to it
  // What was modelled around it, where that was free space alone; empty: more
  // was.
  BoundingBox window = ComputeBounds(TriangleMesh());
};

// Of a motion, at its path's points, which it is at at equal times from 0 to
// `duration`: what it asks of its limits, as shares of them, and the room that
// it has.
struct ViewPace {
  double duration = 0.0;  // seconds; 0: a path without time
  std::vector<double> velocity, acceleration, jerk;
  std::vector<double> clearance;  // user's unit
};

// A path of the robot's position, with a name for the legend.
struct NamedPath {
  std::string name;
  std::vector<Eigen::Vector3d> points;
  bool is_free = true;
  // How the robot is turned at each point; empty: it does not turn.
  std::vector<Eigen::Quaterniond> turns = {};
  ViewBehind behind = {};
  ViewPace pace = {};
  // Of several robots in one view: the one that follows it, at the origin;
  // such robots are all shown at once.  Empty: the view's.
  TriangleMesh robot = {};
};

// An obstacle that moves: where it is moved to at equal times, from the paths'
// beginning to their end.
struct ViewMover {
  std::string name;
  TriangleMesh mesh;  // where it is at the configuration 0
  std::vector<Eigen::Vector3d> points;
};

// Where one of several robots, each with a path of its own, begins and is to
// end.
struct ViewEnds {
  std::string robot;  // its path's name
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  Eigen::Vector3d goal = Eigen::Vector3d::Zero();
};

// One metric along a motion: PD(q) = q_c − q of every frame, 0 outside.
struct ViewTrace {
  std::string name;
  std::vector<Eigen::Vector3d> pd;
  std::vector<std::string> status;
};

// A motion: the robot's position in every frame, and what each metric says of
// it.
struct ViewMotion {
  std::vector<Eigen::Vector3d> positions;
  std::vector<ViewTrace> traces;
};

// An answer at a pose: witness points, and the way out.
struct ViewAnswer {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  std::string status;
  bool is_depth = false;   // by DepthQuery, which builds windows
  double depth = 0.0;      // of penetration
  double clearance = 0.0;  // where they are apart
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  Eigen::Vector3d on_robot = Eigen::Vector3d::Zero();
  Eigen::Vector3d on_obstacle = Eigen::Vector3d::Zero();
  bool has_witness = false;  // are there such points?
  // Of the boxes around the position that were modelled for it (Depth):
  // half of their sides, and the directions of those, in columns.
  std::vector<double> window_reaches;
  Eigen::Matrix3d window_axes = Eigen::Matrix3d::Identity();
};

struct View {
  std::string title;
  std::string unit = "units";      // what one unit of length is called
  std::vector<std::string> notes;  // what a person should know, a sentence each
  // D, which shares of a length refer to; 0: the diagonal of the box around
  // the contact spaces.
  double length = 0.0;
  std::vector<ViewMesh> meshes;  // fixed
  TriangleMesh robot;            // at the origin; may be empty
  std::optional<Eigen::Vector3d> start, goal;
  Eigen::Quaterniond start_turn = Eigen::Quaterniond::Identity();  // there
  Eigen::Quaterniond goal_turn = Eigen::Quaterniond::Identity();
  bool turns = false;          // the robot, on its way
  std::vector<ViewEnds> ends;  // of several robots, in the order of `paths`
  BoundingBox bounds = ComputeBounds(TriangleMesh());  // of q; empty: none
  std::vector<NamedPath> paths;
  ViewMotion motion;                // no frames: none
  std::vector<ViewAnswer> answers;  // one robot, a pose each
  std::vector<ViewMover> movers;
  double wanted_clearance = 0.0;  // of a path, by the scene; 0: none is named
  // What serves this view with a solver behind it: "phongpd view u_axis
  // --serve"; empty: nothing does.  `is_served`: by it the page comes.
  std::string serve_command;
  bool is_served = false;
};

// Of everything in the view but the robot, which is taken where it stands or
// goes; never empty: a unit cube at the origin where there is nothing.
BoundingBox ViewBounds(const View& view);

// The robot's way that is shown first: the first path with points, or the
// motion, or the answers' positions; empty if it stays where it is.
std::vector<Eigen::Vector3d> FirstWay(const View& view);

}  // namespace phongpd
