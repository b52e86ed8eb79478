// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Arrays that callers bring, and that may be anything: an answer or InvalidInput.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "rondel/io.h"
#include "rondel/rondel.h"
#include "support/generators.h"

namespace rondel {
namespace {

TriangulationArrays arrays_of(const Triangulation& t) {
  TriangulationArrays arrays;
  arrays.num_sites = t.num_sites();
  arrays.dimension = t.dimension();
  arrays.faces.assign(t.faces().begin(), t.faces().end());
  arrays.neighbors.assign(t.neighbors().begin(), t.neighbors().end());
  arrays.ghost_faces.assign(t.ghost_faces().begin(), t.ghost_faces().end());
  arrays.ring.assign(t.ring().begin(), t.ring().end());
  arrays.duplicates.assign(t.duplicates().begin(), t.duplicates().end());
  arrays.hidden.assign(t.hidden().begin(), t.hidden().end());
  return arrays;
}

struct Input {
  std::vector<Point> sites;
  Options options;
};

// Every dimension, duplicates, hidden sites, ghost faces.
std::vector<Input> inputs() {
  std::vector<Input> result;
  for (const auto name : {"uniform", "great_circle", "hemisphere", "ball", "integer_sphere"}) {
    for (const Model model : {Model::projected, Model::weighted}) {
      for (const std::size_t n : {0U, 1U, 2U, 3U, 4U, 40U}) {
        test::SiteSet set = test::generator(name).make(n, 1);
        if (n > 3) set.sites.push_back(set.sites[2]);
        result.push_back({std::move(set.sites), {.model = model, .sphere = set.sphere}});
      }
    }
  }
  return result;
}

TEST(from_arrays, takes_what_the_library_made) {
  for (const Input& in : inputs()) {
    const Triangulation made = delaunay(in.sites, in.options);
    const Triangulation taken = Triangulation::from_arrays(arrays_of(made), in.options);
    EXPECT_EQ(taken.num_vertices(), made.num_vertices());
    EXPECT_TRUE(std::ranges::equal(taken.faces(), made.faces()));
  }
}

// Calls change(value) for each index of the arrays, by reference.
template <class Change>
void for_each_index(TriangulationArrays& arrays, const Change& change) {
  for (auto* rows : {&arrays.faces, &arrays.neighbors}) {
    for (Triple& row : *rows) {
      for (Index& i : row) change(i);
    }
  }
  for (auto* values : {&arrays.ghost_faces, &arrays.ring}) {
    for (Index& i : *values) change(i);
  }
  for (Duplicate& d : arrays.duplicates) change(d.site);
  for (Hidden& h : arrays.hidden) change(h.site);
}

// One index that is out of range, or another one: of a face or a neighbor that breaks the surface.
TEST(from_arrays, refuses_one_wrong_index) {
  for (const Input& in : inputs()) {
    const TriangulationArrays made = arrays_of(delaunay(in.sites, in.options));
    TriangulationArrays arrays = made;
    for_each_index(arrays, [&](Index& index) {
      const Index before = index;
      for (const Index wrong : {no_index, before + 1000000}) {
        index = wrong;
        EXPECT_THROW(Triangulation::from_arrays(arrays, in.options), InvalidInput);
      }
      index = before;
    });
    for (auto* rows : {&arrays.faces, &arrays.neighbors}) {
      for (Triple& row : *rows) {
        for (Index& index : row) {
          const Index before = index;
          index = (before + 1) %
                  static_cast<Index>(rows == &arrays.faces ? made.num_sites : made.faces.size());
          if (made.faces.size() > 2) {
            EXPECT_THROW(Triangulation::from_arrays(arrays, in.options), InvalidInput);
          }
          index = before;
        }
      }
    }
  }
}

TEST(from_arrays, refuses_surfaces_that_are_no_spheres) {
  const std::vector<Point> sites = test::generator("uniform").make(20, 1).sites;
  const TriangulationArrays made = arrays_of(delaunay(sites));
  const auto refused = [](const TriangulationArrays& arrays) {
    EXPECT_THROW(Triangulation::from_arrays(arrays, {}), InvalidInput);
  };
  TriangulationArrays arrays = made;
  arrays.num_sites = 21;  // a vertex without a face
  refused(arrays);
  arrays = made;
  arrays.faces.pop_back();
  refused(arrays);
  arrays.neighbors.pop_back();
  refused(arrays);
  arrays = made;
  arrays.dimension = 1;
  refused(arrays);
  arrays = made;
  for (Triple& face : arrays.faces) std::swap(face[0], face[1]);  // neighbors are those of before
  refused(arrays);
  arrays = made;  // two spheres
  const auto m = static_cast<Index>(made.faces.size());
  for (Index f = 0; f < m; ++f) {
    const auto& [a, b, c] = made.faces[f];
    const auto& [u, v, w] = made.neighbors[f];
    arrays.faces.push_back({a + 20, b + 20, c + 20});
    arrays.neighbors.push_back({u + m, v + m, w + m});
  }
  arrays.num_sites = 40;
  refused(arrays);
  arrays.num_sites = 38;
  refused(arrays);
}

// Areas and centroids of cells in which one number is another one.
TEST(cells, of_a_caller_are_those_of_the_triangulation_or_refused) {
  const std::vector<Point> sites = test::generator("uniform").make(60, 1).sites;
  const Triangulation t = delaunay(sites);
  const Cells right = cells(t, sites);
  const auto refused = [&](const Cells& wrong) {
    EXPECT_THROW(areas(t, sites, wrong), InvalidInput);
    EXPECT_THROW(centroids(t, sites, wrong), InvalidInput);
  };
  EXPECT_EQ(areas(t, sites, right).size(), sites.size());
  refused({});
  Cells wrong = right;
  for (std::uint64_t& offset : wrong.offsets) {
    const std::uint64_t before = offset;
    for (const std::uint64_t other : {before + 1, before - 1, std::uint64_t{1} << 40}) {
      offset = other;
      refused(wrong);
    }
    offset = before;
  }
  for (Index& position : wrong.rings) {
    const Index before = position;
    for (const Index other : {(before + 1) % static_cast<Index>(t.num_faces()), no_index}) {
      position = other;
      refused(wrong);
    }
    position = before;
  }
  std::swap(wrong.rings[0], wrong.rings[1]);
  refused(wrong);
  wrong = right;
  wrong.points.resize(t.num_faces() - 1);
  refused(wrong);
}

TEST(writers, refuse_what_does_not_belong_together) {
  const std::string path = testing::TempDir() + "rondel_arguments";
  SiteTable table;
  table.sites = test::generator("uniform").make(30, 1).sites;
  const std::vector<Point> sites(table.sites.begin(), table.sites.end());
  const Triangulation t = delaunay(sites);
  const Diagram right = diagram(t, sites);
  const auto refused = [&](const Diagram& wrong) {
    for (const char* ending : {".geojson", ".vtp", ".npz"}) {
      EXPECT_THROW(write_cells(path + ending, table, t, wrong), InvalidInput);
      EXPECT_FALSE(std::filesystem::exists(path + ending));
    }
  };
  refused({});
  Diagram wrong = right;
  wrong.areas.pop_back();
  refused(wrong);
  wrong = right;
  wrong.cells.rings[5] = no_index;
  refused(wrong);
  wrong = right;
  wrong.cells.offsets[3] = 1000;
  refused(wrong);
  wrong = right;
  wrong.cells.points.clear();
  refused(wrong);
  const Triangulation fewer = delaunay(std::span(sites).first(20));
  for (const char* ending : {".off", ".ply", ".obj", ".stl", ".vtp", ".geojson", ".npy"}) {
    EXPECT_THROW(write_triangles(path + ending, table, fewer), InvalidInput);
  }
}

}  // namespace
}  // namespace rondel
