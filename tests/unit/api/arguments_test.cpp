// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Arrays that callers bring, and that may be anything: an answer or InvalidInput.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "rondel/io.h"
#include "rondel/rondel.h"
#include "support/generators.h"
#include "support/other_surfaces.h"
#include "support/temporary_files.h"

namespace rondel {
namespace {

// Arrays that can be changed.
struct Arrays {
  explicit Arrays(const Triangulation& t)
      : dimension(t.dimension()),
        faces(t.faces().begin(), t.faces().end()),
        neighbors(t.neighbors().begin(), t.neighbors().end()),
        ghost_faces(t.ghost_faces().begin(), t.ghost_faces().end()),
        ring(t.ring().begin(), t.ring().end()),
        duplicates(t.duplicates().begin(), t.duplicates().end()),
        hidden(t.hidden().begin(), t.hidden().end()) {}

  [[nodiscard]] Triangulation of(const Sites& sites, const Options& options = {}) const {
    return Triangulation::from_arrays(
        sites, {dimension, faces, neighbors, ghost_faces, ring, duplicates, hidden}, options);
  }

  int dimension;
  std::vector<Triple> faces;
  std::vector<Triple> neighbors;
  std::vector<Index> ghost_faces;
  std::vector<Index> ring;
  std::vector<Duplicate> duplicates;
  std::vector<Hidden> hidden;
};

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
    const Triangulation taken = Arrays(made).of(in.sites, in.options);
    EXPECT_EQ(taken.num_vertices(), made.num_vertices());
    EXPECT_TRUE(std::ranges::equal(taken.faces(), made.faces()));
  }
}

// Calls change(value) for each index of the arrays, by reference.
template <class Change>
void for_each_index(Arrays& arrays, const Change& change) {
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
    const Sites sites(in.sites);
    const Arrays made(delaunay(sites, in.options));
    Arrays arrays = made;
    for_each_index(arrays, [&](Index& index) {
      const Index before = index;
      for (const Index wrong : {no_index, before + 1000000}) {
        index = wrong;
        EXPECT_THROW(static_cast<void>(arrays.of(sites, in.options)), InvalidInput);
      }
      index = before;
    });
    for (auto* rows : {&arrays.faces, &arrays.neighbors}) {
      for (Triple& row : *rows) {
        for (Index& index : row) {
          const Index before = index;
          index = (before + 1) %
                  static_cast<Index>(rows == &arrays.faces ? sites.size() : made.faces.size());
          if (made.faces.size() > 2) {
            EXPECT_THROW(static_cast<void>(arrays.of(sites, in.options)), InvalidInput);
          }
          index = before;
        }
      }
    }
  }
}

TEST(from_arrays, refuses_surfaces_that_are_no_spheres) {
  std::vector<Point> sites = test::generator("uniform").make(20, 1).sites;
  const Arrays made(delaunay(sites));
  const auto refused = [&sites](const Arrays& arrays) {
    EXPECT_THROW(static_cast<void>(arrays.of(sites)), InvalidInput);
  };
  Arrays arrays = made;
  sites.push_back({1, 2, 3});  // a vertex without a face
  refused(arrays);
  sites.pop_back();
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
  const std::vector<Point> more = test::generator("uniform").make(20, 2).sites;
  sites.insert(sites.end(), more.begin(), more.end());
  refused(arrays);
  sites.resize(38);
  refused(arrays);
}

TEST(from_arrays, refuses_what_is_no_site_and_no_duplicate) {
  std::vector<Point> sites = test::generator("uniform").make(20, 1).sites;
  sites.push_back(sites[7]);
  const Arrays made(delaunay(sites));
  ASSERT_EQ(made.duplicates.size(), 1U);
  EXPECT_EQ(made.of(sites).num_vertices(), 20U);
  sites[20] = sites[8];
  EXPECT_THROW(static_cast<void>(made.of(sites)), InvalidInput);
  sites[20] = {std::nan(""), 0, 0};
  EXPECT_THROW(static_cast<void>(made.of(sites)), InvalidInput);
}

// What walks through the faces takes arrays only if they are those of the triangulation, in whatever
// order.
void expect_refused(const Triangulation& t, const std::string& reason) {
  const auto refuse = [&reason](const auto& make) {
    try {
      make();
      ADD_FAILURE() << "expected: " << reason;
    } catch (const InvalidInput& error) {
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    }
  };
  for (int i = 0; i < 2; ++i) {  // asked again, it is no other
    refuse([&t] { const Locator locator(t); });
    refuse([&t] { const DynamicTriangulation dynamic(t); });
  }
}

TEST(from_arrays, is_proved_before_walks) {
  for (const Input& in : inputs()) {
    Arrays arrays(delaunay(in.sites, in.options));
    const Triangulation taken = arrays.of(in.sites, in.options);
    DynamicTriangulation dynamic(taken);
    EXPECT_EQ(dynamic.num_vertices(), taken.num_vertices());
    const Locator locator(taken);
    EXPECT_EQ(locator.nearest({1, 2, 3}) == no_index, taken.num_vertices() == 0);
    if (arrays.faces.size() < 5 || !arrays.ghost_faces.empty() || !arrays.hidden.empty()) continue;
    std::ranges::reverse(arrays.faces);
    for (Triple& face : arrays.faces) std::rotate(face.begin(), face.begin() + 1, face.end());
    arrays.neighbors = test::neighbors_of(arrays.faces);
    const Locator other(arrays.of(in.sites, in.options));
    EXPECT_EQ(other.nearest({1, 2, 3}), locator.nearest({1, 2, 3}));
  }
}

TEST(from_arrays, is_refused_by_walks_after_a_flip) {
  int num_flips = 0;
  for (const Input& in : inputs()) {
    const Arrays made(delaunay(in.sites, in.options));
    for (std::size_t f = 0; f < std::min<std::size_t>(made.faces.size(), 8); ++f) {
      Arrays flipped = made;
      if (!test::flip_edge(flipped.faces, f, f % 3)) continue;
      flipped.neighbors = test::neighbors_of(flipped.faces);
      Triangulation taken;
      try {
        taken = flipped.of(in.sites, in.options);
      } catch (const InvalidInput&) {  // two edges with the same ends
        continue;
      }
      ++num_flips;
      expect_refused(taken, "the arrays are not those of the triangulation of their sites");
    }
  }
  EXPECT_GT(num_flips, 30);
}

// Closed surfaces among whose faces walks went around for ever.
TEST(from_arrays, is_refused_where_walks_would_not_end) {
  const auto refuse = [](const std::vector<Point>& sites, const std::vector<Triple>& faces,
                         Model model) {
    const auto neighbors = test::neighbors_of(faces);
    const TriangulationParts parts = {.dimension = 2, .faces = faces, .neighbors = neighbors};
    expect_refused(Triangulation::from_arrays(sites, parts, {.model = model}), "edge");
  };
  refuse({{-1, -2, -8},
          {-2, -8, -3},
          {8, 4, 2},
          {-3, -5, -7},
          {8, 7, 0},
          {2, 4, 8},
          {-5, 7, 4},
          {0, -5, 4},
          {8, -3, -2}},
         {{1, 8, 2},
          {1, 2, 7},
          {3, 5, 6},
          {3, 7, 5},
          {4, 8, 1},
          {7, 3, 1},
          {4, 3, 0},
          {3, 6, 0},
          {4, 1, 3},
          {0, 6, 4},
          {7, 2, 5},
          {6, 2, 8},
          {6, 8, 4},
          {2, 6, 5}},
         Model::weighted);
  refuse({{-2, 3, -1}, {-6, -5, 6}, {7, -8, 1}, {6, -2, 7}, {1, 1, -1}, {8, -4, 4}, {-6, -8, -8}},
         {{2, 0, 4},
          {2, 4, 5},
          {6, 3, 1},
          {2, 3, 6},
          {2, 5, 3},
          {2, 6, 0},
          {6, 1, 0},
          {4, 3, 5},
          {4, 1, 3},
          {4, 0, 1}},
         Model::projected);
}

TEST(from_arrays, is_refused_by_walks_with_other_lists) {
  const std::vector<Point> sites = test::generator("hemisphere").make(40, 1).sites;
  const Arrays made(delaunay(sites));
  ASSERT_FALSE(made.ghost_faces.empty());
  Arrays wrong = made;
  wrong.ghost_faces.pop_back();
  expect_refused(wrong.of(sites), "is a ghost face");
  wrong.ghost_faces.clear();
  for (Index f = 0; f < wrong.faces.size(); ++f) wrong.ghost_faces.push_back(f);
  expect_refused(wrong.of(sites), "is no ghost");

  const std::vector<Point> ball = test::generator("ball").make(40, 1).sites;
  const Options weighted = {.model = Model::weighted};
  wrong = Arrays(delaunay(ball, weighted));
  ASSERT_FALSE(wrong.hidden.empty());
  wrong.hidden[0].face = (wrong.hidden[0].face + 20) % static_cast<Index>(wrong.faces.size());
  expect_refused(wrong.of(ball, weighted), "does not lie below face");

  std::vector<Point> ring = test::generator("great_circle").make(20, 1).sites;
  wrong = Arrays(delaunay(ring));
  std::swap(wrong.ring[3], wrong.ring[9]);
  expect_refused(wrong.of(ring), "the ring is in another order");
}

// A copy shares everything, and outlives what it was copied from; so does what was moved from.
TEST(triangulation, is_cheap_to_copy_and_keeps_its_sites) {
  Triangulation copy;
  EXPECT_EQ(copy.dimension(), -1);
  EXPECT_EQ(copy.num_sites(), 0U);
  const Triple* faces = nullptr;
  {
    std::vector<Point> sites = test::generator("uniform").make(50, 1).sites;
    const Point* const first = sites.data();
    Triangulation t = delaunay(std::move(sites));
    EXPECT_EQ(t.sites().points().data(), first);
    faces = t.faces().data();
    copy = t;
    const Triangulation moved = std::move(t);
    EXPECT_EQ(moved.faces().data(), faces);
    EXPECT_EQ(t.num_sites(), 0U);  // NOLINT(bugprone-use-after-move): that is the promise
  }
  EXPECT_EQ(copy.faces().data(), faces);
  const auto area = areas(copy);
  EXPECT_NEAR(std::reduce(area.begin(), area.end()), 4 * std::numbers::pi, 1e-12);
}

TEST(sites, are_copied_or_viewed) {
  std::vector<Point> points = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Sites copied(points);
  const Sites seen = Sites::view(points);
  auto owner = std::make_shared<const std::vector<Point>>(points);
  const Sites owned = Sites::view(*owner, owner);
  const std::weak_ptr<const std::vector<Point>> watch = owner;
  const Point* const theirs = owner->data();
  owner.reset();
  EXPECT_FALSE(watch.expired());
  EXPECT_EQ(owned.points().data(), theirs);
  points[1] = {0, 2, 0};
  EXPECT_EQ(copied[1], (Point{0, 1, 0}));
  Sites from = owned;
  const Sites to = std::move(from);
  EXPECT_EQ(to.points().data(), theirs);
  EXPECT_EQ(from.size(), 0U);  // NOLINT(bugprone-use-after-move): that is the promise
  EXPECT_EQ(seen[1], (Point{0, 2, 0}));
}

TEST(writers, refuse_what_does_not_belong_together) {
  const std::string path = temporary_path("arguments");
  SiteTable table;
  table.sites = test::generator("uniform").make(30, 1).sites;
  const std::vector<Point> sites(table.sites.begin(), table.sites.end());
  const Triangulation t = delaunay(sites);
  const Diagram right = diagram(t);
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
  wrong.cells.rings.values[5] = no_index;
  refused(wrong);
  wrong = right;
  wrong.cells.rings.offsets[3] = 1000;
  refused(wrong);
  wrong = right;
  wrong.cells.points.clear();
  refused(wrong);
  const Triangulation fewer = delaunay(std::span(sites).first(20));
  SiteTable others = table;
  others.sites[29] = {1, 2, 3};
  for (const char* ending : {".off", ".ply", ".obj", ".stl", ".vtp", ".geojson", ".npy"}) {
    EXPECT_THROW(write_triangles(path + ending, table, fewer), InvalidInput);
    EXPECT_THROW(write_triangles(path + ending, others, t), InvalidInput);
  }
}

}  // namespace
}  // namespace rondel
