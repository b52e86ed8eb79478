// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Triangles: round trips through every format, and what is said of bad files.
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "io/binary.h"
#include "rondel/delaunay.h"
#include "unit/io/support.h"

namespace rondel::test {
namespace {

struct Case {
  SiteTable table;
  Triangulation triangulation;
};

Case make_case(std::vector<Point> sites) {
  Case result;
  result.table.sites = std::move(sites);
  result.triangulation = delaunay(result.table.sites);
  return result;
}

Case random_case(std::size_t n) {
  std::mt19937_64 random(5);
  std::vector<LonLat> positions(n);
  for (LonLat& position : positions) {
    position.lon_deg = std::uniform_real_distribution<>(-180, 180)(random);
    position.lat_deg = std::uniform_real_distribution<>(-90, 90)(random);
  }
  return make_case(unit_vectors(positions));
}

std::vector<Triple> faces_of(const Case& c) {
  return {c.triangulation.faces().begin(), c.triangulation.faces().end()};
}

TEST(read_triangles, every_good_file_holds_the_octahedron) {
  const auto files = files_in(corpus / "good_triangles");
  EXPECT_EQ(files.size(), 11U);
  for (const auto& file : files) {
    EXPECT_EQ(read_triangles(file.string()), octahedron_faces) << file;
  }
}

TEST(read_triangles, says_what_is_wrong_with_every_bad_file) {
  expect_messages(corpus / "bad_triangles", [](const std::string& file) { read_triangles(file); });
}

TEST(write_triangles, round_trips_every_format) {
  const TemporaryDirectory directory;
  for (const std::size_t n : {0U, 2U, 4U, 500U}) {
    const Case c = random_case(n);
    for (const char* const name : {"a.npy", "a.off", "a.ply", "a.obj", "a.vtp"}) {
      ASSERT_TRUE(can_write_triangles(name));
      const std::string path = directory.file(name);
      write_triangles(path, c.table, c.triangulation);
      if (n == 0 && std::string_view(name) == "a.obj") {
        EXPECT_EQ(read_all(path), "");
      } else {
        EXPECT_EQ(read_triangles(path), faces_of(c)) << name << " " << n;
      }
    }
  }
}

TEST(write_triangles, vertices_round_trip) {
  const TemporaryDirectory directory;
  const Case c =
      make_case({{1, 1e-300, 0.1}, {-1.0 / 3, 1, 0}, {0, -7e100, 5}, {0, 0, -1}, {2, 2, 2}});
  const auto sites_behind = [&](const char* name, const std::string& end_of_head) {
    write_triangles(directory.file(name), c.table, c.triangulation);
    const std::string bytes = read_all(directory.file(name));
    std::vector<Point> sites(c.table.sites.size());
    const std::size_t start = bytes.find(end_of_head) + end_of_head.size();
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const char* const numbers = bytes.data() + start + i * sizeof(Point);
      sites[i] = {io::load<double>(numbers), io::load<double>(numbers + 8),
                  io::load<double>(numbers + 16)};
    }
    return sites;
  };
  EXPECT_EQ(sites_behind("a.ply", "end_header\n"), c.table.sites);
  // The first array of a .vtp is `ghost`: a length of 8 bytes, then a byte for each face.
  const std::string ghosts(c.triangulation.num_faces(), '\0');
  const std::string length(1, static_cast<char>(ghosts.size()));
  ASSERT_EQ(c.triangulation.num_ghost_faces(), 0U);
  EXPECT_EQ(
      sites_behind("a.vtp", length + std::string(7, '\0') + ghosts + "\x78" + std::string(7, '\0')),
      c.table.sites);
  write_triangles(directory.file("a.off"), c.table, c.triangulation);
  std::ifstream file(directory.file("a.off"));
  std::string word;
  for (int i = 0; i < 4; ++i) file >> word;
  for (const Point& site : c.table.sites) {
    for (const double expected : {site.x, site.y, site.z}) {
      file >> word;
      EXPECT_EQ(std::stod(word), expected);
    }
  }
}

TEST(write_triangles, text_formats_look_as_they_should) {
  const TemporaryDirectory directory;
  const Case c = make_case(octahedron);
  write_triangles(directory.file("a.off"), c.table, c.triangulation);
  EXPECT_TRUE(read_all(directory.file("a.off")).starts_with("OFF\n6 8 12\n1 0 0\n0 1 0\n-1 0 0\n"));
  write_triangles(directory.file("a.obj"), c.table, c.triangulation);
  EXPECT_TRUE(read_all(directory.file("a.obj")).starts_with("v 1 0 0\nv 0 1 0\n"));
}

TEST(write_triangles, stl_has_unit_normals_that_point_outwards) {
  const TemporaryDirectory directory;
  const Case c = random_case(200);
  write_triangles(directory.file("a.stl"), c.table, c.triangulation);
  const std::string bytes = read_all(directory.file("a.stl"));
  const std::size_t m = c.triangulation.num_faces();
  ASSERT_EQ(bytes.size(), 84 + 50 * m);
  EXPECT_FALSE(bytes.starts_with("solid"));  // that would be the text form
  EXPECT_EQ(io::load<std::uint32_t>(bytes.data() + 80), m);
  for (std::size_t i = 0; i < m; ++i) {
    const auto f = [&](std::size_t k) {
      return static_cast<double>(io::load<float>(bytes.data() + 84 + 50 * i + 4 * k));
    };
    EXPECT_NEAR(std::hypot(f(0), f(1), f(2)), 1, 1e-6);
    EXPECT_GT(f(0) * f(3) + f(1) * f(4) + f(2) * f(5), 0);
    EXPECT_EQ(static_cast<float>(f(3)),
              static_cast<float>(c.table.sites[c.triangulation.faces()[i][0]].x));
  }
}

TEST(write_triangles, stl_refuses_what_floats_cannot_hold) {
  const TemporaryDirectory directory;
  Case c = make_case({{1, 0, 0}, {0, 1, 0}, {0, 0, 1e39}, {-1, -1, -1}});
  c.table.name = "in.xyz";
  EXPECT_EQ(message_of([&] { write_triangles(directory.file("a.stl"), c.table, c.triangulation); }),
            "in.xyz:3: the site does not fit the 32-bit floats of .stl");
  EXPECT_EQ(directory.num_files(), 0U);
}

// Twice the signed area of a ring; positive when it is counterclockwise.
double twice_area(const nlohmann::json& ring) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    const auto x = [&](std::size_t k) { return ring[k][0].get<double>(); };
    const auto y = [&](std::size_t k) { return ring[k][1].get<double>(); };
    sum += (x(i) - x(0)) * (y(i + 1) - y(0)) - (x(i + 1) - x(0)) * (y(i) - y(0));
  }
  return sum;
}

// The area of the polygons of a feature; checks that they obey RFC 7946.
double area_of(const nlohmann::json& feature) {
  const auto& geometry = feature.at("geometry");
  const auto& coordinates = geometry.at("coordinates");
  const bool is_multiple = geometry.at("type") == "MultiPolygon";
  double area = 0;
  for (std::size_t i = 0; i < (is_multiple ? coordinates.size() : 1); ++i) {
    const auto& rings = is_multiple ? coordinates[i] : coordinates;
    EXPECT_EQ(rings.size(), 1U);
    const auto& ring = rings.at(0);
    EXPECT_GE(ring.size(), 4U);
    EXPECT_EQ(ring.front(), ring.back());
    EXPECT_GT(twice_area(ring), 0);
    area += twice_area(ring) / 2;
    for (const auto& position : ring) {
      EXPECT_LE(std::abs(position[0].get<double>()), 180);
      EXPECT_LE(std::abs(position[1].get<double>()), 90);
    }
  }
  return area;
}

TEST(write_triangles, geojson_tiles_the_rectangle_of_the_map) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("a.geojson");
  for (const Case& c : {make_case(octahedron), random_case(300), random_case(5000)}) {
    ASSERT_EQ(c.triangulation.num_ghost_faces(), 0U);
    write_triangles(path, c.table, c.triangulation);
    const auto document = nlohmann::json::parse(read_all(path));
    EXPECT_EQ(document.at("type"), "FeatureCollection");
    const auto& features = document.at("features");
    ASSERT_EQ(features.size(), c.triangulation.num_faces());
    double area = 0;
    for (std::size_t i = 0; i < features.size(); ++i) {
      EXPECT_EQ(features[i].at("type"), "Feature");
      EXPECT_EQ(features[i].at("properties").at("sites").get<Triple>(), c.triangulation.faces()[i]);
      area += area_of(features[i]);
    }
    EXPECT_NEAR(area, 360.0 * 180, 1e-6);
  }
}

TEST(write_triangles, geojson_leaves_ghost_faces_out) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("a.geojson");
  std::vector<LonLat> positions;
  for (int lon = 0; lon < 20; lon += 5) {
    for (int lat = 40; lat < 60; lat += 5) {
      positions.push_back({static_cast<double>(lon), static_cast<double>(lat)});
    }
  }
  const Case c = make_case(unit_vectors(positions));
  const std::size_t num_ghosts = c.triangulation.num_ghost_faces();
  ASSERT_GT(num_ghosts, 0U);
  write_triangles(path, c.table, c.triangulation);
  const auto features = nlohmann::json::parse(read_all(path)).at("features");
  ASSERT_EQ(features.size(), c.triangulation.num_faces() - num_ghosts);
  for (const auto& feature : features) EXPECT_GT(area_of(feature), 0);
}

// Two corners are opposite up to 1e-300: doubles do not tell where the edge between them runs.
TEST(write_triangles, geojson_has_no_geometry_where_corners_round_to_opposites) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("a.geojson");
  const Case c = make_case({{0, 1, 0}, {0, -1, 1e-300}, {1, 0, -1}, {-1, 0, -1}});
  ASSERT_EQ(c.triangulation.num_faces(), 4U);
  ASSERT_EQ(c.triangulation.num_ghost_faces(), 0U);
  std::vector<std::string> remarks;
  write_triangles(path, c.table, c.triangulation, {}, &remarks);
  ASSERT_EQ(remarks.size(), 1U);
  EXPECT_EQ(remarks.front().find("2 of 4 triangles have no geometry: "), 0U);
  const auto features = nlohmann::json::parse(read_all(path)).at("features");
  ASSERT_EQ(features.size(), 4U);
  EXPECT_EQ(std::ranges::count_if(features, [](const auto& f) { return f["geometry"].is_null(); }),
            2);
}

TEST(write_triangles, geojson_without_faces_has_no_features) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("a.geojson");
  const Case c = random_case(2);
  write_triangles(path, c.table, c.triangulation);
  EXPECT_EQ(nlohmann::json::parse(read_all(path)).at("features").size(), 0U);
}

TEST(write_triangles, refuses_the_sites_of_another_triangulation) {
  const TemporaryDirectory directory;
  const Case c = random_case(20);
  const auto refused_at = [&](const SiteTable& table) -> std::size_t {
    try {
      write_triangles(directory.file("a.ply"), table, c.triangulation);
    } catch (const InvalidInput& error) {
      EXPECT_STREQ(error.what(), "the sites of the table are not those of the triangulation");
      return error.index();
    }
    return no_index;
  };
  SiteTable table = c.table;
  EXPECT_EQ(refused_at(table), no_index);
  table.sites[7] = {0, 0, 1};
  EXPECT_EQ(refused_at(table), 7U);
  table.sites = {c.table.sites.begin(), c.table.sites.end() - 1};
  EXPECT_EQ(refused_at(table), 19U);
  table.sites = c.table.sites;
  table.sites.push_back({0, 0, 1});
  EXPECT_EQ(refused_at(table), 20U);
  EXPECT_EQ(directory.num_files(), 1U);
}

TEST(write_triangles, lists_the_endings_that_it_knows) {
  const Case c = random_case(4);
  EXPECT_FALSE(can_write_triangles("a.csv"));
  EXPECT_EQ(
      message_of([&] { write_triangles("a.csv", c.table, c.triangulation); }),
      "a.csv: unknown ending \".csv\"; triangles are written as .npy .off .ply .obj .stl .vtp "
      ".geojson");
  EXPECT_EQ(message_of([&] { write_triangles("-", c.table, c.triangulation); }),
            "-: the name has no ending; triangles are written as .npy .off .ply .obj .stl .vtp "
            ".geojson");
}

TEST(write_triangles, leaves_no_file_when_the_disk_is_full) {
  const TemporaryDirectory directory;
  const Case c = random_case(1000);
  for (const char* const name :
       {"a.npy", "a.off", "a.ply", "a.obj", "a.stl", "a.vtp", "a.geojson"}) {
    const std::string link = directory.file(name);
    std::filesystem::create_symlink("/dev/full", link);
    EXPECT_EQ(message_of([&] { write_triangles(link, c.table, c.triangulation); }),
              link + ": No space left on device");
    std::filesystem::remove(link);
  }
  EXPECT_EQ(directory.num_files(), 0U);
}

}  // namespace
}  // namespace rondel::test
