// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Folders that appear complete or not at all, and the arrays of Zarr in them.
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>

#include "io/atomic_folder.h"
#include "io/zarr_mesh.h"
#include "io_support.h"

namespace rondel::test::of_folders {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

bool is_known(std::string_view name) { return name == "a" || name == "d" || name == "d/x"; }
std::string no_objection(const std::string& /*path*/) { return {}; }
std::string objection(const std::string& path) { return "it is " + path.substr(path.size() - 3); }

constexpr io::FolderKind kind = {&is_known, &no_objection};
constexpr io::FolderKind strict_kind = {&is_known, &objection};

class atomic_folder : public ::testing::Test {
 protected:
  // All that is in the directory, in order; files with their content.
  [[nodiscard]] Names content() const {
    Names names;
    for (const auto& entry : fs::recursive_directory_iterator(root_)) {
      std::string name = entry.path().lexically_relative(root_).generic_string();
      if (entry.is_regular_file()) name += "=" + read_all(entry.path());
      names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    return names;
  }
  // The temporary folder; empty if there is none.
  [[nodiscard]] fs::path temporary() const {
    for (const auto& entry : fs::directory_iterator(root_)) {
      if (entry.path().filename().string().starts_with(".rondel-")) return entry.path();
    }
    return {};
  }
  void put(const std::string& name, const std::string& text) const {
    fs::create_directories(fs::path(directory_.file(name)).parent_path());
    static_cast<void>(directory_.with(name, text));
  }
  [[nodiscard]] std::string said(const io::FolderKind& of, const std::string& name = "out") const {
    return message_of([&] { const io::AtomicFolder folder(directory_.file(name), of); });
  }

  TemporaryDirectory directory_;
  std::string root_ = directory_.file("");
  std::string out_ = directory_.file("out");
};

TEST_F(atomic_folder, appears_with_its_content) {
  io::AtomicFolder folder(out_ + "//", kind);
  folder.make_folder("d");
  folder.write_file("d/x", "12");
  folder.write_file("a", "");
  EXPECT_FALSE(fs::exists(out_));
  EXPECT_EQ(read_all(temporary() / "d/x"), "12");
  folder.commit();
  EXPECT_EQ(content(), (Names{"out", "out/a=", "out/d", "out/d/x=12"}));
}

TEST_F(atomic_folder, replaces_what_is_known) {
  put("out/a", "old");
  put("out/d/x", "old");
  ::chmod(out_.c_str(), 0750);
  {
    io::AtomicFolder folder(out_, kind);
    folder.write_file("a", "new");
    EXPECT_EQ(fs::status(temporary()).permissions(), fs::perms::owner_all);
    folder.commit();
  }
  EXPECT_EQ(content(), (Names{"out", "out/a=new"}));
  EXPECT_EQ(static_cast<unsigned>(fs::status(out_).permissions()), 0750U);
  { const io::AtomicFolder abandoned(out_, kind); }
  EXPECT_EQ(content(), (Names{"out", "out/a=new"}));
}

TEST_F(atomic_folder, refuses_to_replace_what_is_not_known) {
  put("file", "");
  EXPECT_EQ(said(kind, "file"), directory_.file("file") + ": a file, where a folder is to be made");
  EXPECT_EQ(said(kind, "none/out"), directory_.file("none/out") + ": No such file or directory");
  EXPECT_EQ(said(kind, "file/out"), directory_.file("file/out") + ": Not a directory");
  put("out/d/x", "1");
  EXPECT_EQ(said(kind), "");
  EXPECT_EQ(said(strict_kind), out_ + ": it is out; the folder is not replaced");
  put("out/d/y", "2");
  put("out/e", "3");
  EXPECT_EQ(said(kind), out_ + ": 'd/y' in it is not ours; the folder is not replaced");
  fs::remove(out_ + "/d/y");
  EXPECT_EQ(said(kind), out_ + ": 'e' in it is not ours; the folder is not replaced");
  fs::remove(out_ + "/e");
  fs::create_symlink("d", out_ + "/a");
  EXPECT_EQ(said(kind), out_ + ": 'a' in it is not ours; the folder is not replaced");
  fs::remove_all(out_ + "/a");
  fs::remove_all(out_ + "/d");
  EXPECT_EQ(said(strict_kind), "");  // it is empty
  EXPECT_EQ(content(), (Names{"file=", "out"}));
}

TEST_F(atomic_folder, looks_again_when_it_gets_its_name) {
  io::AtomicFolder folder(out_, kind);
  folder.write_file("a", "new");
  put("out/other", "1");
  EXPECT_EQ(message_of([&] { folder.commit(); }),
            out_ + ": 'other' in it is not ours; the folder is not replaced");
  EXPECT_EQ(read_all(out_ + "/other"), "1");
}

TEST_F(atomic_folder, leaves_nothing_when_something_fails) {
  io::AtomicFolder folder(out_, kind);
  folder.make_folder("d");
  folder.write_file("d/x", "1");
  EXPECT_EQ(message_of([&] { folder.write_file("none/x", "1"); }),
            out_ + ": No such file or directory");
  EXPECT_EQ(content(), Names{});
  io::AtomicFolder other(out_, kind);
  other.make_folder("d");
  EXPECT_EQ(message_of([&] { other.make_folder("d/e/f"); }), out_ + ": No such file or directory");
  EXPECT_EQ(content(), Names{});
  io::AtomicFolder third(out_, kind);
  third.write_file("a", "1");
  EXPECT_EQ(message_of([&] { third.fail(ENOSPC); }), out_ + ": " + std::strerror(ENOSPC));
  EXPECT_EQ(content(), Names{});
  io::AtomicFolder fourth(out_, kind);
  int descriptor = fourth.make_file("a");
  const int number = descriptor;
  ::close(descriptor);
  EXPECT_EQ(message_of([&] { fourth.write(descriptor, "1"); }), out_ + ": " + std::strerror(EBADF));
  EXPECT_EQ(descriptor, -1);
  EXPECT_GE(number, 0);
  EXPECT_EQ(content(), Names{});
}

TEST_F(atomic_folder, has_room_that_becomes_smaller) {
  io::AtomicFolder folder(out_, kind);
  const fs::path room = temporary() / "room";
  folder.release(10);
  folder.reserve(0);
  EXPECT_FALSE(fs::exists(room));
  folder.reserve(10'000);
  EXPECT_EQ(fs::file_size(room), 10'000U);
  folder.reserve(5000);
  EXPECT_EQ(fs::file_size(room), 15'000U);
  folder.release(4000);
  EXPECT_EQ(fs::file_size(room), 11'000U);
  folder.release(11'001);
  EXPECT_EQ(fs::file_size(room), 0U);
  folder.commit();
  EXPECT_EQ(content(), Names{"out"});
  {
    io::AtomicFolder abandoned(directory_.file("other"), kind);
    abandoned.reserve(100);
  }
  EXPECT_EQ(content(), Names{"out"});
}

TEST(zarr_group, replaces_only_names_that_it_makes) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("out.zarr");
  const auto is_replaced = [&](const std::string& name) {
    fs::remove_all(path);
    fs::create_directories(fs::path(path + "/" + name).parent_path());
    static_cast<void>(directory.with("out.zarr/zarr.json", "made by rondel 1"));
    if (name != "zarr.json") static_cast<void>(directory.with("out.zarr/" + name, "x"));
    return message_of([&] { const io::ZarrGroup group(path); }).empty();
  };
  for (const std::string array : {"areas", "duplicates", "faces", "ghost_faces", "mesh",
                                  "neighbors", "node_lat", "node_lon", "sites"}) {
    for (const char* const inner : {"zarr.json", "c", "c.0", "c.17.0", "c.1.2.3"}) {
      EXPECT_TRUE(is_replaced(array + "/" + inner)) << array << inner;
    }
  }
  EXPECT_TRUE(is_replaced("zarr.json"));
  for (const char* const name :
       {"other", "zarr.jso", "faces/d", "faces/c.", "faces/c0", "faces/c.x", "faces/c..0",
        "faces/c.0.", "faces/c.0x", "faces/c/0", "other/c.0", "faces/c.0/zarr.json", "c.0"}) {
    EXPECT_FALSE(is_replaced(name)) << name;
  }
  static_cast<void>(is_replaced("zarr.json"));
  static_cast<void>(directory.with("out.zarr/zarr.json", "made by others"));
  EXPECT_EQ(message_of([&] { const io::ZarrGroup group(path); }),
            path + ": it was not made by rondel; the folder is not replaced");
}

TEST(zarr_group, has_chunks_of_equal_numbers_of_rows) {
  constexpr std::uint64_t most = 1U << 20U;
  for (const std::uint64_t n :
       {std::uint64_t{1}, std::uint64_t{7}, most - 1, most, most + 1, 2 * most - 1, 2 * most,
        2 * most + 1, 3 * most + 2, 10 * most - 3, 7'654'321UL}) {
    std::uint64_t num_chunks = 1;
    while ((n + num_chunks - 1) / num_chunks > most) ++num_chunks;
    EXPECT_EQ(io::zarr_chunk_rows(n), (n + num_chunks - 1) / num_chunks) << n;
  }
  EXPECT_EQ(io::zarr_chunk_rows(0), 1U);
}

TEST(zarr_group, describes_its_arrays) {
  using nlohmann::json;
  const TemporaryDirectory directory;
  const std::string path = directory.file("out.zarr");
  io::ZarrGroup group(path);
  io::ZarrArray faces(group, io::zarr_faces("uint32", 2));
  faces.write(std::string(24, 'f'));
  faces.finish();
  io::ZarrArray areas(group, io::zarr_areas(3));
  areas.write(std::string(10, 'a'));
  areas.write(std::string(14, 'b'));
  areas.finish();
  group.add(io::zarr_ghost_faces("int32", 0));
  group.add(io::zarr_duplicates("int64", 5));
  group.add(io::zarr_neighbors("int64", 1'048'577));
  io::commit_zarr_mesh(group, true);
  const auto description = [&](const std::string& name) {
    return json::parse(read_all(path + "/" + name + "/zarr.json"));
  };
  const auto expect = [&](const std::string& name, const json& shape, const json& chunk,
                          const std::string& type, const json& dimensions) {
    const json found = description(name);
    EXPECT_EQ(found["zarr_format"], 3);
    EXPECT_EQ(found["node_type"], "array");
    EXPECT_EQ(found["shape"], shape);
    EXPECT_EQ(found["chunk_grid"]["configuration"]["chunk_shape"], chunk);
    EXPECT_EQ(found["data_type"], type);
    EXPECT_EQ(found["fill_value"], 0);
    EXPECT_EQ(found["fill_value"].is_number_float(), type == "float64");
    EXPECT_EQ(found["dimension_names"], dimensions);
    EXPECT_EQ(found["codecs"][0]["configuration"]["endian"], "little");
  };
  expect("faces", {2, 3}, {2, 3}, "uint32", {"n_face", "n_max_face_nodes"});
  expect("areas", json::array({3}), json::array({3}), "float64", json::array({"n_node"}));
  expect("ghost_faces", json::array({0}), json::array({1}), "int32", json::array({"n_ghost_face"}));
  expect("duplicates", {5, 2}, {5, 2}, "int64", {"n_duplicate", "two"});
  expect("neighbors", {1'048'577, 3}, {524'289, 3}, "int64", {"n_face", "n_max_face_nodes"});
  expect("mesh", json::array(), json::array(), "int32", json::array());
  EXPECT_EQ(description("faces")["attributes"]["cf_role"], "face_node_connectivity");
  EXPECT_EQ(description("neighbors")["attributes"]["cf_role"], "face_face_connectivity");
  EXPECT_EQ(description("neighbors")["attributes"]["start_index"], 0);
  EXPECT_EQ(description("areas")["attributes"]["units"], "sr");
  EXPECT_EQ(description("mesh")["attributes"]["topology_dimension"], 2);
  EXPECT_EQ(description("mesh")["attributes"]["face_face_connectivity"], "neighbors");
  EXPECT_EQ(read_all(path + "/faces/c.0.0"), std::string(24, 'f'));
  EXPECT_EQ(read_all(path + "/areas/c.0"), std::string(10, 'a') + std::string(14, 'b'));
  const json whole = json::parse(read_all(path + "/zarr.json"));
  EXPECT_EQ(whole["node_type"], "group");
  const json& metadata = whole["consolidated_metadata"]["metadata"];
  EXPECT_EQ(metadata.size(), 6U);
  for (const auto& [name, value] : metadata.items()) EXPECT_EQ(value, description(name)) << name;
  EXPECT_TRUE(io::is_zarr("a/b.ZARR/"));
  EXPECT_FALSE(io::is_zarr("a.zar"));
}

TEST(zarr_group, has_nodes_of_several_blocks) {
  const TemporaryDirectory directory;
  const std::size_t count = 2 * 65'536 + 5;
  std::vector<Point> sites;
  std::vector<LonLat> positions;
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<double>(i);
    sites.push_back({x, 1, 2});
    positions.push_back({x / 1000, -x / 2000});
  }
  const std::string path = directory.file("out.zarr");
  {
    io::ZarrGroup group(path);
    io::ZarrNodes nodes(group, count + 2, {0, 0, 0});
    nodes.add(std::span(sites).first(70'000), std::span(positions).first(70'000), 1);
    nodes.add(std::span(sites).subspan(70'000), std::span(positions).subspan(70'000), 2);
    nodes.add(std::vector<Point>{{0, 0, 0}, {0, 0, -2}}, {}, 1);  // the center, and a pole
    nodes.finish();
    io::commit_zarr_mesh(group, false);
  }
  positions.push_back({0, 0});
  positions.push_back({0, -90});
  const auto doubles = [&](const std::string& name) {
    const std::string bytes = read_all(path + name);
    std::vector<double> values(bytes.size() / sizeof(double));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  };
  const auto lon = doubles("/node_lon/c.0");
  const auto lat = doubles("/node_lat/c.0");
  ASSERT_EQ(lon.size(), count + 2);
  ASSERT_EQ(lat.size(), count + 2);
  for (std::size_t i = 0; i < lon.size(); ++i) {
    ASSERT_EQ(lon[i], positions[i].lon_deg) << i;
    ASSERT_EQ(lat[i], positions[i].lat_deg) << i;
  }
  const auto xyz = doubles("/sites/c.0.0");
  ASSERT_EQ(xyz.size(), 3 * (count + 2));
  EXPECT_EQ(xyz[std::size_t{3} * 70'000], 70'000);
  EXPECT_EQ(xyz[3 * 70'000 + 1], 1);
  EXPECT_EQ(xyz.back(), -2);
}

}  // namespace
}  // namespace rondel::test::of_folders
