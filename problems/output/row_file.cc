// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/output/row_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "files/temporary_file.h"
#include "problems/output/json_text.h"

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;
using internal::Descriptor;

// JSON writes it as \t.
constexpr char kBeforeAside = '\t';

constexpr char kWhat[] = "phongpd, rows of an unfinished command";

[[noreturn]] void Fail(const std::string& path, const std::string& reason) {
  throw InputError(path + ": " + reason);
}

// Of what a row of ours nests; each level takes stack where it is compared.
constexpr int kMostLevels = 64;

bool IsShallow(const std::string& line) {
  int level = 0, most = 0;
  bool is_text = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (is_text && c == '\\') {
      ++i;
    } else if (c == '"') {
      is_text = !is_text;
    } else if (!is_text && (c == '[' || c == '{')) {
      most = std::max(most, ++level);
    } else if (!is_text && (c == ']' || c == '}')) {
      --level;
    }
  }
  return most <= kMostLevels;
}

// Discarded where it is no JSON, or not like a row's.
Json Parsed(const std::string& line) {
  if (!IsShallow(line)) return Json(Json::value_t::discarded);
  return Json::parse(line, nullptr, false);
}

// A setting as its user would say it: values of a flag side by side.
std::string Spoken(const Json& value) {
  if (value.is_null() || value == "") return "not given";
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array()) return JsonText(value);
  std::string text;
  for (const Json& item : value)
    text += (text.empty() ? "" : " ") + Spoken(item);
  return text.empty() ? "none" : text;
}

// The first thing that two commands disagree about.
std::string Difference(const Json& there, const Json& here) {
  constexpr std::size_t kTelling = 60;  // characters; digests are longer
  for (const auto& [key, value] : here.items()) {
    const Json other = there.contains(key) ? there.at(key) : Json();
    if (other == value) continue;
    if (other.is_object() && value.is_object()) return Difference(other, value);
    const std::string was = Spoken(other), is = Spoken(value);
    if (was.size() > kTelling || is.size() > kTelling) return key + " differ";
    return key + ": " + was + " there, " + is + " here";
  }
  return "it has settings unknown here";
}

}  // namespace

RowFile::RowFile(const std::string& target, const Json& command) {
  if (target.empty()) return;
  path_ = target + ".partial";
  const std::filesystem::path path(path_);
  leaf_ = path.filename().string();
  const std::string header =
      JsonText(Json({{"what", kWhat}, {"command", command}})) + '\n';
  try {
    folder_ = internal::OpenFolder(path.parent_path().string());
    Open();
    TakeUp(internal::ReadAll(file_), command, header);
  } catch (const std::system_error& error) {
    RemoveIfNew();
    Fail(path_, "cannot be used (" + error.code().message() + ")");
  } catch (...) {
    RemoveIfNew();
    throw;
  }
}

RowFile::~RowFile() {
  if (rows_.empty()) Finish();
}

void RowFile::RemoveIfNew() {
  if (is_new_) unlinkat(folder_.number(), leaf_.c_str(), 0);
}

void RowFile::Open() {
  constexpr int kFlags =
      O_RDWR | O_APPEND | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  // Again where another process finished, and removed it, before the lock.
  for (;;) {
    file_ = Descriptor(openat(folder_.number(), leaf_.c_str(),
                              kFlags | O_CREAT | O_EXCL, 0600));
    is_new_ = file_.IsOpen();
    if (is_new_) {
      on_signal_ = internal::RemovedOnSignal(folder_.number(), leaf_);
      on_signal_.Confirm();
    } else if (errno == EEXIST) {
      file_ = Descriptor(openat(folder_.number(), leaf_.c_str(), kFlags));
      if (!file_.IsOpen() && errno == ENOENT) continue;
      if (!file_.IsOpen() && errno == ELOOP) {
        Fail(path_,
             "expected a file of rows, found a symbolic link; remove it");
      }
    }
    if (!file_.IsOpen()) internal::ThrowErrno("open");
    struct stat opened, named;
    if (fstat(file_.number(), &opened) != 0) internal::ThrowErrno("fstat");
    if (!S_ISREG(opened.st_mode) || !internal::IsPrivate(file_)) {
      Fail(path_,
           "expected a file of rows that only its owner, the caller, "
           "may write to; found another; remove it");
    }
    if (!internal::TryLock(file_)) {
      Fail(path_,
           "another process is writing these rows; wait for it, or "
           "choose another output");
    }
    if (fstatat(folder_.number(), leaf_.c_str(), &named, AT_SYMLINK_NOFOLLOW) ==
            0 &&
        named.st_ino == opened.st_ino && named.st_dev == opened.st_dev) {
      return;
    }
  }
}

void RowFile::TakeUp(const std::string& content, const Json& command,
                     const std::string& header) {
  const std::size_t end = content.find('\n');
  if (end == std::string::npos &&
      header.compare(0, content.size(), content) == 0) {
    // New, or its first line is torn: it may go again.
    if (!is_new_) {
      on_signal_ = internal::RemovedOnSignal(folder_.number(), leaf_);
    }
    if (ftruncate(file_.number(), 0) != 0) internal::ThrowErrno("truncate");
    internal::WriteAll(file_, header);
    size_ = header.size();
    return;
  }
  const Json first = Parsed(content.substr(0, end));
  std::size_t at = end == std::string::npos ? content.size() : end + 1;
  std::vector<std::string> rows, asides;
  for (std::size_t next; (next = content.find('\n', at)) != std::string::npos;
       at = next + 1) {
    std::string row = content.substr(at, next - at), aside;
    const std::size_t tab = row.find(kBeforeAside);
    if (tab != std::string::npos) {
      aside = row.substr(tab + 1);
      row.resize(tab);
      if (!Parsed(aside).is_object()) break;
    }
    if (!Parsed(row).is_object()) break;
    rows.push_back(std::move(row));
    asides.push_back(std::move(aside));
  }
  const std::string count = std::to_string(rows.size()) + " rows";
  if (!first.is_object() || !first.contains("command") ||
      !first.contains("what") || first.at("what") != kWhat) {
    Fail(path_,
         "expected rows of an interrupted phongpd, found something "
         "else; remove it or choose another output");
  }
  if (first.at("command") != command) {
    Fail(path_, "holds " + count + " of another command (" +
                    Difference(first.at("command"), command) +
                    "); finish that one, remove the file or choose another "
                    "output");
  }
  if (ftruncate(file_.number(), static_cast<off_t>(at)) != 0) {
    internal::ThrowErrno("truncate");
  }
  size_ = at;
  rows_ = std::move(rows);
  asides_ = std::move(asides);
}

void RowFile::Append(const std::string& row, const std::string& aside) {
  rows_.reserve(rows_.size() + 1);
  asides_.reserve(asides_.size() + 1);
  std::string kept = row, beside = aside;
  const std::string line = aside.empty() ? row : row + kBeforeAside + aside;
  if (file_.IsOpen()) {
    try {
      internal::WriteAll(file_, line + '\n');
    } catch (const std::system_error& error) {
      // Should this fail too, the torn line is found by the next run.
      static_cast<void>(!ftruncate(file_.number(), static_cast<off_t>(size_)));
      Fail(path_, "cannot be written (" + error.code().message() +
                      "); the rows before are kept, the same command goes on "
                      "from there");
    }
    size_ += line.size() + 1;
    on_signal_.Forget();
  }
  rows_.push_back(std::move(kept));
  asides_.push_back(std::move(beside));
}

std::string RowFile::Content() const {
  std::string content;
  for (const std::string& row : rows_) content += row + '\n';
  return content;
}

void RowFile::Finish() {
  if (!file_.IsOpen()) return;
  unlinkat(folder_.number(), leaf_.c_str(), 0);
  on_signal_.Forget();
  file_.Close();
}

}  // namespace phongpd
