// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The C interface says what the C++ interface says, and every failure is a status.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "rondel.h"
#include "rondel/rondel.h"

extern "C" {
std::size_t c_size_of_options(void);
std::size_t c_size_of_execution(void);
}

namespace {

using rondel::Index;
using rondel::Point;

// A handle that is freed.
template <class T, void (*free_handle)(T*)>
class Handle {
 public:
  Handle() = default;
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  Handle(Handle&&) = delete;
  Handle& operator=(Handle&&) = delete;
  ~Handle() { reset(); }
  void reset() {
    free_handle(handle_);
    handle_ = nullptr;
  }
  T** operator&() { return &handle_; }  // NOLINT(google-runtime-operator): as C takes it
  operator T*() const { return handle_; }

 private:
  T* handle_ = nullptr;
};

using TriangulationHandle = Handle<rondel_triangulation, rondel_triangulation_free>;
using DiagramHandle = Handle<rondel_diagram, rondel_diagram_free>;
using ListsHandle = Handle<rondel_lists, rondel_lists_free>;
using LocatorHandle = Handle<rondel_locator, rondel_locator_free>;
using DynamicHandle = Handle<rondel_dynamic, rondel_dynamic_free>;
using StopHandle = Handle<rondel_stop, rondel_stop_free>;

// Points on a spiral, `per_turn` to a turn, then the first three again.
std::vector<Point> spiral(std::size_t n) {
  std::vector<rondel::LonLat> positions;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    positions.push_back(
        {137.508 * static_cast<double>(i), std::asin(1 - 2 * t) * 180 / std::numbers::pi});
  }
  std::vector<Point> points = rondel::unit_vectors(positions);
  for (std::size_t i = 0; i < std::min<std::size_t>(3, n); ++i) points.push_back(points[i]);
  return points;
}

// Sites at lengths from 0.9 to 1.1: some of them are hidden in the weighted model.
std::vector<Point> bumpy(std::size_t n) {
  std::vector<Point> points = spiral(n);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double length = 0.9 + 0.025 * static_cast<double>(i % 9);
    points[i] = {length * points[i].x, length * points[i].y, length * points[i].z};
  }
  return points;
}

std::vector<Point> equator(std::size_t n) {
  std::vector<rondel::LonLat> positions;
  for (std::size_t i = 0; i < n; ++i) positions.push_back({20.0 * static_cast<double>(i), 0});
  return rondel::unit_vectors(positions);
}

const double* doubles(const std::vector<Point>& points) {
  return points.empty() ? nullptr : &points.front().x;
}

std::vector<double> flat(std::span<const Point> points) {
  std::vector<double> result;
  for (const Point& p : points) result.insert(result.end(), {p.x, p.y, p.z});
  return result;
}

template <class T>
std::vector<T> listed(const T* begin, std::size_t size) {
  return {begin, begin + size};
}

std::vector<Index> flat(std::span<const rondel::Triple> triples) {
  std::vector<Index> result;
  for (const rondel::Triple& t : triples) result.insert(result.end(), t.begin(), t.end());
  return result;
}

struct Input {
  const char* name;
  std::vector<Point> sites;
  rondel::Model model;
};

class CInterface : public testing::TestWithParam<Input> {
 protected:
  CInterface() {
    rondel_options_init(&options_);
    options_.model =
        GetParam().model == rondel::Model::weighted ? RONDEL_WEIGHTED : RONDEL_PROJECTED;
  }

  [[nodiscard]] const std::vector<Point>& sites() const { return GetParam().sites; }

  rondel_options options_{};
  rondel::Triangulation expected_ = rondel::delaunay(GetParam().sites, {.model = GetParam().model});
};

TEST_P(CInterface, triangulates_as_cpp_does) {
  TriangulationHandle made;
  ASSERT_EQ(rondel_delaunay(doubles(sites()), sites().size(), &options_, nullptr, &made),
            RONDEL_OK);
  EXPECT_EQ(rondel_dimension(made), expected_.dimension());
  EXPECT_EQ(rondel_model(made), options_.model);
  EXPECT_EQ(rondel_num_sites(made), sites().size());
  EXPECT_EQ(rondel_num_vertices(made), expected_.num_vertices());
  EXPECT_EQ(rondel_num_ghost_faces(made), expected_.num_ghost_faces());
  EXPECT_STREQ(rondel_builder(made), name_of(expected_.report().builder));
  EXPECT_EQ(listed(rondel_points(made), 3 * sites().size()), flat(sites()));
  const std::size_t m = rondel_num_faces(made);
  EXPECT_EQ(listed(rondel_faces(made), 3 * m), flat(expected_.faces()));
  EXPECT_EQ(listed(rondel_neighbors(made), 3 * m), flat(expected_.neighbors()));
  EXPECT_TRUE(std::ranges::equal(listed(rondel_ghost_faces(made), rondel_num_ghost_faces(made)),
                                 expected_.ghost_faces()));
  EXPECT_TRUE(
      std::ranges::equal(listed(rondel_ring(made), rondel_num_ring(made)), expected_.ring()));
  ASSERT_EQ(rondel_num_duplicates(made), expected_.duplicates().size());
  for (std::size_t i = 0; i < expected_.duplicates().size(); ++i) {
    EXPECT_EQ(rondel_duplicates(made)[2 * i], expected_.duplicates()[i].site);
    EXPECT_EQ(rondel_duplicates(made)[2 * i + 1], expected_.duplicates()[i].representative);
  }
  ASSERT_EQ(rondel_num_hidden(made), expected_.hidden().size());
  for (std::size_t i = 0; i < expected_.hidden().size(); ++i) {
    EXPECT_EQ(rondel_hidden(made)[2 * i], expected_.hidden()[i].site);
    EXPECT_EQ(rondel_hidden(made)[2 * i + 1], expected_.hidden()[i].face);
  }
  std::int32_t is_valid = -1;
  ASSERT_EQ(rondel_check(doubles(sites()), sites().size(), rondel_faces(made), m, &options_,
                         nullptr, &is_valid),
            RONDEL_OK);
  EXPECT_EQ(is_valid, expected_.dimension() == 2 || m == 0 ? 1 : 0);
  double center[3] = {1, 1, 1};
  rondel_center(made, center);
  EXPECT_EQ(center[0], 0);
}

TEST_P(CInterface, has_the_dual_of_cpp) {
  TriangulationHandle made;
  ASSERT_EQ(rondel_delaunay(doubles(sites()), sites().size(), &options_, nullptr, &made),
            RONDEL_OK);
  const std::size_t n = sites().size();

  std::vector<double> centers(3 * rondel_num_faces(made));
  ASSERT_EQ(rondel_circumcenters(made, nullptr, centers.data()), RONDEL_OK);
  EXPECT_EQ(centers, flat(circumcenters(expected_)));
  std::vector<double> centroids(3 * n);
  ASSERT_EQ(rondel_centroids(made, nullptr, centroids.data()), RONDEL_OK);
  EXPECT_EQ(centroids, flat(rondel::centroids(expected_)));
  std::vector<double> areas(n);
  ASSERT_EQ(rondel_areas(made, nullptr, areas.data()), RONDEL_OK);
  EXPECT_EQ(areas, rondel::areas(expected_));

  const rondel::Diagram expected = diagram(expected_);
  DiagramHandle cells;
  ASSERT_EQ(rondel_diagram_create(made, nullptr, &cells), RONDEL_OK);
  EXPECT_EQ(listed(rondel_cell_offsets(cells), n + 1), expected.cells.rings.offsets);
  EXPECT_EQ(listed(rondel_cell_rings(cells), expected.cells.rings.values.size()),
            expected.cells.rings.values);
  ASSERT_EQ(rondel_num_cell_points(cells), expected.cells.points.size());
  EXPECT_EQ(listed(rondel_cell_points(cells), 3 * expected.cells.points.size()),
            flat(expected.cells.points));
  EXPECT_EQ(listed(rondel_cell_areas(cells), n), expected.areas);

  const auto expected_edges = edges(expected_);
  std::size_t num_edges = 0;
  ASSERT_EQ(rondel_edges(made, nullptr, 0, &num_edges), RONDEL_OK);
  ASSERT_EQ(num_edges, expected_edges.size());
  std::vector<std::uint32_t> found(2 * num_edges);
  ASSERT_EQ(rondel_edges(made, found.data(), num_edges, &num_edges), RONDEL_OK);
  for (std::size_t i = 0; i < num_edges; ++i) {
    EXPECT_EQ(found[2 * i], expected_edges[i][0]);
    EXPECT_EQ(found[2 * i + 1], expected_edges[i][1]);
  }

  const rondel::CompressedRows<rondel::Index> expected_facets = merge_cocircular(expected_);
  ListsHandle facets;
  ASSERT_EQ(rondel_merge_cocircular(made, nullptr, &facets), RONDEL_OK);
  EXPECT_EQ(listed(rondel_list_offsets(facets), rondel_num_lists(facets) + 1),
            expected_facets.offsets);
  EXPECT_EQ(listed(rondel_list_items(facets), expected_facets.values.size()),
            expected_facets.values);
}

TEST_P(CInterface, answers_as_cpp_does) {
  TriangulationHandle made;
  ASSERT_EQ(rondel_delaunay(doubles(sites()), sites().size(), &options_, nullptr, &made),
            RONDEL_OK);
  LocatorHandle locator;
  ASSERT_EQ(rondel_locator_create(made, &locator), RONDEL_OK);
  made.reset();  // the locator keeps what it needs
  const rondel::Locator expected(expected_);
  const std::vector<Point> queries = spiral(77);
  const std::size_t q = queries.size();

  std::vector<std::uint32_t> nearest(q);
  ASSERT_EQ(rondel_nearest(locator, doubles(queries), q, nullptr, nearest.data()), RONDEL_OK);
  EXPECT_EQ(nearest, expected.nearest(queries));
  std::vector<std::uint32_t> k_nearest(4 * q);
  ASSERT_EQ(rondel_k_nearest(locator, doubles(queries), q, 4, nullptr, k_nearest.data()),
            RONDEL_OK);
  EXPECT_EQ(k_nearest, expected.k_nearest(queries, 4));
  const rondel::CompressedRows<rondel::Index> expected_lists = expected.within(queries, 0.5);
  ListsHandle lists;
  ASSERT_EQ(rondel_within(locator, doubles(queries), q, 0.5, nullptr, &lists), RONDEL_OK);
  ASSERT_EQ(rondel_num_lists(lists), q);
  EXPECT_EQ(listed(rondel_list_offsets(lists), q + 1), expected_lists.offsets);
  EXPECT_EQ(listed(rondel_list_items(lists), expected_lists.values.size()), expected_lists.values);

  std::vector<std::int32_t> where(q);
  std::vector<std::uint32_t> faces(q);
  std::vector<std::uint32_t> corners(3 * q);
  ASSERT_EQ(rondel_locate(locator, doubles(queries), q, nullptr, where.data(), faces.data(),
                          corners.data()),
            RONDEL_OK);
  const std::vector<rondel::Location> locations = expected.locate(queries);
  for (std::size_t i = 0; i < q; ++i) {
    EXPECT_EQ(where[i], static_cast<std::int32_t>(locations[i].where));
    EXPECT_EQ(faces[i], locations[i].face);
    EXPECT_TRUE(std::equal(locations[i].sites.begin(), locations[i].sites.end(), &corners[3 * i]));
  }
  if (sites().empty()) return;
  double distance = -1;
  ASSERT_EQ(rondel_distance(locator, doubles(queries), 0, &distance), RONDEL_OK);
  EXPECT_EQ(distance, expected.distance(queries[0], 0));
}

INSTANTIATE_TEST_SUITE_P(c_interface, CInterface,
                         testing::Values(Input{"projected", spiral(300), rondel::Model::projected},
                                         Input{"many", spiral(5000), rondel::Model::projected},
                                         Input{"weighted", bumpy(300), rondel::Model::weighted},
                                         Input{"ring", equator(18), rondel::Model::projected},
                                         Input{"two", spiral(2), rondel::Model::projected},
                                         Input{"one", spiral(1), rondel::Model::weighted},
                                         Input{"none", {}, rondel::Model::projected}),
                         [](const auto& input) { return input.param.name; });

TEST(c_interface, sites_of_positions_and_circles_are_those_of_cpp) {
  const std::vector<double> lonlat = {10, 20, -170.5, -90, 0, 89.25};
  const std::vector<rondel::LonLat> positions = {{10, 20}, {-170.5, -90}, {0, 89.25}};
  const std::vector<double> radii = {0, 12.5, 80};
  std::vector<double> points(9);
  ASSERT_EQ(rondel_unit_vectors(lonlat.data(), 3, points.data()), RONDEL_OK);
  EXPECT_EQ(points, flat(rondel::unit_vectors(positions)));
  ASSERT_EQ(rondel_polar_points(lonlat.data(), radii.data(), 3, points.data()), RONDEL_OK);
  EXPECT_EQ(points, flat(rondel::polar_points(positions, radii)));
  EXPECT_EQ(rondel_unit_vectors(nullptr, 0, nullptr), RONDEL_OK);
}

TEST(c_interface, hull_has_a_size) {
  const std::vector<double> cube = {0, 0, 0, 0, 0, 2, 0, 2, 0, 0, 2, 2,
                                    2, 0, 0, 2, 0, 2, 2, 2, 0, 2, 2, 2};
  TriangulationHandle hull;
  ASSERT_EQ(rondel_convex_hull(cube.data(), 8, nullptr, &hull), RONDEL_OK);
  double volume = 0;
  double area = 0;
  ASSERT_EQ(rondel_size_of_hull(hull, &volume, &area), RONDEL_OK);
  EXPECT_EQ(volume, 8);
  EXPECT_EQ(area, 24);

  // What is no hull around its center has no size.
  rondel_options options;
  rondel_options_init(&options);
  std::ranges::fill(options.center, 1.0);
  hull.reset();
  ASSERT_EQ(rondel_delaunay(cube.data(), 8, &options, nullptr, &hull), RONDEL_OK);
  EXPECT_EQ(rondel_size_of_hull(hull, &volume, &area), RONDEL_INVALID_INPUT);
  options.model = RONDEL_WEIGHTED;
  hull.reset();
  ASSERT_EQ(rondel_delaunay(cube.data(), 8, &options, nullptr, &hull), RONDEL_OK);
  ASSERT_EQ(rondel_size_of_hull(hull, &volume, &area), RONDEL_OK);
  EXPECT_EQ(volume, 8);
  options.center[0] = 9;
  hull.reset();
  ASSERT_EQ(rondel_delaunay(cube.data(), 8, &options, nullptr, &hull), RONDEL_OK);
  EXPECT_EQ(rondel_size_of_hull(hull, &volume, &area), RONDEL_INVALID_INPUT);
  EXPECT_STREQ(rondel_error_message(),
               "the center is outside of the hull; convex_hull() chooses one inside");
}

TEST(c_interface, changes_are_those_of_cpp) {
  const std::vector<Point> sites = spiral(200);
  const std::vector<Point> more = bumpy(50);
  DynamicHandle dynamic;
  ASSERT_EQ(rondel_dynamic_create(doubles(sites), sites.size(), nullptr, nullptr, &dynamic),
            RONDEL_OK);
  rondel::DynamicTriangulation expected(sites);
  std::vector<std::uint32_t> ids(more.size());
  ASSERT_EQ(rondel_insert(dynamic, doubles(more), more.size(), nullptr, ids.data()), RONDEL_OK);
  EXPECT_EQ(ids, expected.insert(more));
  const std::vector<std::uint32_t> gone = {3, 210, 77};
  ASSERT_EQ(rondel_remove(dynamic, gone.data(), gone.size(), nullptr), RONDEL_OK);
  expected.remove(gone);
  const std::vector<std::uint32_t> moved = {5, 6};
  ASSERT_EQ(rondel_move(dynamic, moved.data(), doubles(more), 2, nullptr), RONDEL_OK);
  expected.move(moved, std::span(more).first(2));
  std::vector<Point> all_moved;
  for (const std::uint32_t id : expected.ids()) {
    const Point p = expected.site(id);
    all_moved.push_back({p.x, p.y, p.z + 0.001 * p.x});
  }
  ASSERT_EQ(rondel_move_all(dynamic, doubles(all_moved), all_moved.size(), nullptr), RONDEL_OK);
  expected.move_all(all_moved);
  EXPECT_EQ(rondel_move_all(dynamic, doubles(all_moved), 1, nullptr), RONDEL_INVALID_INPUT);

  ASSERT_EQ(rondel_dynamic_num_sites(dynamic), expected.num_sites());
  std::vector<std::uint32_t> all(expected.num_sites());
  ASSERT_EQ(rondel_dynamic_ids(dynamic, all.data()), RONDEL_OK);
  EXPECT_EQ(all, expected.ids());
  ListsHandle neighbors;
  ASSERT_EQ(rondel_dynamic_neighbors(dynamic, 10, &neighbors), RONDEL_OK);
  EXPECT_EQ(listed(rondel_list_items(neighbors), rondel_list_offsets(neighbors)[1]),
            expected.neighbors(10));
  TriangulationHandle snapshot;
  ASSERT_EQ(rondel_dynamic_snapshot(dynamic, &snapshot), RONDEL_OK);
  EXPECT_STREQ(rondel_builder(snapshot), "given");
  EXPECT_EQ(listed(rondel_faces(snapshot), 3 * rondel_num_faces(snapshot)),
            flat(expected.snapshot().triangulation.faces()));

  LocatorHandle locator;
  ASSERT_EQ(rondel_locator_create_dynamic(dynamic, &locator), RONDEL_OK);
  std::uint32_t nearest = 0;
  ASSERT_EQ(rondel_nearest(locator, doubles(more), 1, nullptr, &nearest), RONDEL_OK);
  EXPECT_EQ(nearest, rondel::Locator(expected).nearest(more[0]));
  ASSERT_EQ(rondel_remove(dynamic, gone.data(), 1, nullptr), RONDEL_INVALID_INPUT);  // is gone
  ASSERT_EQ(rondel_insert(dynamic, doubles(more), 1, nullptr, ids.data()), RONDEL_OK);
  EXPECT_EQ(rondel_nearest(locator, doubles(more), 1, nullptr, &nearest), RONDEL_INVALID_INPUT);
  dynamic.reset();  // the locator keeps it
  EXPECT_EQ(rondel_nearest(locator, doubles(more), 1, nullptr, &nearest), RONDEL_INVALID_INPUT);
}

TEST(c_interface, predicates_are_exact) {
  const double a[3] = {1, 0, 0};
  const double b[3] = {0, 1, 0};
  const double c[3] = {0, 0, 1};
  const double opposite[3] = {-1, 0, 0};
  std::int32_t sign = 7;
  ASSERT_EQ(rondel_orientation(a, b, c, nullptr, &sign), RONDEL_OK);
  EXPECT_EQ(sign, 1);
  ASSERT_EQ(rondel_orientation(a, b, opposite, nullptr, &sign), RONDEL_OK);
  EXPECT_EQ(sign, 0);
  ASSERT_EQ(rondel_side_of_circle(a, b, c, opposite, nullptr, &sign), RONDEL_OK);
  EXPECT_EQ(sign, -1);
  rondel_options options;
  rondel_options_init(&options);
  for (const double radius : {-3.0, 0.0, std::numeric_limits<double>::infinity()}) {
    options.squared_radius = radius;
    EXPECT_EQ(rondel_orientation(a, b, c, &options, &sign), RONDEL_INVALID_INPUT);
    EXPECT_EQ(rondel_side_of_circle(a, b, c, opposite, &options, &sign), RONDEL_INVALID_INPUT);
    EXPECT_STREQ(rondel_error_message(),
                 "the squared radius of the sphere is not positive and finite");
  }
}

TEST(c_interface, every_failure_is_a_status_with_a_message) {
  std::vector<Point> sites = spiral(20);
  sites[7].y = std::numeric_limits<double>::quiet_NaN();
  TriangulationHandle made;
  EXPECT_EQ(rondel_delaunay(doubles(sites), sites.size(), nullptr, nullptr, &made),
            RONDEL_INVALID_INPUT);
  EXPECT_EQ(static_cast<rondel_triangulation*>(made), nullptr);
  EXPECT_EQ(rondel_error_index(), 7);
  EXPECT_NE(std::strstr(rondel_error_message(), "7"), nullptr) << rondel_error_message();

  // The message is that of this thread alone.
  std::string elsewhere = "none";
  std::thread([&] { elsewhere = rondel_error_message(); }).join();
  EXPECT_EQ(elsewhere, "");

  EXPECT_EQ(rondel_delaunay(nullptr, 3, nullptr, nullptr, &made), RONDEL_INVALID_INPUT);
  EXPECT_STREQ(rondel_error_message(), "points is NULL");
  EXPECT_EQ(rondel_delaunay(doubles(sites), 3, nullptr, nullptr, nullptr), RONDEL_INVALID_INPUT);
  EXPECT_EQ(rondel_delaunay(doubles(sites), SIZE_MAX, nullptr, nullptr, &made),
            RONDEL_INVALID_INPUT);
  rondel_options options;
  rondel_options_init(&options);
  options.model = 2;
  EXPECT_EQ(rondel_delaunay(doubles(sites), 3, &options, nullptr, &made), RONDEL_INVALID_INPUT);
  EXPECT_STREQ(rondel_error_message(), "model 2 is unknown");
  options = {};
  EXPECT_EQ(rondel_delaunay(doubles(sites), 3, &options, nullptr, &made), RONDEL_INVALID_INPUT);
  EXPECT_EQ(rondel_areas(nullptr, nullptr, nullptr), RONDEL_INVALID_INPUT);

  const std::uint32_t wrong[3] = {0, 1, 2};
  std::int32_t is_valid = -1;
  EXPECT_EQ(rondel_check(doubles(sites), 7, wrong, 1, nullptr, nullptr, &is_valid), RONDEL_OK);
  EXPECT_EQ(is_valid, 0);
  EXPECT_STRNE(rondel_error_message(), "");

  LocatorHandle locator;
  ASSERT_EQ(rondel_delaunay(doubles(sites), 7, nullptr, nullptr, &made), RONDEL_OK);
  ASSERT_EQ(rondel_locator_create(made, &locator), RONDEL_OK);
  std::uint32_t nearest = 0;
  EXPECT_EQ(rondel_nearest(locator, &sites[7].x, 1, nullptr, &nearest), RONDEL_INVALID_INPUT);
  EXPECT_EQ(rondel_k_nearest(locator, doubles(sites), 1, SIZE_MAX, nullptr, &nearest),
            RONDEL_INVALID_INPUT);
}

TEST(c_interface, work_that_is_told_to_stop_is_interrupted) {
  const std::vector<Point> sites = spiral(20000);
  rondel_execution execution;
  rondel_execution_init(&execution);
  StopHandle stop;
  ASSERT_EQ(rondel_stop_create(&stop), RONDEL_OK);
  execution.stop = stop;
  TriangulationHandle made;
  EXPECT_EQ(rondel_delaunay(doubles(sites), sites.size(), nullptr, &execution, &made), RONDEL_OK);
  made.reset();
  rondel_stop_request(stop);
  EXPECT_EQ(rondel_delaunay(doubles(sites), sites.size(), nullptr, &execution, &made),
            RONDEL_INTERRUPTED);

  // By the progress function, which is told of stages and fractions.
  struct Seen {
    int calls = 0;
    int most = 0;
    std::string stage;
  } seen;
  rondel_execution_init(&execution);
  execution.context = &seen;
  execution.progress = [](void* context, const char* stage, double fraction) -> std::int32_t {
    auto& so_far = *static_cast<Seen*>(context);
    so_far.stage = stage;
    return fraction >= 0 && ++so_far.calls == so_far.most ? 1 : 0;
  };
  EXPECT_EQ(rondel_delaunay(doubles(sites), sites.size(), nullptr, &execution, &made), RONDEL_OK);
  EXPECT_EQ(seen.stage, "triangulate");
  made.reset();
  ASSERT_GT(seen.calls, 1);
  seen = {0, 2, ""};
  EXPECT_EQ(rondel_delaunay(doubles(sites), sites.size(), nullptr, &execution, &made),
            RONDEL_INTERRUPTED);
  EXPECT_EQ(seen.calls, 2);
}

TEST(c_interface, c_sees_the_structs_that_cpp_sees) {
  EXPECT_EQ(c_size_of_options(), sizeof(rondel_options));
  EXPECT_EQ(c_size_of_execution(), sizeof(rondel_execution));
  EXPECT_STREQ(rondel_version_string(), rondel::version);
  rondel_stop_free(nullptr);
  rondel_triangulation_free(nullptr);
  rondel_options_init(nullptr);
  rondel_execution_init(nullptr);
}

}  // namespace
