// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/still_picture.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "problems/output/programs.h"
#include "problems/output/temporary_folder.h"

extern char** environ;

namespace phongpd {
namespace {

std::string Browser() {
  return FindProgram({"chromium", "chromium-browser", "google-chrome"});
}

// Runs the program with nothing on its standard streams; its exit status.
int RunBrowser(std::vector<std::string> arguments) {
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {0, 1, 2}) {
    posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
  }
  pid_t child = 0;
  const int failed = posix_spawn(&child, pointers[0], &actions, nullptr,
                                 pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) {
    throw InputError("picture: " + arguments[0] + " could not be started (" +
                     std::strerror(failed) + ")");
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace

void RequireBrowser() {
  if (!Browser().empty()) return;
  throw InputError(
      "picture: expected the browser chromium on PATH, found none; install the "
      "Debian package chromium (scripts/setup.sh chromium), or take --html and "
      "save a picture there");
}

std::string StillPicture(const std::string& page, int width, int height,
                         std::optional<double> moment) {
  RequireBrowser();
  const TemporaryFolder folder;
  const std::string html = (folder.path() / "page.html").string();
  const std::string png = (folder.path() / "picture.png").string();
  std::ofstream file(html, std::ios::binary);
  file << page;
  file.close();
  if (!file) throw InputError(html + ": cannot be written");
  std::vector<std::string> command = {
      Browser(),
      "--headless=new",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      "--hide-scrollbars",
      "--disable-extensions",
      "--no-first-run",
      "--disable-dev-shm-usage",
      "--user-data-dir=" + (folder.path() / "profile").string(),
      "--window-size=" + std::to_string(width) + "," + std::to_string(height),
      "--virtual-time-budget=4000",
      "--screenshot=" + png};
  // The browser refuses to confine pages for root; this one is our own.
  if (geteuid() == 0) command.push_back("--no-sandbox");
  command.push_back("file://" + html + "#still=1&theme=light" +
                    (moment ? "&t=" + std::to_string(*moment) : ""));
  const int status = RunBrowser(command);
  std::ifstream picture(png, std::ios::binary);
  std::ostringstream content;
  content << picture.rdbuf();
  std::string bytes = content.str();
  if (bytes.rfind("\x89PNG", 0) != 0) {
    throw std::runtime_error(command[0] + " gave no picture (status " +
                             std::to_string(status) + ")");
  }
  return bytes;
}

}  // namespace phongpd
