// SPDX-License-Identifier: GPL-3.0-or-later
#include <cxxabi.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <csignal>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <system_error>
#include <typeinfo>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "files/interruption.h"
#include "problems/cli/command.h"
#include "problems/cli/parse_errors.h"
#include "problems/output/text.h"
#include "problems/output/versions.h"

namespace phongpd::cli {
namespace {

std::string VersionText() {
  std::string text;
  for (const auto& [name, version] : Versions()) {
    text += (text.empty() ? "" : "\n") + name + ' ' + version;
  }
  return text;
}

// Errors are one line, whatever the message they come from looks like.
int Fail(ExitCode code, const std::string& message) {
  std::cerr << "phongpd: " << OneLine(message) << '\n';
  return code;
}

// CLI11 takes -1 for a number but -.5 for a flag.
std::vector<std::string> Arguments(int argc, char** argv) {
  std::vector<std::string> arguments;
  for (int i = argc - 1; i > 0; --i) {  // CLI11 wants them in reverse
    std::string argument = argv[i];
    if (argument.size() > 2 && argument[0] == '-' && argument[1] == '.' &&
        std::isdigit(static_cast<unsigned char>(argument[2])) != 0) {
      argument.insert(1, "0");
    }
    arguments.push_back(argument);
  }
  return arguments;
}

constexpr char kProgramHelp[] =
    "Continuous penetration depth (PhongPD) on exact contact spaces.\n"
    "Exit codes: 0 done, 1 ran but found no answer, 2 bad input or an output "
    "that cannot be written (nothing is), 3 internal error, or out of memory "
    "or threads; 128 + n ended by signal n, for example 130 by Ctrl-C.\n"
    "Answers go to standard output where --output names no file (- is "
    "standard output, too), words for people to standard error then; --json "
    "makes answers JSON. Outputs are replaced together at the end or not at "
    "all. What takes long tells on standard error how far it is; "
    "PHONGPD_PROGRESS=never silences that.";

struct ProgramCommand {
  const char* name;
  const char* summary;
  Command (*declare)(CLI::App*);
};
// In the order of --help.
constexpr ProgramCommand kProgramCommands[] = {
    {"depth", "Exact penetration depth of two meshes, or their clearance",
     AddDepth},
    {"minkowski", "Exact Minkowski sum of two meshes, or difference",
     AddMinkowski},
    {"check", "Is a mesh a solid, and if not, what is wrong and where",
     AddCheck},
    {"contact-space", "Build the contact space of two meshes", AddContactSpace},
    {"query", "Penetration depth at the points of a CSV file", AddQuery},
    {"motion", "Phong, Euclidean and sliding depth along a straight motion",
     AddMotion},
    {"sweep", "Is a motion that turns free, proved for the whole of it",
     AddSweep},
    {"optimize", "Optimise a trajectory with Ipopt, exactly judged",
     AddOptimize},
    {"retime", "Time a path of one's own: a certified curve within limits",
     AddRetime},
    {"compare", "Compare penetration metrics in the trajectory optimiser",
     AddCompare},
    {"join", "Join the pieces of a contact space", AddJoin},
    {"new", "Write a first scene file for two meshes, commented", AddNew},
    {"plan", "Plan a path, or prove that there is none", AddPlan},
    {"remove", "Take a part out of an assembly, or all, or prove it is held",
     AddRemove},
    {"view", "Look at meshes, scenes, paths, motions and depths", AddView},
    {"scenes", "List or write the procedural scenes", AddScenes},
    {"reproduce", "Pack a command with its inputs, to report what went wrong",
     AddReproduce},
    {"completion", "Print what completes this program's words in a shell",
     AddCompletion},
    {"man", "Print the manual page, in roff", AddMan},
};

struct DeclaredCommand {
  CLI::App* app;
  Command run;
};

std::vector<DeclaredCommand> DeclareCommands(CLI::App* app) {
  std::vector<DeclaredCommand> commands;
  for (const ProgramCommand& command : kProgramCommands) {
    CLI::App* const of_command =
        app->add_subcommand(command.name, command.summary);
    commands.push_back({of_command, command.declare(of_command)});
  }
  return commands;
}

int Run(int argc, char** argv) {
  CLI::App app(kProgramHelp, "phongpd");
  app.set_version_flag("--version", VersionText);
  const std::vector<DeclaredCommand> commands = DeclareCommands(&app);
  if (argc > 1 && std::string(argv[1]) == "__complete") {
    return PrintOffers(app, {argv + 2, argv + argc});
  }
  const std::vector<std::string> arguments = Arguments(argc, argv);
  try {
    RefuseUnknownNames(app, arguments);
    app.parse(std::vector<std::string>(arguments));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // help, version
    return Fail(kBadInput, Explained(error, app, arguments));
  }
  std::vector<std::string> names;
  for (const DeclaredCommand& command : commands) {
    if (command.app->parsed()) return command.run();
    names.push_back(command.app->get_name());
  }
  return Fail(kBadInput,
              "expected a command: " + Joined(names) + " (see --help)");
}

// Says what the memory was needed for and where less does.
int FailForMemory() {
  const std::string& stage = Stage();
  return Fail(kInternalError,
              "out of memory" +
                  (stage.empty() ? "" : ", the last step was: " + stage) +
                  "; give the process more, or simplify the meshes "
                  "(contact-space --target-faces, --robot-hull; --max-mib "
                  "refuses early what would need more)");
}

int FailFor(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const InputError& error) {
    return Fail(kBadInput, error.what());
  } catch (const std::bad_alloc&) {
    return FailForMemory();
  } catch (const std::exception& error) {
    const std::string what = error.what();
    // TBB reports a refused thread as any runtime_error.  Files are InputErrors
    // by now.
    if (dynamic_cast<const std::system_error*>(&error) != nullptr ||
        what.find("pthread_create") != std::string::npos) {
      return Fail(kInternalError, "no thread can be started (" + what +
                                      "); see the limits of processes and "
                                      "memory (ulimit -u, ulimit -v)");
    }
    return Fail(kInternalError,
                "internal error: " + what +
                    "; to report it: phongpd reproduce --output report.json -- "
                    "and the command as you gave it");
  } catch (...) {
    const std::type_info* const type = abi::__cxa_current_exception_type();
    return Fail(kInternalError,
                std::string("internal error: an exception of type ") +
                    (type != nullptr ? type->name() : "unknown"));
  }
}

// An exception where none can be passed on, such as a thread's: the destructors
// that remove files do not run.
[[noreturn]] void OnTerminate() {
  internal::RemoveFilesNow();
  static std::atomic_flag is_known = ATOMIC_FLAG_INIT;
  if (!is_known.test_and_set()) {
    const std::exception_ptr failure = std::current_exception();
    if (failure != nullptr) {
      FailFor(failure);
    } else {
      Fail(kInternalError, "internal error: terminated");
    }
  } else {
    // There was no memory even for the message.
    constexpr char kMessage[] = "phongpd: out of memory\n";
    static_cast<void>(!write(STDERR_FILENO, kMessage, sizeof kMessage - 1));
  }
  _exit(kInternalError);
}

}  // namespace

// The program.
int Main(int argc, char** argv) {
  internal::RemoveFilesOnSignals();
  // A limit of file sizes is an error of the write, like a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  std::set_terminate(OnTerminate);
  try {
    TellOfBuilds();
    const int code = Run(argc, argv);
    std::cout.flush();
    if (!std::cout) return Fail(kBadInput, "standard output: write failed");
    return code;
  } catch (...) {
    return FailFor(std::current_exception());
  }
}

}  // namespace phongpd::cli

int main(int argc, char** argv) { return phongpd::cli::Main(argc, argv); }
