// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/studies/reproduction.h"

#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "core/mesh/mesh_error.h"
#include "problems/meshes/any_mesh.h"
#include "problems/output/json_text.h"
#include "problems/output/row_parts.h"

namespace phongpd {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr char kFormat[] = "phongpd reproduction 1";
constexpr std::uintmax_t kLargestInput = 512ULL << 20;
const std::string kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string ToBase64(const std::string& bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 |
              (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= count ? kDigits[group >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

// Throws InputError "NAME: ..." for other characters.
std::string FromBase64(const std::string& text, const std::string& name) {
  std::string bytes;
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    const std::size_t digit = kDigits.find(c);
    if (digit == std::string::npos) {
      throw InputError(name + ": expected base64, found another character");
    }
    group = group << 6 | static_cast<std::uint32_t>(digit);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(group >> bits & 255U);
  }
  return bytes;
}

std::string Content(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw InputError(path.string() + ": cannot be read");
  return text.str();
}

// Is it below the folder it is relative to?
bool IsContained(const std::string& name) {
  const fs::path path(name);
  return !path.empty() && !path.is_absolute() &&
         std::none_of(path.begin(), path.end(),
                      [](const fs::path& part) { return part == ".."; });
}

bool IsDevice(const std::string& text) {
  return text == "/dev/stdout" || text == "/dev/null";
}

std::string FileName(const std::string& text) {
  fs::path path(text);
  if (!path.has_filename()) path = path.parent_path();
  return path.filename().string();
}

// Every "mesh" of a scene that names a file.
void CollectMeshes(const Json& json, std::vector<std::string>* meshes) {
  for (const auto& [key, value] : json.items()) {
    if (json.is_object() && key == "mesh" && value.is_string()) {
      meshes->push_back(value.get<std::string>());
    } else if (value.is_structured()) {
      CollectMeshes(value, meshes);
    }
  }
}

void Replace(const std::string& from, const std::string& to,
             std::string* text) {
  for (std::size_t at = text->find(from); at != std::string::npos;
       at = text->find(from, at + to.size())) {
    text->replace(at, from.size(), to);
  }
}

class Packer {
 public:
  // The name under which an argument is repeated.
  std::string Input(const std::string& text) {
    std::error_code error;
    const std::size_t end = FilePartOf(text);
    if (end < text.size() && !fs::is_regular_file(text, error) &&
        fs::is_regular_file(text.substr(0, end), error)) {
      return Input(text.substr(0, end)) + text.substr(end);
    }
    if (!fs::is_regular_file(text, error)) {
      const bool names_place = text.find('/') != std::string::npos;
      return names_place && !IsDevice(text) ? "missing/" + FileName(text)
                                            : text;
    }
    const std::string folder = "inputs/" + std::to_string(++count_) + "/";
    std::string content = Read(text);
    PackMeshes(fs::path(text).parent_path(), folder, &content);
    Add(folder + FileName(text), content);
    return folder + FileName(text);
  }

  const Json& files() const { return files_; }

 private:
  std::string Read(const fs::path& path) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(path, error);
    if (!error) size_ += size;
    if (size_ > kLargestInput) {
      throw InputError(path.string() +
                       ": expected at most 512 MiB of inputs together, found "
                       "more");
    }
    return Content(path);
  }

  void Add(const std::string& name, const std::string& content) {
    bool is_text = content.find('\0') == std::string::npos;
    try {
      JsonText(Json(content));
    } catch (const Json::type_error&) {  // no UTF-8
      is_text = false;
    }
    files_.push_back({{"name", name},
                      {"encoding", is_text ? "text" : "base64"},
                      {"content", is_text ? content : ToBase64(content)}});
  }

  // If `scene` is a scene file, the meshes beside it; names that say where
  // are replaced.
  void PackMeshes(const fs::path& from, const std::string& folder,
                  std::string* scene) {
    const Json json = Json::parse(*scene, nullptr, false, true);
    if (!json.is_object()) return;
    std::vector<std::string> meshes;
    CollectMeshes(json, &meshes);
    std::sort(meshes.begin(), meshes.end());
    meshes.erase(std::unique(meshes.begin(), meshes.end()), meshes.end());
    int renamed = 0;
    for (const std::string& mesh : meshes) {
      std::string name = mesh;
      if (!IsContained(mesh)) {
        name = "meshes/" + std::to_string(++renamed) + "/" + FileName(mesh);
        Replace(JsonText(Json(mesh)), JsonText(Json(name)), scene);
      }
      std::error_code error;
      const fs::path path = from / mesh;
      if (fs::is_regular_file(path, error)) Add(folder + name, Read(path));
    }
  }

  int count_ = 0;
  std::uintmax_t size_ = 0;
  Json files_ = Json::array();
};

bool TakesOutput(const std::string& flag) {
  static const std::vector<std::string> flags = {
      "--output", "--report",   "--html",   "--svg",    "--glb",
      "--png",    "--ompl-log", "--meshes", "--defects"};
  return std::find(flags.begin(), flags.end(), flag) != flags.end();
}

std::string OutputName(const std::string& text) {
  return IsDevice(text) || text == "-" ? text : "outputs/" + FileName(text);
}

// Which variables are set, not to what: their values may name folders.
Json Environment() {
  Json variables = Json::array();
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string text = *entry;
    if (text.rfind("PHONGPD_", 0) == 0) {
      variables.push_back(text.substr(0, text.find('=')));
    }
  }
  utsname machine{};
  uname(&machine);
  return {{"system", machine.sysname},
          {"machine", machine.machine},
          {"threads", std::thread::hardware_concurrency()},
          {"set", variables}};
}

[[noreturn]] void Refuse(const std::string& name, const std::string& found) {
  throw InputError(name + ": expected a file written by phongpd reproduce, " +
                   "found " + found);
}

}  // namespace

Json PackCommand(const std::vector<std::string>& arguments) {
  Packer packer;
  Json packed = Json::array();
  bool is_output = false;
  for (const std::string& argument : arguments) {
    const bool is_flag = argument.rfind("--", 0) == 0;
    const std::size_t equals = argument.find('=');
    if (is_flag && equals != std::string::npos) {
      const std::string flag = argument.substr(0, equals);
      const std::string value = argument.substr(equals + 1);
      packed.push_back(
          flag + '=' +
          (TakesOutput(flag) ? OutputName(value) : packer.Input(value)));
    } else if (is_flag) {
      packed.push_back(argument);
    } else {
      packed.push_back(is_output ? OutputName(argument)
                                 : packer.Input(argument));
    }
    is_output = is_flag && TakesOutput(argument);
  }
  return {{"format", kFormat},
          {"arguments", packed},
          {"files", packer.files()},
          {"versions", VersionsRow()},
          {"environment", Environment()},
          {"run", nullptr}};
}

std::vector<std::string> PackedArguments(const Json& document,
                                         const std::string& name) {
  if (!document.is_object() || document.value("format", Json()) != kFormat) {
    Refuse(name, "another format");
  }
  if (!document.contains("files") || !document["files"].is_array() ||
      !document.contains("arguments") || !document["arguments"].is_array()) {
    Refuse(name, "no files or arguments");
  }
  for (const Json& file : document["files"]) {
    for (const char* key : {"name", "encoding", "content"}) {
      if (!file.is_object() || !file.contains(key) || !file[key].is_string()) {
        Refuse(name, std::string("a file without ") + key);
      }
    }
    if (!IsContained(file["name"].get<std::string>())) {
      Refuse(name, "the file name " + JsonText(file["name"]));
    }
  }
  std::vector<std::string> arguments;
  for (const Json& argument : document["arguments"]) {
    if (!argument.is_string()) Refuse(name, "an argument that is no text");
    arguments.push_back(argument.get<std::string>());
    const std::string& text = arguments.back();
    const bool is_flag = text.rfind("--", 0) == 0;
    const std::size_t equals = is_flag ? text.find('=') : std::string::npos;
    const std::string value =
        equals == std::string::npos ? text : text.substr(equals + 1);
    if (!value.empty() && !IsDevice(value) && !IsContained(value)) {
      Refuse(name, "the argument " + JsonText(argument));
    }
  }
  if (arguments.empty() || arguments.front() == "reproduce") {
    Refuse(name, "no command that can be repeated");
  }
  return arguments;
}

void UnpackCommand(const Json& document, const std::string& name,
                   const std::string& folder) {
  PackedArguments(document, name);
  fs::create_directories(fs::path(folder) / "outputs");
  for (const Json& file : document["files"]) {
    const fs::path path = fs::path(folder) / file["name"].get<std::string>();
    const auto content = file["content"].get<std::string>();
    fs::create_directories(path.parent_path());
    std::ofstream stream(path, std::ios::binary);
    stream << (file["encoding"] == "base64" ? FromBase64(content, name)
                                            : content);
    stream.close();
    if (!stream) throw InputError(path.string() + ": cannot be written");
  }
}

}  // namespace phongpd
