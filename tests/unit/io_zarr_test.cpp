// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Zarr groups: what is in their files, and folders that appear complete or not at all.
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "io/zarr_mesh.h"
#include "io_support.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"

namespace rondel::test {
namespace {

namespace fs = std::filesystem;

std::vector<Point> random_sites(std::size_t n, double height = 0) {
  std::mt19937_64 random(7);
  std::normal_distribution<> normal;
  std::vector<Point> sites(n);
  for (Point& p : sites) p = {normal(random), normal(random), normal(random) + height};
  return sites;
}

// The numbers of an array of a group, read as the specification of Zarr says: the chunks of its grid
// one after the other, less what is beyond its shape.
template <class Number>
std::vector<Number> read_array(const fs::path& group, const std::string& name) {
  const auto head = nlohmann::json::parse(read_all(group / name / "zarr.json"));
  const auto shape = head["shape"].get<std::vector<std::size_t>>();
  const auto chunk =
      head["chunk_grid"]["configuration"]["chunk_shape"].get<std::vector<std::size_t>>();
  EXPECT_EQ(head["codecs"].dump(), R"([{"configuration":{"endian":"little"},"name":"bytes"}])");
  EXPECT_EQ(head["chunk_key_encoding"].dump(),
            R"({"configuration":{"separator":"."},"name":"default"})");
  const std::size_t width = shape.size() == 2 ? shape[1] : 1;
  EXPECT_EQ(shape.size() == 2 ? chunk[1] : 1, width);
  std::vector<Number> numbers;
  for (std::size_t row = 0, i = 0; row < shape[0]; row += chunk[0], ++i) {
    const std::string key = "c." + std::to_string(i) + (shape.size() == 2 ? ".0" : "");
    const std::string bytes = read_all(group / name / key);
    EXPECT_EQ(bytes.size(), chunk[0] * width * sizeof(Number)) << key;
    const std::size_t begin = numbers.size();
    numbers.resize(begin + std::min(chunk[0], shape[0] - row) * width);
    std::memcpy(&numbers[begin], bytes.data(), (numbers.size() - begin) * sizeof(Number));
  }
  return numbers;
}

template <class Number, class Row>
std::vector<Number> flat(std::span<const Row> rows) {
  std::vector<Number> numbers(rows.size_bytes() / sizeof(Number));
  if (!rows.empty()) std::memcpy(numbers.data(), rows.data(), rows.size_bytes());
  return numbers;
}

std::vector<std::string> content_of(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    names.push_back(entry.path().lexically_relative(folder).string());
  std::ranges::sort(names);
  return names;
}

SiteTable table_of(std::vector<Point> sites) {
  SiteTable table;
  table.sites = std::move(sites);
  return table;
}

TEST(write_zarr, has_all_that_is_wanted) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("mesh.zarr");
  // Of the second, some faces are ghosts; of the third, all sites are copies.
  const std::vector<Point> cap = random_sites(40, 30);
  for (const std::vector<Point>& sites :
       {random_sites(300), cap, std::vector<Point>(5, cap[0]), {}}) {
    const SiteTable table = table_of(sites);
    const Triangulation t = delaunay(table.sites);
    write_zarr(path, table, t, {true, true, true});
    EXPECT_EQ(read_array<Index>(path, "faces"), flat<Index>(t.faces()));
    EXPECT_EQ(read_array<Index>(path, "neighbors"), flat<Index>(t.neighbors()));
    EXPECT_EQ(read_array<Index>(path, "duplicates"), flat<Index>(t.duplicates()));
    EXPECT_EQ(read_array<double>(path, "areas"), areas(t));
    EXPECT_EQ(read_array<double>(path, "sites"), flat<double>(std::span(sites)));
    EXPECT_EQ(fs::exists(fs::path(path) / "ghost_faces"), t.num_ghost_faces() > 0);
    if (t.num_ghost_faces() > 0) {
      EXPECT_EQ(read_array<Index>(path, "ghost_faces"), flat<Index>(t.ghost_faces()));
    }
    EXPECT_EQ(directory.num_files(), 1U);
  }
}

TEST(write_zarr, has_faces_and_sites_alone_unless_more_is_wanted) {
  const TemporaryDirectory directory;
  const SiteTable table = table_of(octahedron);
  write_triangles(directory.file("mesh.zarr"), table, delaunay(table.sites));
  EXPECT_EQ(content_of(directory.file("mesh.zarr")),
            (std::vector<std::string>{
                "faces", "faces/c.0.0", "faces/zarr.json", "mesh", "mesh/zarr.json", "node_lat",
                "node_lat/c.0", "node_lat/zarr.json", "node_lon", "node_lon/c.0",
                "node_lon/zarr.json", "sites", "sites/c.0.0", "sites/zarr.json", "zarr.json"}));
}

// All descriptions are also in that of the group.
TEST(write_zarr, has_consolidated_metadata) {
  const TemporaryDirectory directory;
  const fs::path path = directory.file("mesh.zarr");
  const SiteTable table = table_of(random_sites(20));
  write_zarr(path.string(), table, delaunay(table.sites), {true, true, true});
  const auto group = nlohmann::json::parse(read_all(path / "zarr.json"));
  const auto& metadata = group["consolidated_metadata"]["metadata"];
  EXPECT_EQ(metadata.size(), 8U);
  for (const auto& [name, head] : metadata.items())
    EXPECT_EQ(head, nlohmann::json::parse(read_all(path / name / "zarr.json"))) << name;
  const auto& topology = metadata["mesh"]["attributes"];
  EXPECT_EQ(topology["face_node_connectivity"], "faces");
  EXPECT_EQ(topology["face_face_connectivity"], "neighbors");
  EXPECT_EQ(topology["node_coordinates"], "node_lon node_lat");
}

TEST(write_zarr, has_the_longitudes_and_latitudes_of_rays) {
  const TemporaryDirectory directory;
  const fs::path path = directory.file("mesh.zarr");
  const Point center = {0.5, -2, 1};
  std::vector<Point> sites = random_sites(200);
  for (Point& p : sites) p = {1e3 * p.x + center.x, 1e3 * p.y + center.y, 1e3 * p.z + center.z};
  sites.push_back({center.x, center.y, 7});
  sites.push_back({center.x, center.y, -7});
  sites.push_back({-7, center.y, center.z});
  const SiteTable table = table_of(sites);
  write_zarr(path.string(), table, delaunay(table.sites, {.sphere = {.center = center}}));
  const auto lon = read_array<double>(path, "node_lon");
  const auto lat = read_array<double>(path, "node_lat");
  for (std::size_t i = 0; i < 200; ++i) {
    const long double x = sites[i].x - center.x;
    const long double y = sites[i].y - center.y;
    const long double z = sites[i].z - center.z;
    constexpr long double degrees = 180 / std::numbers::pi_v<long double>;
    EXPECT_NEAR(lon[i], static_cast<double>(std::atan2(y, x) * degrees), 1e-13);
    EXPECT_NEAR(lat[i], static_cast<double>(std::atan2(z, std::hypot(x, y)) * degrees), 1e-13);
  }
  EXPECT_EQ((std::vector<double>(lon.begin() + 200, lon.end())), (std::vector<double>{0, 0, 180}));
  EXPECT_EQ((std::vector<double>(lat.begin() + 200, lat.end())), (std::vector<double>{90, -90, 0}));
}

TEST(write_zarr, keeps_longitudes_as_they_were_given) {
  const TemporaryDirectory directory;
  const std::string lines = "lon,lat\n10,20\n370,90\n-181,0.1\n30,-50\n";
  const SiteTable table = read_sites(directory.with("a.csv", lines));
  write_triangles(directory.file("mesh.zarr"), table, delaunay(table.sites));
  EXPECT_EQ(read_array<double>(directory.file("mesh.zarr"), "node_lon"),
            (std::vector<double>{10, 370, -181, 30}));
  EXPECT_EQ(read_array<double>(directory.file("mesh.zarr"), "node_lat"),
            (std::vector<double>{20, 90, 0.1, -50}));
}

TEST(zarr_array, is_cut_into_equal_chunks) {
  EXPECT_EQ(io::zarr_chunk_rows(0), 1U);
  EXPECT_EQ(io::zarr_chunk_rows(1), 1U);
  EXPECT_EQ(io::zarr_chunk_rows(1U << 20U), 1U << 20U);
  EXPECT_EQ(io::zarr_chunk_rows((1U << 20U) + 1), (1U << 19U) + 1);
  EXPECT_EQ(io::zarr_chunk_rows(std::uint64_t{1} << 40U), 1U << 20U);
  const TemporaryDirectory directory;
  std::vector<Index> numbers((1U << 20U) + 1);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<Index>(7 * i);
  io::ZarrGroup group(directory.file("a.zarr"));
  group.reserve(1000);
  io::ZarrArray array(group, {"faces", "uint32", {numbers.size()}, {"n"}, {}});
  const std::string_view bytes(reinterpret_cast<const char*>(numbers.data()), 4 * numbers.size());
  array.write(bytes.substr(0, 10));
  array.write(bytes.substr(10));
  array.finish();
  EXPECT_FALSE(fs::exists(directory.file("a.zarr")));
  group.commit({});
  EXPECT_EQ(read_array<Index>(directory.file("a.zarr"), "faces"), numbers);
  EXPECT_EQ(content_of(directory.file("a.zarr")),
            (std::vector<std::string>{"faces", "faces/c.0", "faces/c.1", "faces/zarr.json",
                                      "zarr.json"}));
}

// A folder with one of our groups, and what happens to it.
class zarr_folder : public testing::Test {
 protected:
  void write() const { write_zarr(path_, table_, triangulation_); }
  [[nodiscard]] fs::path in_group(const std::string& name) const { return fs::path(path_) / name; }

  // Whatever is in the group stays, and the message says why.
  void expect_refused(const std::string& why) const {
    const auto before = content_of(path_);
    EXPECT_EQ(message_of([&] { write(); }), path_ + ": " + why + "; the folder is not replaced");
    EXPECT_EQ(content_of(path_), before);
    EXPECT_EQ(directory_.num_files(), 1U);
  }

  TemporaryDirectory directory_;
  std::string path_ = directory_.file("mesh.zarr");
  SiteTable table_ = table_of(octahedron);
  Triangulation triangulation_ = delaunay(table_.sites);
};

TEST_F(zarr_folder, is_replaced_if_it_was_made_here) {
  write_zarr(path_, table_, triangulation_, {true, true, true});
  write();
  EXPECT_FALSE(fs::exists(in_group("areas")));
  EXPECT_EQ(directory_.num_files(), 1U);
  write_triangles(FileName(path_ + "/"), table_, triangulation_);
  EXPECT_EQ(directory_.num_files(), 1U);
}

TEST_F(zarr_folder, is_replaced_if_it_is_empty) {
  fs::create_directory(path_);
  write();
  EXPECT_TRUE(fs::exists(in_group("zarr.json")));
}

TEST_F(zarr_folder, stays_if_there_is_something_else_in_it) {
  write();
  for (const char* name :
       {"notes.txt", "temperature", "faces/other", "faces/c.0.0.tmp", "faces/c.."}) {
    std::ofstream(in_group(name)) << "x";
    expect_refused("'" + std::string(name) + "' in it is not ours");
    fs::remove(in_group(name));
  }
  fs::rename(in_group("sites"), directory_.file("elsewhere"));
  fs::create_symlink(directory_.file("elsewhere"), in_group("sites"));
  EXPECT_EQ(message_of([&] { write(); }),
            path_ + ": 'sites' in it is not ours; the folder is not replaced");
  EXPECT_TRUE(fs::exists(directory_.file("elsewhere") + "/c.0.0"));
}

TEST_F(zarr_folder, stays_if_it_was_made_elsewhere) {
  fs::create_directories(in_group("faces"));
  expect_refused("it was not made by rondel");
  std::ofstream(in_group("zarr.json")) << R"({"zarr_format": 3, "node_type": "group"})";
  expect_refused("it was not made by rondel");
}

TEST_F(zarr_folder, is_no_file) {
  std::ofstream(path_) << "x";
  EXPECT_EQ(message_of([&] { write(); }), path_ + ": a file, where a folder is to be made");
  EXPECT_EQ(read_all(path_), "x");
  const std::string nowhere = directory_.file("none/mesh.zarr");
  EXPECT_EQ(message_of([&] { write_zarr(nowhere, table_, triangulation_); }),
            nowhere + ": No such file or directory");
  const std::string below = path_ + "/mesh.zarr";
  EXPECT_EQ(message_of([&] { write_zarr(below, table_, triangulation_); }),
            below + ": Not a directory");
  EXPECT_FALSE(can_write_triangles({"-", "zarr"}));
}

TEST_F(zarr_folder, is_made_where_a_link_leads_to) {
  fs::create_directory_symlink(directory_.file("target"), path_);
  write();
  write();
  EXPECT_TRUE(fs::is_symlink(path_));
  EXPECT_FALSE(fs::is_symlink(directory_.file("target")));
  EXPECT_TRUE(fs::exists(directory_.file("target") + "/zarr.json"));
  EXPECT_EQ(directory_.num_files(), 2U);
}

TEST_F(zarr_folder, keeps_its_permissions) {
  write();
  for (const mode_t mode : {0700U, 0750U, 0755U}) {
    ASSERT_EQ(::chmod(path_.c_str(), mode), 0);
    write();
    struct stat status {};
    ASSERT_EQ(::stat(path_.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, mode);
  }
}

TEST_F(zarr_folder, stays_as_it_was_if_the_next_one_is_abandoned) {
  write();
  const auto before = content_of(path_);
  {
    io::ZarrGroup group(path_);
    group.reserve(100000);
    io::ZarrArray array(group, io::zarr_areas(1000));
    array.write("12345678");
    EXPECT_EQ(directory_.num_files(), 2U);
  }
  EXPECT_EQ(content_of(path_), before);
  EXPECT_EQ(directory_.num_files(), 1U);
}

TEST_F(zarr_folder, stays_as_it_was_if_a_write_fails) {
  write();
  const auto before = content_of(path_);
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);  // so that the limit is an error and no signal
    const rlimit limit = {10000, 10000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const SiteTable table = table_of(random_sites(1000));
    const Triangulation t = delaunay(table.sites, {}, {.threads = 1});
    const std::string message =
        message_of([&] { write_zarr(path_, table, t, {}, {.threads = 1}); });
    ::_exit(message == path_ + ": File too large" ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_EQ(content_of(path_), before);
  EXPECT_EQ(directory_.num_files(), 1U);
}

TEST_F(zarr_folder, leaves_nothing_when_a_signal_ends_the_process) {
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) {
    const pid_t child = ::fork();
    if (child == 0) {
      std::signal(signal, [](int number) {
        remove_temporaries();
        std::signal(number, SIG_DFL);
        ::raise(number);
      });
      { io::ZarrGroup(path_).add(io::zarr_areas(0)); }  // the memory of names is used again
      io::ZarrGroup first(path_);
      io::ZarrGroup second(directory_.file("second.zarr"));
      first.reserve(100);
      io::ZarrArray array(first, io::zarr_areas(3 << 20U));
      array.write(std::string(std::size_t{20} << 20U, 'x'));
      io::ZarrArray other(second, io::zarr_areas(1));
      ::raise(signal);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal);
    EXPECT_EQ(directory_.num_files(), 0U);
  }
}

}  // namespace
}  // namespace rondel::test
