// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/contact_space_file.h"

#include <cctype>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

#include "core/contact/contact_space_file.h"
#include "core/mesh/mesh_error.h"
#include "core/mesh/mesh_io.h"
#include "core/mesh/mesh_range.h"
#include "problems/cli/command.h"
#include "problems/cli/flags.h"

namespace phongpd::cli {
namespace {

constexpr char kMark[] = "# contact space by phongpd\n";

bool HasComments(const std::string& path) {
  if (path == kStandardOutput) return true;  // OFF
  const std::size_t dot = path.find_last_of('.');
  std::string extension = dot == std::string::npos ? "" : path.substr(dot + 1);
  for (char& c : extension) c = static_cast<char>(std::tolower(c));
  return extension == "off" || extension == "obj";
}

ContactSpace TakeMesh(const std::string& path) {
  TriangleMesh mesh = ReadMesh(path);
  RequireInRange(mesh, path);
  return TakeAsContactSpace(std::move(mesh), path);
}

}  // namespace

bool IsMarkedContactSpace(const std::string& path) {
  if (NamesContactSpaceFile(path)) return true;
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  const std::string mark = kMark;
  std::ifstream file(path, std::ios::binary);
  file.seekg(-static_cast<std::streamoff>(mark.size()), std::ios::end);
  std::string end(mark.size(), '\0');
  file.read(end.data(), static_cast<std::streamsize>(end.size()));
  return file.good() && end == mark;
}

void DeclareContactSpace(OutputFiles* outputs, const std::string& path) {
  if (NamesContactSpaceFile(path)) {
    outputs->Declare(path);
  } else {
    RequireEnding(path, "--output", {".off", ".obj", ".stl", ".ply", ".pcs"});
    DeclareMesh(outputs, path);
  }
}

void WriteContactSpaceTo(OutputFiles* outputs, const std::string& path,
                         const ContactSpace& space) {
  outputs->Write(path, NamesContactSpaceFile(path)
                           ? ContactSpaceContent(space)
                           : MeshText(space.mesh(), path) +
                                 (HasComments(path) ? kMark : ""));
}

ContactSpace LoadContactSpace(const std::string& path) {
  const ContactSpace space =
      NamesContactSpaceFile(path) ? ReadContactSpace(path) : TakeMesh(path);
  RequireInRange(space.mesh(), path);
  if (!(space.report().volume > 0.0)) {
    throw InputError(path +
                     ": expected a contact space, outward, found a "
                     "surface facing inwards; build one with phongpd "
                     "contact-space");
  }
  return space;
}

void TellIfTaken(const std::string& path) {
  if (IsMarkedContactSpace(path)) return;
  Note(path +
       ": taken as a contact space, though nothing in it says that it is one "
       "(phongpd contact-space marks OFF and OBJ files, and .pcs files need no "
       "mark)");
}

}  // namespace phongpd::cli
