// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact_space/contact_space_cache.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/contact_space/byte_stream.h"
#include "core/contact_space/contact_space_bytes.h"
#include "core/contact_space/content_hash.h"

namespace phongpd {
namespace {

namespace fs = std::filesystem;

const char kExtension[] = ".contact-space";
const char kTemporary[] = "unfinished-";
// Written by a process that is gone, when this old.
constexpr std::chrono::hours kAbandoned(1);

std::string FromEnvironment(const char* name) {
  const char* const value = std::getenv(name);
  return value != nullptr ? value : "";
}

// One cached result: a header that says what it is the result of, then the
// size and checksum of what follows, then that.
class CacheFile {
 public:
  CacheFile(const TriangleMesh& robot, const TriangleMesh& obstacle,
            const ContactSpaceOptions& options, const ContactSpaceCache& cache)
      : cache_(cache) {
    const internal::ContentHash key =
        internal::HashContent(internal::KeyBytes(robot, obstacle, options));
    path_ = fs::path(cache.directory) / (internal::ToHex(key) + kExtension);
    // The counts catch what little the hash may miss.
    internal::ByteWriter writer;
    writer(std::string("phongpd contact space"), key, robot.vertices.size(),
           robot.triangles.size(), obstacle.vertices.size(),
           obstacle.triangles.size());
    header_ = writer.Take();
  }

  const fs::path& path() const { return path_; }

  enum Outcome { kAbsent, kDamaged, kRead };
  Outcome Read(ContactSpace* space) const {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(path_, error);
    if (error) return kAbsent;
    if (size > cache_.max_bytes) return kDamaged;
    std::ifstream stream(path_, std::ios::binary);
    if (!stream) return kAbsent;
    std::string bytes(static_cast<std::size_t>(size), '\0');
    stream.read(bytes.data(), static_cast<std::streamsize>(size));
    if (static_cast<std::uintmax_t>(stream.gcount()) != size) return kDamaged;
    const std::string_view all(bytes);
    const std::size_t start = header_.size() + kSealBytes;
    if (all.size() < start) return kDamaged;
    const std::string_view content = all.substr(start);
    if (all.substr(0, start) != header_ + Seal(content) ||
        !internal::FromBytes(content, space)) {
      return kDamaged;
    }
    // Now it is not the longest unused one.
    fs::last_write_time(path_, fs::file_time_type::clock::now(), error);
    return kRead;
  }

  void Write(const ContactSpace& space) const {
    const std::string content = internal::ToBytes(space);
    const std::string bytes = header_ + Seal(content) + content;
    if (bytes.size() > cache_.max_bytes) return;
    std::error_code error;
    fs::create_directories(cache_.directory, error);
    std::string name =
        (fs::path(cache_.directory) / (kTemporary + std::string("XXXXXX")))
            .string();
    const int descriptor = mkstemp(name.data());
    if (descriptor < 0) return;
    close(descriptor);
    std::ofstream stream(name, std::ios::binary);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    stream.close();
    if (stream) {
      fs::rename(name, path_, error);
      if (!error) return Trim();
    }
    fs::remove(name, error);
  }

 private:
  static constexpr std::size_t kSealBytes = 3 * sizeof(std::uint64_t);
  static std::string Seal(std::string_view content) {
    internal::ByteWriter writer;
    writer(static_cast<std::uint64_t>(content.size()),
           internal::HashContent(content));
    return writer.Take();
  }

  // Other processes may remove files meanwhile: errors mean no more than that.
  void Trim() const {
    struct Entry {
      fs::file_time_type used;
      std::uintmax_t bytes;
      fs::path path;
    };
    std::vector<Entry> entries;
    std::uintmax_t total = 0;
    const auto now = fs::file_time_type::clock::now();
    std::error_code error;
    for (fs::directory_iterator it(cache_.directory, error), end;
         !error && it != end; it.increment(error)) {
      std::error_code gone;
      const fs::file_time_type used = it->last_write_time(gone);
      const std::uintmax_t bytes = gone ? 0 : it->file_size(gone);
      if (gone) continue;
      const std::string name = it->path().filename().string();
      if (name.rfind(kTemporary, 0) == 0 && now - used > kAbandoned) {
        fs::remove(it->path(), gone);
      }
      if (it->path().extension() != kExtension) continue;
      entries.push_back({used, bytes, it->path()});
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
  fs::path path_;
  std::string header_;
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

ContactSpace BuildContactSpaceCached(const TriangleMesh& robot,
                                     const TriangleMesh& obstacle,
                                     const ContactSpaceOptions& options,
                                     const ContactSpaceCache& cache) {
  if (cache.directory.empty()) {
    return BuildContactSpace(robot, obstacle, options);
  }
  const CacheFile file(robot, obstacle, options, cache);
  ContactSpace space;
  const CacheFile::Outcome outcome = file.Read(&space);
  if (outcome == CacheFile::kRead) {
    space.report.from_cache = true;
    return space;
  }
  space = BuildContactSpace(robot, obstacle, options);
  file.Write(space);
  if (outcome == CacheFile::kDamaged) {
    space.report.warnings.push_back("the cache file " + file.path().string() +
                                    " was damaged and has been replaced");
  }
  return space;
}

}  // namespace phongpd
