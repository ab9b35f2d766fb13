// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/contact/contact_space_cache.h"
#include "core/mesh/mesh_error.h"
#include "core/mesh/triangle_mesh.h"
#include "core/projection/penetration_tracker.h"
#include "core/projection/phong_metric.h"
#include "planners/world/world.h"
#include "problems/cli/progress.h"
#include "problems/output/output_files.h"
#include "problems/scenes/scene_source.h"

// What the commands of the phongpd program share.
namespace phongpd::cli {

enum ExitCode {
  kDone = 0,           // ran and answered
  kNoAnswer = 1,       // ran, found no answer
  kBadInput = 2,       // InputError or bad arguments: one line, nothing written
  kInternalError = 3,  // a fault of the program, or out of memory or threads
};

// Runs a command whose flags have been parsed; returns an ExitCode.
using Command = std::function<int()>;

// Each declares its flags on `app` and returns what to run.
Command AddContactSpace(CLI::App* app);
Command AddQuery(CLI::App* app);
Command AddMotion(CLI::App* app);
Command AddScenes(CLI::App* app);
Command AddSweep(CLI::App* app);
Command AddOptimize(CLI::App* app);
Command AddCompare(CLI::App* app);
Command AddPlan(CLI::App* app);
Command AddRemove(CLI::App* app);
Command AddRetime(CLI::App* app);
Command AddReproduce(CLI::App* app);
Command AddDepth(CLI::App* app);
Command AddJoin(CLI::App* app);
Command AddMinkowski(CLI::App* app);
Command AddView(CLI::App* app);
Command AddCompletion(CLI::App* app);
Command AddMan(CLI::App* app);
Command AddCheck(CLI::App* app);
Command AddNew(CLI::App* app);

// What may stand where the last of `words` is being typed, to standard output:
// the scripts of AddCompletion ask for it.
int PrintOffers(const CLI::App& program, const std::vector<std::string>& words);

// The contact space of two solids, from the user's cache when `use_cache` and
// it is there.  What the user should know goes to stderr.
ContactSpace LoadOrBuild(const Solid& robot, const Solid& obstacle,
                         const ContactSpaceOptions& options, bool use_cache);
ContactSpace LoadOrBuild(const TriangleMesh& robot,
                         const TriangleMesh& obstacle,
                         const ContactSpaceOptions& options, bool use_cache);

// Declares --max-seconds and --max-mib of a build (ContactSpaceOptions).
void AddBuildLimits(CLI::App* app, double* max_seconds, double* max_mib);

// Declares --contact-space, a file that LoadContactSpace reads
// (contact_space_file.h).
CLI::Option* AddContactSpaceFile(CLI::App* app, std::string* path);

// Declares --field, and reads it with a --smoothing-length, for which D is the
// diagonal of that contact space.  Throws InputError naming the flag and the
// range.
void AddField(CLI::App* app, std::string* field);
PhongMetricOptions MetricOptions(const std::string& field,
                                 const Length& smoothing_length,
                                 const ContactSpace& contact);

// Declares --budget, for `what` is picked by it.
void AddBudget(CLI::App* app, const std::string& what, std::string* budget);
// Its seconds.
double BudgetOf(const std::string& budget);

// Declares --preset, whose help says what each buys and costs `of`, and reads
// it; empty: the scene's own.
void AddPreset(CLI::App* app, const std::string& of, std::string* preset);
void SetPreset(const std::string& preset, Scene* scene);

// Declares --slide-ratio and --slide-speed of the tracker.
void AddSliding(CLI::App* app, PenetrationTrackerOptions* options);

// What --smoothing-length says of itself.
extern const char* const kSmoothingLengthHelp;

// What the user should know of a scene, before anything is built, and of what
// its world has built; on stderr.
void TellAbout(const Scene& scene);
void TellAboutSpaces(const World& world, std::size_t triangles);

// Reads a flag that is a length; throws InputError naming it for what is none
// and, if `scene` is given, for what is out of range in its world; lengths
// are in its unit then, as its file has them.
Length LengthFlag(const std::string& text, const std::string& flag,
                  LengthRange range, const Scene* scene = nullptr);

// Declares --unit, what the unit of meshes is called.
void AddMeshUnit(CLI::App* app, std::string* unit);

// Reads a flag that is a length among meshes, which have no D: 20 or 20unit,
// and 20mm where --unit says so.  Throws InputError naming the flag for what is
// none or negative.
double MeshLengthFlag(const std::string& text, const std::string& flag,
                      const std::string& unit);

// "20unit" of "20mm", where --unit says mm; all else as it is.
std::string WithoutUnitName(const std::string& text, const std::string& unit);

// Declares --no-cache, and the cache it leaves: the user's own, or none.
void AddNoCache(CLI::App* app, bool* no_cache);
ContactSpaceCache UserCache(bool no_cache);

// Declares --root, the folder that mesh files of a scene file must lie below.
void AddRoot(CLI::App* app, std::string* root);

// Declares --verify and --no-verify of a command whose answers are judged a
// second time, on the original solids; on unless asked otherwise.
void AddVerify(CLI::App* app, bool* verify);

// Throws InputError unless --runs is at least 1.
void RequireRuns(int runs);

// Declares a mesh output, and fails now if its extension means nothing; what
// goes to standard output is OFF.
void DeclareMesh(OutputFiles* outputs, const std::string& path);

// The mesh as the named file holds it; OFF for standard output.
std::string MeshText(const TriangleMesh& mesh, const std::string& path);

// Writes the mesh to a declared output.
void WriteMeshTo(OutputFiles* outputs, const std::string& path,
                 const TriangleMesh& mesh);

// Commits, and then prints `text`, words for people: on standard output, or on
// standard error where an output is standard output.
void CommitAndTell(OutputFiles* outputs, const std::string& text);

// The three numbers of a flag, e.g. --from X Y Z.
Eigen::Vector3d ParsePoint(const std::vector<std::string>& cells,
                           const std::string& flag);

// What the rows of a command depend on, for RowFile: its options but for the
// names of outputs and --no-cache, its scenes, all versions and the program.
nlohmann::ordered_json CommandSettings(const CLI::App& app,
                                       const std::vector<SceneSource>& scenes);

// Throws std::runtime_error: an answer that is wrong on the original solids is
// a fault of the program.
[[noreturn]] void FailVerification(const std::string& what);

// "phongpd: ..." on stderr.
void Note(const std::string& text);

// "phongpd: warning: ..." on stderr.
void Warn(const std::string& text);

}  // namespace phongpd::cli
