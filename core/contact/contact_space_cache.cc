// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact/contact_space_cache.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/contact/byte_stream.h"
#include "core/contact/contact_space_bytes.h"
#include "core/contact/content_hash.h"
#include "core/mesh/mesh_error.h"
#include "core/minkowski/operands/operand.h"
#include "files/descriptor.h"
#include "files/folder_names.h"
#include "files/temporary_file.h"

namespace phongpd {
namespace {

namespace fs = std::filesystem;
using internal::Descriptor;

const char kCacheExtension[] = ".contact-space";
const char kTemporary[] = "unfinished-";
// Written by a process that is gone, when this old; sooner where files can be
// locked.
constexpr std::chrono::hours kAbandoned(1);

std::string FromEnvironment(const char* name) {
  const char* const value = std::getenv(name);
  return value != nullptr ? value : "";
}

// The cache's folder, if it is there and can be trusted.
class CacheFolder {
 public:
  explicit CacheFolder(const std::string& path) : path_(path) { Open(); }

  const Descriptor& descriptor() const { return folder_; }
  // Why it is not used; empty: no reason, or it is not there.
  const std::string& distrust() const { return distrust_; }

  // False if it cannot be had.
  bool MakeIfMissing() {
    if (folder_.IsOpen() || !distrust_.empty()) return folder_.IsOpen();
    // What is missing is made for the user alone, as XDG_CACHE_HOME asks for.
    fs::path made;
    for (const fs::path& part : fs::path(path_)) {
      made /= part;
      if (mkdir(made.c_str(), 0700) != 0 && errno != EEXIST) return false;
    }
    Open();
    return folder_.IsOpen();
  }

 private:
  void Open() {
    folder_ = Descriptor(open(path_.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
    if (!folder_.IsOpen()) return;
    // In a shared folder anybody can put a link under the cache's name.
    struct stat named;
    const bool is_own_name = lstat(path_.c_str(), &named) == 0 &&
                             (!S_ISLNK(named.st_mode) ||
                              named.st_uid == geteuid() || named.st_uid == 0);
    if (is_own_name && internal::IsPrivate(folder_)) return;
    folder_.Close();
    distrust_ = "the cache folder " + path_ +
                " is not used: expected it to be the user's own and closed to "
                "the writing of others (chmod go-w), or set PHONGPD_CACHE_DIR";
  }

  std::string path_;
  Descriptor folder_;
  std::string distrust_;
};

// One cached result: a header that says what it is the result of, then the
// size and checksum of what follows, then that.
class CacheFile {
 public:
  CacheFile(const TriangleMesh& robot, const TriangleMesh& obstacle,
            const ContactSpaceOptions& options, const ContactSpaceCache& cache)
      : cache_(cache), folder_(cache.directory) {
    const internal::ContentHash key =
        internal::HashContent(internal::KeyBytes(robot, obstacle, options));
    name_ = internal::ToHex(key) + kCacheExtension;
    path_ = fs::path(cache.directory) / name_;
    // The counts catch what little the hash may miss.
    internal::ByteWriter writer;
    writer(std::string("phongpd contact space"), key, robot.vertices.size(),
           robot.triangles.size(), obstacle.vertices.size(),
           obstacle.triangles.size());
    header_ = writer.Take();
  }

  // What the user should know; empty: nothing.
  const std::string& warning() const { return warning_; }

  // False, with a reason to warn of if there is one, unless *space is what was
  // kept.
  bool Read(ContactSpace::Parts* space) {
    warning_ = folder_.distrust();
    if (!folder_.descriptor().IsOpen()) return false;
    const Descriptor file(
        openat(folder_.descriptor().number(), name_.c_str(),
               O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    struct stat status;
    if (file.IsOpen() ? fstat(file.number(), &status) != 0 : errno != ELOOP) {
      return false;
    }
    if (!file.IsOpen() || !S_ISREG(status.st_mode) ||
        !internal::IsPrivate(file)) {
      warning_ = "the cache file " + path_.string() +
                 " is not used: expected a file of the user's own that nobody "
                 "else may write to";
      return false;
    }
    if (!IsContent(file, static_cast<std::uintmax_t>(status.st_size), space)) {
      SayDamaged();
      return false;
    }
    futimens(file.number(), nullptr);  // now it is not the longest unused one
    return true;
  }

  void SayDamaged() {
    warning_ = "the cache file " + path_.string() +
               " was damaged and has been replaced";
  }

  // Failures are no more than that: the next call finds no file.
  void Write(const ContactSpace::Parts& space) {
    try {
      const std::string content = internal::ToBytes(space);
      const std::string start = header_ + internal::Seal(content);
      if (start.size() + content.size() > cache_.max_bytes) return;
      if (!folder_.MakeIfMissing()) return;
      internal::TemporaryFile file(folder_.descriptor(), kTemporary);
      file.Write(start);
      file.Write(content);
      // Not synced: what a power cut leaves, the checksum finds.
      file.Publish(name_, 0600);
      Trim();
    } catch (const std::system_error&) {
    } catch (const std::bad_alloc&) {
    }
  }

 private:
  bool IsContent(const Descriptor& file, std::uintmax_t size,
                 ContactSpace::Parts* space) const {
    const std::size_t start = header_.size() + internal::kSealBytes;
    if (size > cache_.max_bytes || size < start) return false;
    try {
      const std::string bytes = internal::ReadAll(file);
      const std::string_view all(bytes);
      if (all.size() < start) return false;
      const std::string_view content = all.substr(start);
      return all.substr(0, start) == header_ + internal::Seal(content) &&
             internal::FromBytes(content, space);
    } catch (const std::system_error&) {  // a disk that fails
      return false;
    }
  }

  // Other processes may remove files meanwhile: errors mean no more than that.
  void Trim() const {
    struct Entry {
      fs::file_time_type used;
      std::uintmax_t bytes;
      fs::path path;
    };
    internal::RemoveAbandoned(cache_.directory, kTemporary);
    std::vector<Entry> entries;
    std::uintmax_t total = 0;
    const auto now = fs::file_time_type::clock::now();
    for (const std::string& name : internal::NamesIn(cache_.directory)) {
      const fs::path path = fs::path(cache_.directory) / name;
      std::error_code gone;
      const fs::file_time_type used = fs::last_write_time(path, gone);
      const std::uintmax_t bytes = gone ? 0 : fs::file_size(path, gone);
      if (gone) continue;
      if (name.rfind(kTemporary, 0) == 0 && now - used > kAbandoned) {
        fs::remove(path, gone);
        continue;
      }
      if (path.extension() != kCacheExtension) continue;
      entries.push_back({used, bytes, path});
      total += bytes;
    }
    std::sort(entries.begin(), entries.end(),
              [](const Entry& a, const Entry& b) { return a.used < b.used; });
    for (const Entry& entry : entries) {
      if (total <= cache_.max_bytes) return;
      if (entry.path == path_) continue;
      std::error_code gone;
      fs::remove(entry.path, gone);
      total -= entry.bytes;
    }
  }

  ContactSpaceCache cache_;
  CacheFolder folder_;
  std::string name_;
  fs::path path_;
  std::string header_;
  std::string warning_;
};

}  // namespace

std::string DefaultCacheDirectory() {
  const std::string own = FromEnvironment("PHONGPD_CACHE_DIR");
  if (!own.empty()) return own;
  const fs::path shared = FromEnvironment("XDG_CACHE_HOME");
  if (shared.is_absolute()) return (shared / "phongpd").string();
  const fs::path home = FromEnvironment("HOME");
  if (home.is_absolute()) return (home / ".cache" / "phongpd").string();
  return "";
}

namespace {

// Operands are Solids or meshes.
template <typename Operand>
ContactSpace BuildCached(const Operand& robot, const Operand& obstacle,
                         const ContactSpaceOptions& options,
                         const ContactSpaceCache& cache) {
  if (cache.directory.empty()) {
    return BuildContactSpace(robot, obstacle, options);
  }
  CacheFile file(robot, obstacle, options, cache);
  ContactSpace::Parts kept;
  if (file.Read(&kept)) {
    kept.report.from_cache = true;
    try {
      return ContactSpace(std::move(kept));
    } catch (const InputError&) {  // its mesh bounds no solid
      file.SayDamaged();
    }
  }
  ContactSpace built = BuildContactSpace(robot, obstacle, options);
  file.Write(built.parts());
  if (file.warning().empty()) return built;
  ContactSpace::Parts parts = built.parts();
  parts.report.warnings.push_back(file.warning());
  return ContactSpace(std::move(parts));
}

}  // namespace

ContactSpace BuildContactSpaceCached(const Solid& robot, const Solid& obstacle,
                                     const ContactSpaceOptions& options,
                                     const ContactSpaceCache& cache) {
  // The names are in the report, and so in the key.
  return BuildCached(robot, obstacle,
                     internal::WithNames(options, robot, obstacle), cache);
}

ContactSpace BuildContactSpaceCached(const TriangleMesh& robot,
                                     const TriangleMesh& obstacle,
                                     const ContactSpaceOptions& options,
                                     const ContactSpaceCache& cache) {
  return BuildCached(robot, obstacle, options, cache);
}

}  // namespace phongpd
