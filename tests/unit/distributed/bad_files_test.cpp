// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Errors in files are reported with their place, and with the messages of a run in memory.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "rondel/error.h"
#include "rondel/out_of_core.h"
#include "support/temporary_files.h"
#include "unit/distributed/support.h"

namespace rondel::test {
namespace {

class distributed_bad_files : public testing::Test {
 protected:
  [[nodiscard]] std::string message(const std::string& sites, const Options& options = {}) const {
    OutOfCoreOptions out_of_core;
    out_of_core.scratch = folder_.file("scratch");
    return message_of([&] {
      delaunay_file(sites, {folder_.file("faces.npy")}, out_of_core, options, {.threads = 2});
    });
  }

  TemporaryDirectory folder_;
};

TEST_F(distributed_bad_files, name_the_first_row) {
  std::vector<Point> sites = generator("uniform").make(200000, 1).sites;
  sites[150001].y = std::numeric_limits<double>::infinity();
  sites[170000] = {0, 0, 0};
  sites[199999].x = std::nan("");
  const std::string path = folder_.file("sites.npy");
  write_sites(path, sites);
  EXPECT_TRUE(message(path).starts_with(path + ": row 150001: "));
  EXPECT_EQ(message(path), message_of([&] { read_sites(path); }));
  EXPECT_FALSE(std::filesystem::exists(folder_.file("scratch")));
  sites.resize(180000);
  sites[150001] = {1, 0, 0};
  write_sites(path, sites);
  EXPECT_EQ(message(path), path +
                               ": row 170000: site 170000: (0, 0, 0) is the center of the sphere "
                               "and has no projection");
  EXPECT_EQ(message(path, {.model = Model::weighted}), "");
}

TEST_F(distributed_bad_files, are_no_arrays) {
  const auto at = [&](const std::string& path) { return message(path); };
  EXPECT_EQ(at(folder_.file("none.npy")), folder_.file("none.npy") + ": No such file or directory");
  EXPECT_EQ(at(folder_.with("empty.npy", "")), folder_.file("empty.npy") + ": the file is empty");
  EXPECT_EQ(at(folder_.with("text.npy", "lon,lat\n1,2\n")),
            folder_.file("text.npy") + ": not a .npy file");
  for (const auto& file : files_in(corpus / "bad")) {
    if (file.extension() != ".npy") continue;
    EXPECT_EQ(at(file.string()), message_of([&] { read_sites(file.string()); })) << file;
  }
}

TEST_F(distributed_bad_files, cannot_be_written) {
  write_sites(folder_.file("sites.npy"), octahedron);
  OutOfCoreOptions out_of_core;
  out_of_core.scratch = folder_.file("scratch");
  const std::string missing = folder_.file("none/faces.npy");
  EXPECT_EQ(message_of([&] { delaunay_file(folder_.file("sites.npy"), {missing}, out_of_core); }),
            missing + ": No such file or directory");
  out_of_core.scratch = folder_.with("file", "x") + "/scratch";
  EXPECT_TRUE(message_of([&] {
                delaunay_file(folder_.file("sites.npy"), {folder_.file("f.npy")}, out_of_core);
              }).starts_with(out_of_core.scratch + ": "));
}

TEST_F(distributed_bad_files, are_one_file) {
  write_sites(folder_.file("sites.npy"), octahedron);
  const std::string sites = folder_.file("sites.npy");
  const std::string faces = folder_.file("f.npy");
  OutOfCoreOptions out_of_core;
  out_of_core.scratch = folder_.file("scratch");
  EXPECT_EQ(message_of([&] { delaunay_file(sites, {sites}, out_of_core); }),
            sites + ": the file of the sites, too");
  EXPECT_EQ(message_of([&] {
              delaunay_file(sites, {faces, faces}, out_of_core);
            }),
            faces + ": the file of another result, too");
  const std::string text = folder_.file("areas.txt");
  EXPECT_EQ(message_of([&] {
              delaunay_file(sites, {faces, "", text}, out_of_core);
            }),
            text + ": results are .npy files");
  EXPECT_FALSE(std::filesystem::exists(faces));
  const std::string group = folder_.file("mesh.zarr");
  for (const OutOfCoreFiles& files : {OutOfCoreFiles{group}, OutOfCoreFiles{faces, group}}) {
    EXPECT_EQ(message_of([&] { delaunay_file(sites, files, out_of_core); }),
              group +
                  ": Zarr groups are written in Python, by rondel.out_of_core.delaunay; here "
                  "results are .npy files");
  }
  EXPECT_FALSE(std::filesystem::exists(out_of_core.scratch));
  EXPECT_EQ(read_sites(sites).sites.size(), octahedron.size());
}

TEST_F(distributed_bad_files, need_memory) {
  write_sites(folder_.file("sites.npy"), octahedron);
  OutOfCoreOptions out_of_core;
  out_of_core.scratch = folder_.file("scratch");
  out_of_core.memory = 1000;
  EXPECT_THROW(delaunay_file(folder_.file("sites.npy"), {folder_.file("f.npy")}, out_of_core),
               InvalidInput);
  EXPECT_FALSE(std::filesystem::exists(out_of_core.scratch));
  // Places that no square can tell apart, more than there is room for.
  Random random(1);
  std::vector<Point> sites;
  for (int i = 0; i < 300; ++i) sites.push_back(random_near(random, {1, 0.3, 0.2}, 1e-10));
  const FileCase files(sites, {});
  const std::string crowd = message_of([&] { files.run({100, 50, 1000, 50}); });
  EXPECT_TRUE(crowd.starts_with("of 300 sites within 2^-28 rad of each other, row ")) << crowd;
  EXPECT_TRUE(
      crowd.ends_with(" among them, more than 50 are in different places: for all of them "
                      "96 MB of memory are enough, then the run can be resumed"))
      << crowd;
  for (const std::uint64_t size : {200'000U, 1'000'000U, 700'000'000U}) {
    const auto memory = std::stoull(distributed::memory_of_crowd(size));
    EXPECT_GE(distributed::limits_of(memory << 20U).max_num_sites, size);
    EXPECT_LT(distributed::limits_of((memory - 1) << 20U).max_num_sites, size);
  }
}

}  // namespace
}  // namespace rondel::test
