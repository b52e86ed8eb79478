// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Runs that end early, and those that go on with what is left.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "distributed/journal.h"
#include "rondel/error.h"
#include "unit/distributed/support.h"

namespace rondel::test {
namespace {

constexpr distributed::RunLimits limits = {100, 100, 100000, 150};

std::vector<Point> some_sites() {
  std::vector<Point> sites = generator("uniform").make(600, 4).sites;
  sites.insert(sites.end(), sites.begin(), sites.begin() + 60);
  return sites;
}

// Ends when the progress was told so often; says whether it came to its end before.
bool run_until(const FileCase& files, int max_calls, bool resume) {
  struct Killed {};
  int num_calls = 0;
  Execution execution = {.threads = 1};
  execution.progress = [&](std::string_view /*stage*/, double /*fraction*/) {
    if (++num_calls > max_calls) throw Killed();
  };
  try {
    files.run(limits, resume, execution);
    return true;
  } catch (const Killed&) {
    return false;
  }
}

// At every moment at which a run tells its progress.
TEST(distributed_resume, goes_on_from_everywhere) {
  const FileCase files(some_sites(), {});
  for (int max_calls = 0;; ++max_calls) {
    SCOPED_TRACE(max_calls);
    if (run_until(files, max_calls, false)) break;
    EXPECT_FALSE(std::filesystem::exists(files.files().faces));
    const OutOfCoreReport report = files.run(limits, true);
    files.compare(report);
    for (const std::string& path : {files.files().faces, files.files().neighbors})
      std::filesystem::remove(path);
    ASSERT_LT(max_calls, 1000);
  }
}

// Each does some steps; to join and to write, which is not kept, is as many as each may do.
TEST(distributed_resume, comes_to_its_end_in_many_runs) {
  const FileCase files(some_sites(), {});
  const int max_calls = static_cast<int>(files.run(limits).num_buckets) + 1;
  std::filesystem::remove(files.files().faces);
  int num_runs = 1;
  while (!run_until(files, max_calls, true)) ASSERT_LT(++num_runs, 100);
  EXPECT_GT(num_runs, 2);
  EXPECT_TRUE(rows_of(files.files().faces).numbers == numbers_of(files.expected().faces()));
}

TEST(distributed_resume, counts_what_was_done) {
  const FileCase files(some_sites(), {});
  const auto fails_in_the_end = [&] {
    distributed::RunLimits few = limits;
    few.max_open_sites = 3;
    files.run(few);
  };
  const std::string message = message_of(fails_in_the_end);
  EXPECT_TRUE(message.find("sites reach beyond every bucket") != std::string::npos) << message;
  const OutOfCoreReport report = files.run(limits, true);
  EXPECT_GT(report.num_buckets, 6U);
  EXPECT_EQ(report.num_resumed, report.num_buckets);
  files.compare(report);
}

// What was damaged meanwhile is done again.
TEST(distributed_resume, finds_what_is_lost) {
  for (const char* name : {"sites", "faces", "borders", "journal"}) {
    // Cut at many places, or changed there.
    for (int part = 0; part < 20; ++part) {
      SCOPED_TRACE(std::string(name) + " " + std::to_string(part));
      const FileCase files(some_sites(), {});
      ASSERT_FALSE(run_until(files, 18, false));
      const std::string path = files.folder().file("scratch") + "/" + name;
      std::string bytes = read_all(path);
      const std::size_t place = bytes.size() * static_cast<std::size_t>(part / 2) / 10;
      if (place >= bytes.size()) continue;
      if (part % 2 == 0) {
        bytes.resize(place);
      } else {
        bytes[place] = static_cast<char>(bytes[place] ^ 1);
      }
      std::ofstream(path, std::ios::binary) << bytes;
      files.compare(files.run(limits, true));
    }
  }
}

TEST(distributed_resume, asks_before_it_goes_on) {
  const FileCase files(some_sites(), {});
  ASSERT_FALSE(run_until(files, 12, false));
  const std::string journal = files.folder().file("scratch") + "/journal";
  EXPECT_EQ(message_of([&] { files.run(limits); }),
            journal + ": a run that has not come to its end; resume it, or remove the directory");
  // Nothing is lost by that.
  files.compare(files.run(limits, true));
}

TEST(distributed_resume, is_for_the_same_sites_and_options) {
  const FileCase files(some_sites(), {});
  ASSERT_FALSE(run_until(files, 12, false));
  const std::string scratch = files.folder().file("scratch");
  const std::string sites = files.folder().file("sites.npy");
  const auto difference = [&](const std::string& path, const OutOfCoreFiles& results,
                              const Options& options, bool radians = false) {
    OutOfCoreOptions out_of_core;
    out_of_core.scratch = scratch;
    out_of_core.resume = true;
    out_of_core.radians = radians;
    const std::string message =
        message_of([&] { delaunay_file(path, results, out_of_core, options); });
    const std::string begin = scratch + "/journal: a run with ";
    EXPECT_TRUE(message.starts_with(begin)) << message;
    return message.substr(std::min(begin.size(), message.size()));
  };
  EXPECT_EQ(difference(sites, files.files(), {.model = Model::weighted}),
            "other options: the model");
  EXPECT_EQ(difference(sites, files.files(), {.sphere = {{1, 0, 0}, 1}}),
            "other options: the sphere");
  EXPECT_EQ(difference(sites, files.files(), {}, true), "other options: degrees or radians");
  EXPECT_EQ(difference(sites, {files.files().faces}, {}),
            "other options: the results that are wanted");
  const std::string others = files.folder().file("others.npy");
  write_sites(others, generator("uniform").make(100, 4).sites);
  EXPECT_EQ(difference(others, files.files(), {}), "other sites: the file has another size");
  const auto time = std::filesystem::last_write_time(sites);
  std::filesystem::last_write_time(sites, time + std::chrono::seconds(1));
  EXPECT_EQ(difference(sites, files.files(), {}),
            "other sites: the file was changed at another time");
  std::filesystem::last_write_time(sites, time);
  files.compare(files.run(limits, true));
}

// The number of its format, the third word of the first record, behind mark and head.
TEST(distributed_resume, is_not_for_another_version) {
  const FileCase files(some_sites(), {});
  ASSERT_FALSE(run_until(files, 12, false));
  const std::string path = files.folder().file("scratch") + "/journal";
  std::uint64_t version = 0;
  {
    distributed::Journal journal(path);
    std::vector<distributed::Words> records = journal.records();
    version = records[0][2]++;
    journal.clear();
    for (const distributed::Words& record : records) journal.append(record);
  }
  EXPECT_EQ(version, 2U);
  EXPECT_EQ(message_of([&] { files.run(limits, true); }),
            path + ": a run with another version of Rondel");
}

TEST(distributed_resume, is_not_for_two_at_once) {
  const FileCase files(some_sites(), {});
  std::string message;
  Execution execution = {.threads = 1};
  execution.progress = [&](std::string_view /*stage*/, double /*fraction*/) {
    if (message.empty()) message = message_of([&] { files.run(limits, true); });
  };
  files.compare(files.run(limits, false, execution));
  EXPECT_EQ(message, files.folder().file("scratch") + "/journal: another process works here");
}

TEST(distributed_resume, obeys_the_flag) {
  const FileCase files(some_sites(), {});
  std::atomic<bool> stop = false;
  Execution execution = {.threads = 1, .stop = &stop};
  execution.progress = [&](std::string_view stage, double fraction) {
    if (stage == "triangulate" && fraction > 0.5) stop = true;
  };
  const system::Call call(execution);
  EXPECT_THROW(files.run(limits, false, execution), Interrupted);
  const system::Call other(Execution{});
  files.compare(files.run(limits, true));
}

}  // namespace
}  // namespace rondel::test
