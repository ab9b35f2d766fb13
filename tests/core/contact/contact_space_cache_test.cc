// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact/contact_space_cache.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "core/contact/content_hash.h"
#include "problems/shapes/shapes.h"
#include "tests/support/same_space.h"
#include "tests/support/temporary_folder.h"

namespace phongpd {
namespace {

namespace fs = std::filesystem;

void Overwrite(const fs::path& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}

bool SameBits(const TriangleMesh& a, const TriangleMesh& b) {
  return a.triangles == b.triangles && a.vertices == b.vertices;
}

// All of it, but for from_cache and warnings.
void ExpectEqual(const ContactSpace& a, const ContactSpace& b) {
  EXPECT_EQ(testing::DifferenceOf(a, b), "");
  const ContactSpaceReport &r = a.report(), &s = b.report();
  EXPECT_EQ(r.seconds, s.seconds);
  EXPECT_EQ(r.peak_mib, s.peak_mib);
  EXPECT_EQ(r.method, s.method);
  EXPECT_EQ(r.arrangement_faces, s.arrangement_faces);
  EXPECT_EQ(r.judged_cells, s.judged_cells);
  EXPECT_EQ(r.grid_step, s.grid_step);
  EXPECT_EQ(r.predicted.seconds, s.predicted.seconds);
  EXPECT_EQ(r.canonical_frame, s.canonical_frame);
  EXPECT_EQ(r.robot.inverted_components, s.robot.inverted_components);
  EXPECT_EQ(r.robot.warnings, s.robot.warnings);
  EXPECT_EQ(r.obstacle.volume, s.obstacle.volume);
}

class ContactSpaceCacheTest : public testing::TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    cache_.directory = At("a/b");
  }

  ContactSpace Build(const ContactSpaceOptions& options = {}) const {
    return BuildContactSpaceCached(robot_, obstacle_, options, cache_);
  }
  std::vector<fs::path> Files() const {
    std::vector<fs::path> files;
    if (!fs::exists(cache_.directory)) return files;
    for (const auto& entry : fs::directory_iterator(cache_.directory)) {
      files.push_back(entry.path());
    }
    return files;
  }

  ContactSpaceCache cache_;
  TriangleMesh robot_ = MakeBox({-0.1, -0.1, -0.1}, {0.3, 0.4, 0.5});
  TriangleMesh obstacle_ = MakeL(3, 1, 1);
};

TEST_F(ContactSpaceCacheTest, GivesWhatTheBuildGaveBitForBit) {
  // Inside out, so that the report has something to say.
  robot_ = Reversed(robot_);
  ContactSpaceOptions options;
  const ContactSpace built = Build(options);
  const ContactSpace cached = Build(options);
  EXPECT_FALSE(built.report().from_cache);
  EXPECT_TRUE(cached.report().from_cache);
  EXPECT_FALSE(built.report().warnings.empty());
  EXPECT_EQ(built.report().warnings, cached.report().warnings);
  ExpectEqual(built, cached);
  EXPECT_TRUE(SameBits(cached.mesh(),
                       BuildContactSpace(robot_, obstacle_, options).mesh()));
  EXPECT_EQ(Files().size(), 1U);
}

TEST_F(ContactSpaceCacheTest, IsOffWithoutADirectory) {
  cache_.directory.clear();
  Build();
  EXPECT_FALSE(Build().report().from_cache);
}

TEST_F(ContactSpaceCacheTest, AnyChangedBitOfTheOperandsMisses) {
  Build();
  const auto misses = [&](const std::function<void()>& change) {
    const TriangleMesh robot = robot_, obstacle = obstacle_;
    change();
    const bool missed = !Build().report().from_cache;
    robot_ = robot;
    obstacle_ = obstacle;
    return missed && Build().report().from_cache;
  };
  for (Eigen::Vector3d& vertex : robot_.vertices) {
    for (double& x : vertex) {
      EXPECT_TRUE(misses([&] { x = std::nextafter(x, 10.0); }));
    }
  }
  EXPECT_TRUE(misses([&] { obstacle_.vertices[3][1] *= 1 + 1e-15; }));
  EXPECT_TRUE(misses([&] {
    Triangle& t = obstacle_.triangles[0];
    t = {t[1], t[2], t[0]};
  }));
  EXPECT_TRUE(misses(
      [&] { std::swap(obstacle_.triangles[0], obstacle_.triangles[1]); }));
  EXPECT_TRUE(misses([&] { std::swap(robot_, obstacle_); }));
}

TEST_F(ContactSpaceCacheTest, AnyChangedOptionMisses) {
  ContactSpaceOptions options;
  Build(options);
  // An option that is missing here does not compile.
  auto& [merge_coplanar, outer_shell_only, repair, wrap_alpha, robot_hull,
         target_faces, max_seconds, max_mib, robot_name, obstacle_name] =
      options;
  const std::vector<std::function<void()>> changes = {
      [&o = merge_coplanar] { o = !o; },    [&o = outer_shell_only] { o = !o; },
      [&o = repair] { o = Repair::kSafe; }, [&o = wrap_alpha] { o = 0.2; },
      [&o = robot_hull] { o = !o; },        [&o = target_faces] { o = 100; },
      [&o = max_seconds] { o = 1e6; },      [&o = max_mib] { o = 1e6; },
      [&o = robot_name] { o += "s"; },      [&o = obstacle_name] { o += "s"; },
  };
  for (std::size_t i = 0; i < changes.size(); ++i) {
    changes[i]();
    EXPECT_FALSE(Build(options).report().from_cache) << "change " << i;
    EXPECT_TRUE(Build(options).report().from_cache) << "change " << i;
  }
}

TEST_F(ContactSpaceCacheTest, DamagedFilesAreFoundReplacedAndNamed) {
  const ContactSpace built = Build();
  ASSERT_EQ(Files().size(), 1U);
  const fs::path file = Files()[0];
  const std::string good = Content(file);
  ASSERT_GT(good.size(), 500U);
  const auto expect_rebuilt = [&](const std::string& what) {
    const ContactSpace again = Build();
    EXPECT_FALSE(again.report().from_cache) << what;
    EXPECT_TRUE(SameBits(again.mesh(), built.mesh())) << what;
    ASSERT_EQ(again.report().warnings.size(), 1U) << what;
    EXPECT_NE(again.report().warnings[0].find(file.string()),
              std::string::npos);
    const ContactSpace after = Build();
    EXPECT_TRUE(after.report().from_cache) << what;
    EXPECT_TRUE(after.report().warnings.empty()) << what;
  };
  for (std::size_t i = 0; i < good.size(); i += i < 150 ? 1 : 41) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ (1 << (i % 8)));
    Overwrite(file, bad);
    expect_rebuilt("bit flipped in byte " + std::to_string(i));
  }
  for (std::size_t size = 0; size < good.size(); size += 97) {
    Overwrite(file, good.substr(0, size));
    expect_rebuilt("cut to " + std::to_string(size));
  }
  Overwrite(file, good + '\0');
  expect_rebuilt("one byte more");
  Overwrite(file, std::string(good.size(), '\xff'));
  expect_rebuilt("all ones");
  // The result of something else, whole but under this name.
  obstacle_ = MakeBox({-2, -2, -2}, {2, 2, 2});
  Build();
  fs::path other = Files()[0] == file ? Files()[1] : Files()[0];
  obstacle_ = MakeL(3, 1, 1);
  fs::rename(other, file);
  expect_rebuilt("another result");
}

TEST_F(ContactSpaceCacheTest, UnusableDirectoriesAreNoError) {
  Overwrite(folder_ / "file", "not a directory");
  for (const fs::path& path :
       {folder_ / "file", folder_ / "file" / "cache",
        fs::path("/proc/self/cache"), fs::path(std::string(300, 'x'))}) {
    cache_.directory = path.string();
    for (int i = 0; i < 2; ++i) {
      const ContactSpace space = Build();
      EXPECT_TRUE(space.report().closed);
      EXPECT_FALSE(space.report().from_cache);
      EXPECT_TRUE(space.report().warnings.empty());
    }
  }
  // A directory in the place of the file.
  cache_.directory = (folder_ / "c").string();
  Build();
  const fs::path file = Files()[0];
  fs::remove(file);
  fs::create_directories(file / "sub");
  EXPECT_TRUE(Build().report().closed);
}

TEST_F(ContactSpaceCacheTest, IsForTheUserAlone) {
  const mode_t before = umask(0);
  Build();
  umask(before);
  const auto mode = [](const fs::path& path) {
    struct stat status = {};
    EXPECT_EQ(lstat(path.c_str(), &status), 0) << path;
    return status.st_mode & 07777U;
  };
  EXPECT_EQ(mode(folder_ / "a"), 0700U);
  EXPECT_EQ(mode(folder_ / "a" / "b"), 0700U);
  ASSERT_EQ(Files().size(), 1U);
  EXPECT_EQ(mode(Files()[0]), 0600U);
}

TEST_F(ContactSpaceCacheTest, WhatOthersMayChangeIsNamedAndNotUsed) {
  Build();
  const fs::path file = Files()[0];
  const auto expect_warning = [&](const fs::path& name, const std::string& what,
                                  const std::string& word) {
    const ContactSpace space = Build();
    EXPECT_FALSE(space.report().from_cache) << what;
    ASSERT_EQ(space.report().warnings.size(), 1U) << what;
    const std::string& warning = space.report().warnings[0];
    EXPECT_NE(warning.find(name.string()), std::string::npos) << warning;
    EXPECT_NE(warning.find(word), std::string::npos) << warning;
  };
  const fs::path directory = cache_.directory;
  for (const auto mode : {fs::perms::group_write, fs::perms::others_write}) {
    fs::permissions(directory, mode, fs::perm_options::add);
    expect_warning(directory, "folder", "is not used");
    fs::permissions(directory, mode, fs::perm_options::remove);
    EXPECT_TRUE(Build().report().from_cache);
    fs::permissions(file, mode, fs::perm_options::add);
    expect_warning(file, "file", "is not used");
    EXPECT_TRUE(Build().report().from_cache) << "replaced by the user's own";
  }
  if (geteuid() != 0) return;  // only root can give files away
  ASSERT_EQ(chown(file.c_str(), 12345, 12345), 0);
  expect_warning(file, "file of another user", "is not used");
  ASSERT_EQ(chown(directory.c_str(), 12345, 12345), 0);
  expect_warning(directory, "folder of another user", "is not used");
  ASSERT_EQ(chown(directory.c_str(), 0, 0), 0);
  fs::create_directory_symlink(directory, folder_ / "link");
  cache_.directory = (folder_ / "link").string();
  EXPECT_TRUE(Build().report().from_cache) << "a link of one's own";
  ASSERT_EQ(lchown(cache_.directory.c_str(), 12345, 12345), 0);
  expect_warning(cache_.directory, "link of another user", "is not used");
}

// A link in the place of a file is neither read nor written through.
TEST_F(ContactSpaceCacheTest, LinksAreNotFollowed) {
  Build();
  const fs::path file = Files()[0];
  const fs::path elsewhere = folder_ / "elsewhere";
  fs::rename(file, elsewhere);
  const std::string content = Content(elsewhere);
  fs::create_symlink(elsewhere, file);
  const ContactSpace space = Build();
  EXPECT_FALSE(space.report().from_cache);
  ASSERT_EQ(space.report().warnings.size(), 1U);
  EXPECT_EQ(Content(elsewhere), content);
  EXPECT_FALSE(fs::is_symlink(file));
  EXPECT_TRUE(Build().report().from_cache);
}

// What a killed process left goes at once, not after an hour.
TEST_F(ContactSpaceCacheTest, AbandonedTemporariesGoWithTheNextResult) {
  ContactSpaceOptions options;
  Build(options);
  const fs::path left = fs::path(cache_.directory) /
                        ("unfinished-" + std::string(32, '0') + ".part");
  Overwrite(left, "torn");
  options.robot_name = "another";
  Build(options);
  EXPECT_FALSE(fs::exists(left));
}

TEST_F(ContactSpaceCacheTest, RemovesTheLongestUnusedFilesFirst) {
  const auto build = [&](int i) {
    ContactSpaceOptions options;
    options.robot_name = std::string(1, static_cast<char>('a' + i));
    return Build(options).report().from_cache;
  };
  const auto age = [&](const fs::path& path, int hours) {
    fs::last_write_time(
        path, fs::file_time_type::clock::now() - std::chrono::hours(hours));
  };
  build(0);
  const fs::path first = Files()[0];
  const std::uintmax_t bytes = fs::file_size(first);
  build(1);
  const fs::path second = Files()[0] == first ? Files()[1] : Files()[0];
  age(first, 5);
  age(second, 4);
  EXPECT_TRUE(build(0));  // used now
  // Left behind by a process that was killed; and something of the user's.
  const fs::path left = fs::path(cache_.directory) / "unfinished-abc";
  const fs::path foreign = fs::path(cache_.directory) / "notes.txt";
  Overwrite(left, "x");
  Overwrite(foreign, std::string(10 * bytes, 'x'));
  age(left, 3);
  age(foreign, 9);
  cache_.max_bytes = 2 * bytes + bytes / 2;
  EXPECT_FALSE(build(2));
  EXPECT_FALSE(fs::exists(second));
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(foreign));
  EXPECT_TRUE(build(0));
  EXPECT_TRUE(build(2));
  EXPECT_EQ(Files().size(), 3U);
  // What does not fit at all is not kept, and evicts nothing.
  cache_.max_bytes = bytes - 1;
  EXPECT_FALSE(build(3));
  EXPECT_EQ(Files().size(), 3U);
}

TEST_F(ContactSpaceCacheTest, IsSharedByThreads) {
  const ContactSpace built = BuildContactSpace(robot_, obstacle_);
  cache_.max_bytes = 20000;  // files come and go
  std::vector<std::thread> threads;
  std::vector<int> wrong(4, 0);
  for (std::size_t i = 0; i < wrong.size(); ++i) {
    threads.emplace_back([&, i] {
      for (int round = 0; round < 30; ++round) {
        ContactSpaceOptions options;
        options.robot_name = std::to_string(round % 7);
        const ContactSpace space = Build(options);
        wrong[i] += !SameBits(space.mesh(), built.mesh()) ||
                    !space.report().warnings.empty();
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

TEST(ContactSpaceCache, DirectoryComesFromTheEnvironment) {
  const auto set = [](const char* name, const char* value) {
    setenv(name, value, 1);
  };
  set("PHONGPD_CACHE_DIR", "own");
  set("XDG_CACHE_HOME", "/x");
  set("HOME", "/h");
  EXPECT_EQ(DefaultCacheDirectory(), "own");
  set("PHONGPD_CACHE_DIR", "");
  EXPECT_EQ(DefaultCacheDirectory(), "/x/phongpd");
  set("XDG_CACHE_HOME", "relative");
  EXPECT_EQ(DefaultCacheDirectory(), "/h/.cache/phongpd");
  unsetenv("XDG_CACHE_HOME");
  EXPECT_EQ(DefaultCacheDirectory(), "/h/.cache/phongpd");
  unsetenv("HOME");
  unsetenv("PHONGPD_CACHE_DIR");
  EXPECT_EQ(DefaultCacheDirectory(), "");
}

TEST(ContentHash, IsTheOneItSaysItIs) {
  const auto hash = [](const char* text) {
    return internal::ToHex(internal::HashContent(text));
  };
  EXPECT_EQ(hash(""), "00000000000000000000000000000000");
  EXPECT_EQ(hash("hello"), "cbd8a7b341bd9b025b1e906a48ae1d19");
  EXPECT_EQ(hash("The quick brown fox jumps over the lazy dog"),
            "e34bbc7bbc071b6c7a433ca9c49a9347");
}

}  // namespace
}  // namespace phongpd
