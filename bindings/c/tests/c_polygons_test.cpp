// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Polygons in C are those of C++, and every failure is a status.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "rondel.h"
#include "rondel/buffer.h"
#include "rondel/polygon_files.h"
#include "rondel/polygon_triangles.h"
#include "rondel/regions.h"
#include "rondel/relate.h"
#include "rondel/set_operations.h"

namespace {

using rondel::CellRings;
using rondel::Index;
using rondel::LonLatMultiPolygons;

template <class T, void (*free_handle)(T*)>
struct Freed {
  void operator()(T* handle) const { free_handle(handle); }
};
using Features = std::unique_ptr<rondel_features, Freed<rondel_features, rondel_features_free>>;
using Polygons = std::unique_ptr<rondel_polygons, Freed<rondel_polygons, rondel_polygons_free>>;
using Triangles = std::unique_ptr<rondel_triangles, Freed<rondel_triangles, rondel_triangles_free>>;
using Texts = std::unique_ptr<rondel_texts, Freed<rondel_texts, rondel_texts_free>>;
using Lists = std::unique_ptr<rondel_lists, Freed<rondel_lists, rondel_lists_free>>;

// Returns the handle that a call makes, and expects that the call succeeds.
template <class Owner, class Call>
Owner made_by(const Call& call) {
  typename Owner::pointer handle = nullptr;
  EXPECT_EQ(call(&handle), RONDEL_OK) << rondel_error_message();
  return Owner(handle);
}

// Boxes across the antimeridian and around the pole, a box with a hole, nothing, and the sphere.
LonLatMultiPolygons some_features() {
  LonLatMultiPolygons features;
  const auto add_ring = [&](double west, double south, double east, double north) {
    const std::vector<rondel::LonLat> ring = {
        {west, south}, {east, south}, {east, north}, {west, north}, {west, south}};
    features.rows.rows.append(ring);
  };
  add_ring(170, -20, 190, 10);
  features.rows.end_group();
  features.end_group();
  add_ring(-180, 5, 180, 90);
  features.rows.end_group();
  features.end_group();
  add_ring(0, -30, 40, 30);
  add_ring(10, -10, 30, 10);
  features.rows.end_group();
  features.end_group();
  features.end_group();
  add_ring(-180, -90, 180, 90);
  features.rows.end_group();
  features.end_group();
  return features;
}

LonLatMultiPolygons bow_tie() {
  LonLatMultiPolygons features;
  const std::vector<rondel::LonLat> ring = {{0, 0}, {2, 2}, {2, 0}, {0, 2}, {0, 0}};
  features.rows.rows.append(ring);
  features.rows.end_group();
  features.end_group();
  return features;
}

Features made_of(const LonLatMultiPolygons& given) {
  return made_by<Features>([&](rondel_features** made) {
    const auto& positions = given.rows.rows.values;
    return rondel_features_create(given.offsets.data(), given.size(), given.rows.offsets.data(),
                                  given.rows.rows.offsets.data(),
                                  positions.empty() ? nullptr : &positions.front().lon_deg, made);
  });
}

Polygons polygons_of(const Features& features) {
  return made_by<Polygons>([&](rondel_polygons** made) {
    return rondel_polygons_of_features(features.get(), nullptr, nullptr, made);
  });
}

void expect_same(const rondel_features* made, const LonLatMultiPolygons& expected) {
  ASSERT_EQ(rondel_num_features(made), expected.size());
  const auto are_same = [](const std::uint64_t* found, const std::vector<std::uint64_t>& wanted) {
    return std::ranges::equal(std::span(found, wanted.size()), wanted);
  };
  EXPECT_TRUE(are_same(rondel_feature_polygons(made), expected.offsets));
  EXPECT_TRUE(are_same(rondel_feature_rings(made), expected.rows.offsets));
  EXPECT_TRUE(are_same(rondel_feature_positions(made), expected.rows.rows.offsets));
  const auto& positions = expected.rows.rows.values;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    EXPECT_EQ(rondel_feature_lonlat(made)[2 * i], positions[i].lon_deg);
    EXPECT_EQ(rondel_feature_lonlat(made)[2 * i + 1], positions[i].lat_deg);
  }
}

void expect_same(const rondel_polygons* made, const CellRings& expected) {
  ASSERT_EQ(rondel_num_polygons(made), expected.num_cells());
  EXPECT_TRUE(std::ranges::equal(std::span(rondel_polygon_rings(made), expected.cells.size()),
                                 expected.cells));
  EXPECT_TRUE(std::ranges::equal(std::span(rondel_polygon_corners(made), expected.rings.size()),
                                 expected.rings));
  for (std::size_t i = 0; i < expected.corners.size(); ++i) {
    const rondel::Point& p = expected.points[expected.corners[i]];
    EXPECT_EQ(rondel_polygon_points(made)[3 * i], p.x);
    EXPECT_EQ(rondel_polygon_points(made)[3 * i + 1], p.y);
    EXPECT_EQ(rondel_polygon_points(made)[3 * i + 2], p.z);
  }
  EXPECT_TRUE(std::ranges::equal(
      std::span(rondel_whole_polygons(made), rondel_num_whole_polygons(made)), expected.whole));
  std::vector<double> sizes(expected.num_cells());
  ASSERT_EQ(rondel_polygon_areas(made, sizes.data()), RONDEL_OK);
  EXPECT_EQ(sizes, rondel::areas(expected));
  ASSERT_EQ(rondel_polygon_lengths(made, sizes.data()), RONDEL_OK);
  EXPECT_EQ(sizes, rondel::lengths(expected));
}

// Some polygons in C and in C++.
class CPolygons : public testing::Test {
 protected:
  Features features_ = made_of(some_features());
  Polygons made_ = polygons_of(features_);
  CellRings cells_ = rondel::cells_of_polygons(some_features()).cells;
};

TEST_F(CPolygons, are_features_as_in_cpp) {
  expect_same(features_.get(), some_features());
  expect_same(made_.get(), cells_);
  const auto drawn = made_by<Features>([&](rondel_features** made) {
    return rondel_features_of_polygons(made_.get(), 0.01, nullptr, made);
  });
  expect_same(drawn.get(), rondel::multipolygons(rondel::region_polygons(
                                                     cells_, 0.01, {}, rondel::CellDrawing::apart),
                                                 cells_.num_cells()));
}

TEST_F(CPolygons, go_through_arrays_and_arrow) {
  const auto again = made_by<Polygons>([&](rondel_polygons** made) {
    return rondel_polygons_create(
        rondel_polygon_rings(made_.get()), 5, rondel_polygon_corners(made_.get()),
        rondel_polygon_points(made_.get()), rondel_whole_polygons(made_.get()), 1, made);
  });
  expect_same(again.get(), cells_);

  ArrowSchema schema;
  ArrowArray array;
  ASSERT_EQ(rondel_features_export_arrow(features_.get(), RONDEL_GEODESIC, &schema, &array),
            RONDEL_OK);
  features_.reset();  // the arrays are their own
  const auto imported = made_by<Features>(
      [&](rondel_features** made) { return rondel_features_import_arrow(&schema, &array, made); });
  expect_same(imported.get(), some_features());
  array.release(&array);
  rondel_features* none = nullptr;
  EXPECT_EQ(rondel_features_import_arrow(&schema, &array, &none), RONDEL_INVALID_INPUT);
  schema.release(&schema);
  EXPECT_EQ(rondel_features_import_arrow(&schema, &array, &none), RONDEL_INVALID_INPUT);
  EXPECT_STREQ(rondel_error_message(), "the array of Arrow was released");
}

TEST_F(CPolygons, have_the_set_operations_of_cpp) {
  using Operation = rondel::SetOperation;
  const std::vector<std::array<Index, 2>> pairs = {{0, 1}, {2, 4}, {1, 1}};
  for (const auto& [code, operation] :
       {std::pair{RONDEL_UNION, Operation::unite},
        {RONDEL_INTERSECTION, Operation::intersection},
        {RONDEL_DIFFERENCE, Operation::difference},
        {RONDEL_SYMMETRIC_DIFFERENCE, Operation::symmetric_difference}}) {
    const auto all = made_by<Polygons>([&, code = code](rondel_polygons** made) {
      return rondel_combine(made_.get(), made_.get(), code, nullptr, made);
    });
    expect_same(all.get(), rondel::combine(cells_, cells_, operation));
    const auto each = made_by<Polygons>([&, code = code](rondel_polygons** made) {
      return rondel_combine_pairs(made_.get(), made_.get(), pairs.front().data(), pairs.size(),
                                  code, nullptr, made);
    });
    expect_same(each.get(), rondel::combine_pairs(cells_, cells_, pairs, operation));
  }
  const auto united = made_by<Polygons>(
      [&](rondel_polygons** made) { return rondel_unite(made_.get(), nullptr, made); });
  expect_same(united.get(), rondel::unite(cells_));
}

TEST_F(CPolygons, relate_as_in_cpp) {
  std::vector<char> texts(std::size_t{5} * RONDEL_RELATION_SIZE);
  ASSERT_EQ(rondel_relate(made_.get(), made_.get(), nullptr, texts.data()), RONDEL_OK);
  const std::vector<rondel::Relation> expected = rondel::relate(cells_, cells_);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(&texts[RONDEL_RELATION_SIZE * i], std::string(expected[i].text()));
  }
  const std::vector<std::array<Index, 2>> pairs = {{0, 1}, {2, 1}};
  ASSERT_EQ(
      rondel_relate_pairs(made_.get(), made_.get(), pairs.front().data(), 2, nullptr, texts.data()),
      RONDEL_OK);
  EXPECT_EQ(&texts[RONDEL_RELATION_SIZE],
            std::string(rondel::relate_pairs(cells_, cells_, pairs)[1].text()));
  for (const char* const pattern : {"T*T***T**", "*********", "T*****FF*"}) {
    const auto lists = made_by<Lists>([&](rondel_lists** made) {
      return rondel_related(made_.get(), made_.get(), pattern, nullptr, made);
    });
    rondel::CompressedRows<Index> wanted;
    for (std::size_t i = 0; i < cells_.num_cells(); ++i) {
      for (std::size_t k = 0; k < cells_.num_cells(); ++k) {
        const std::vector<std::array<Index, 2>> pair = {
            {static_cast<Index>(i), static_cast<Index>(k)}};
        const rondel::Relation how = rondel::relate_pairs(cells_, cells_, pair)[0];
        std::int32_t matches = -1;
        ASSERT_EQ(rondel_relation_matches(std::string(how.text()).c_str(), pattern, &matches),
                  RONDEL_OK);
        EXPECT_EQ(matches, how.matches(pattern) ? 1 : 0);
        if (matches == 1 && how.is(rondel::SpatialPredicate::intersects)) {
          wanted.values.push_back(static_cast<Index>(k));
        }
      }
      wanted.end_row();
    }
    ASSERT_EQ(rondel_num_lists(lists.get()), wanted.size());
    EXPECT_TRUE(std::ranges::equal(
        std::span(rondel_list_offsets(lists.get()), wanted.offsets.size()), wanted.offsets));
    EXPECT_TRUE(std::ranges::equal(std::span(rondel_list_items(lists.get()), wanted.values.size()),
                                   wanted.values));
  }
}

TEST_F(CPolygons, have_the_buffers_of_cpp) {
  const auto near = made_by<Polygons>([&](rondel_polygons** made) {
    return rondel_buffer(made_.get(), -0.05, 0.01, nullptr, made);
  });
  expect_same(near.get(), rondel::buffered(cells_, {-0.05, 0.01}));
  const std::vector<rondel::Point> points = {{1, 0, 0}, {0, 0, -1}};
  const auto disks = made_by<Polygons>([&](rondel_polygons** made) {
    return rondel_buffer_points(&points.front().x, 2, 0.2, 0, nullptr, made);
  });
  expect_same(disks.get(), rondel::buffered(points, {0.2, 0}));
}

TEST_F(CPolygons, have_the_triangles_of_cpp) {
  for (const double spacing : {0.0, 10.0}) {
    const auto made = made_by<Triangles>([&](rondel_triangles** triangles) {
      return rondel_triangulate_polygons(made_.get(), spacing, nullptr, triangles);
    });
    const rondel::PolygonTriangles expected = rondel::triangles_of_polygons(cells_, spacing);
    ASSERT_EQ(rondel_num_triangle_points(made.get()), expected.points.size());
    EXPECT_TRUE(std::equal(expected.points.begin(), expected.points.end(),
                           reinterpret_cast<const rondel::Point*>(  // three doubles each
                               rondel_triangle_points(made.get()))));
    const auto& offsets = expected.triangles.offsets;
    EXPECT_TRUE(std::equal(offsets.begin(), offsets.end(), rondel_triangle_offsets(made.get())));
    EXPECT_TRUE(std::equal(expected.triangles.values.begin(), expected.triangles.values.end(),
                           reinterpret_cast<const rondel::Triple*>(  // three indices each
                               rondel_triangle_corners(made.get()))));
  }
  rondel_triangles* none = nullptr;
  EXPECT_EQ(rondel_triangulate_polygons(made_.get(), -1, nullptr, &none), RONDEL_INVALID_INPUT);
  EXPECT_EQ(none, nullptr);
  EXPECT_EQ(rondel_triangulate_polygons(nullptr, 0, nullptr, &none), RONDEL_INVALID_INPUT);
  const auto nothing = made_by<Polygons>([](rondel_polygons** polygons) {
    return rondel_polygons_create(nullptr, 0, nullptr, nullptr, nullptr, 0, polygons);
  });
  const auto empty = made_by<Triangles>([&](rondel_triangles** triangles) {
    return rondel_triangulate_polygons(nothing.get(), 0, nullptr, triangles);
  });
  EXPECT_EQ(rondel_num_triangle_points(empty.get()), 0U);
  EXPECT_EQ(rondel_triangle_offsets(empty.get())[0], 0U);
  rondel_triangles_free(nullptr);
}

TEST_F(CPolygons, that_are_not_valid_are_told_and_repaired) {
  const Features tie = made_of(bow_tie());
  const auto faults = made_by<Texts>([&](rondel_texts** made) {
    return rondel_feature_faults(tie.get(), nullptr, nullptr, made);
  });
  ASSERT_EQ(rondel_num_texts(faults.get()), 1);
  EXPECT_STREQ(rondel_text(faults.get(), 0), "ring 0 of part 0 crosses itself at 1 1");
  rondel_polygons* none = nullptr;
  EXPECT_EQ(rondel_polygons_of_features(tie.get(), nullptr, nullptr, &none), RONDEL_INVALID_INPUT);
  EXPECT_STREQ(rondel_error_message(), "feature 0: ring 0 of part 0 crosses itself at 1 1");

  rondel_reading reading;
  rondel_reading_init(&reading);
  reading.invalid = RONDEL_REPAIR;
  const auto mended = made_by<Polygons>([&](rondel_polygons** made) {
    return rondel_polygons_of_features(tie.get(), &reading, nullptr, made);
  });
  const rondel::PolygonOptions repair{.invalid = rondel::InvalidPolygons::repair};
  const CellRings expected = rondel::cells_of_polygons(bow_tie(), repair).cells;
  expect_same(mended.get(), expected);
  const auto again = made_by<Polygons>(
      [&](rondel_polygons** made) { return rondel_repair(mended.get(), nullptr, made); });
  expect_same(again.get(), rondel::repaired(expected));
}

TEST_F(CPolygons, may_have_rings_without_corners) {
  const std::uint64_t cells[] = {0, 1, 3};
  const std::uint64_t rings[] = {0, 0, 3, 3};
  const double corners[] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  const auto made = made_by<Polygons>([&](rondel_polygons** polygons) {
    return rondel_polygons_create(cells, 2, rings, corners, nullptr, 0, polygons);
  });
  std::vector<double> sizes = {-1, -1};
  ASSERT_EQ(rondel_polygon_areas(made.get(), sizes.data()), RONDEL_OK);
  EXPECT_EQ(sizes[0], 0);
  EXPECT_NEAR(sizes[1], std::numbers::pi / 2, 1e-15);
  ASSERT_EQ(rondel_polygon_lengths(made.get(), sizes.data()), RONDEL_OK);
  EXPECT_EQ(sizes[0], 0);
  const auto drawn = made_by<Features>([&](rondel_features** features) {
    return rondel_features_of_polygons(made.get(), 0.01, nullptr, features);
  });
  EXPECT_EQ(rondel_feature_polygons(drawn.get())[1], 0U);
  EXPECT_EQ(rondel_feature_polygons(drawn.get())[2], 1U);
}

// Polygon 1 has a side that leads to the opposite point: its fourth corner of all is that of its
// first one.
TEST_F(CPolygons, are_named_by_what_is_wrong_with_their_sides) {
  const std::uint64_t cells[] = {0, 1, 2};
  const std::uint64_t rings[] = {0, 3, 6};
  const double corners[] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, -1, 0, 0, 0, 1};
  const auto made = made_by<Polygons>([&](rondel_polygons** polygons) {
    return rondel_polygons_create(cells, 2, rings, corners, nullptr, 0, polygons);
  });
  const auto expect_refused = [&](rondel_status status, const std::string& message) {
    EXPECT_EQ(status, RONDEL_INVALID_INPUT);
    EXPECT_EQ(rondel_error_index(), 1U);
    EXPECT_EQ(std::string(rondel_error_message()).substr(0, message.size()), message);
  };
  rondel_triangles* triangles = nullptr;
  for (const double spacing : {0.0, 20.0}) {
    expect_refused(rondel_triangulate_polygons(made.get(), spacing, nullptr, &triangles),
                   "polygon 1 has a side that joins");
  }
  std::vector<char> texts(std::size_t{2} * RONDEL_RELATION_SIZE);
  const std::string side = "polygon 1 of the first operand has a side that leads";
  expect_refused(rondel_relate(made.get(), made.get(), nullptr, texts.data()), side);
  const std::uint32_t pair[] = {0, 0};
  expect_refused(rondel_relate_pairs(made_.get(), made.get(), pair, 1, nullptr, texts.data()),
                 "polygon 1 of the second operand has a side that leads");
  rondel_lists* lists = nullptr;
  expect_refused(rondel_related(made.get(), made_.get(), nullptr, nullptr, &lists), side);
}

TEST_F(CPolygons, that_do_not_fit_are_refused) {
  const std::uint64_t offsets[] = {0, 1};
  const std::uint64_t three[] = {0, 3};
  const std::uint64_t empty[] = {0, 0};
  const std::uint64_t falling[] = {0, 3, 2};
  const double corners[] = {1, 0, 0, 0, 1, 0, 0, 0, 2};
  const std::uint32_t whole[] = {0};
  rondel_polygons* made = nullptr;
  const auto expect_refused = [&](rondel_status status, const std::string& message,
                                  std::size_t index) {
    EXPECT_EQ(status, RONDEL_INVALID_INPUT);
    EXPECT_EQ(rondel_error_message(), message);
    EXPECT_EQ(rondel_error_index(), index);
    EXPECT_EQ(made, nullptr);
  };
  expect_refused(rondel_polygons_create(offsets, 1, three, corners, nullptr, 0, &made),
                 "corner 2 is no unit vector", 2);
  expect_refused(rondel_polygons_create(falling, 2, three, corners, nullptr, 0, &made),
                 "polygons decrease", 2);
  expect_refused(rondel_polygons_create(offsets, 1, three, corners, whole, 1, &made),
                 "corner 2 is no unit vector", 2);
  expect_refused(rondel_polygons_create(offsets, 1, three, nullptr, nullptr, 0, &made),
                 "corners is NULL", 0);
  const std::uint64_t many[] = {0, std::uint64_t{1} << 32};
  expect_refused(rondel_polygons_create(many, 1, three, corners, nullptr, 0, &made),
                 "polygons count more than can be", 1);
  for (const std::uint32_t absent : {1U, UINT32_MAX}) {
    EXPECT_EQ(rondel_polygons_create(offsets, 1, empty, nullptr, &absent, 1, &made),
              RONDEL_INVALID_INPUT);
    EXPECT_NE(std::string(rondel_error_message()).find("is not there"), std::string::npos);
  }
  EXPECT_EQ(rondel_buffer_points(corners, 3, 0.1, 0, nullptr, &made), RONDEL_INVALID_INPUT);
  EXPECT_STREQ(rondel_error_message(), "a point is no unit vector");
  EXPECT_EQ(rondel_error_index(), 2U);
  expect_refused(rondel_combine(made_.get(), nullptr, 0, nullptr, &made), "b is NULL", 0);
  expect_refused(rondel_combine(made_.get(), made_.get(), 5, nullptr, &made),
                 "the set operation 5 is unknown", 0);
  const std::uint32_t pair[] = {0, 9};
  EXPECT_EQ(rondel_combine_pairs(made_.get(), made_.get(), pair, 1, 0, nullptr, &made),
            RONDEL_INVALID_INPUT);
  std::int32_t matches = -1;
  EXPECT_EQ(rondel_relation_matches("FF", "*********", &matches), RONDEL_INVALID_INPUT);
  EXPECT_STREQ(rondel_error_message(),
               "a relation has nine characters of F 0 1 2, and is not 'FF'");
  EXPECT_EQ(rondel_relation_matches("FF2F11212", "T", &matches), RONDEL_INVALID_INPUT);
  rondel_reading reading = {};
  EXPECT_EQ(rondel_polygons_of_features(features_.get(), &reading, nullptr, &made),
            RONDEL_INVALID_INPUT);
  EXPECT_STREQ(rondel_error_message(), "the options were not made by rondel_reading_init()");
  rondel_reading_init(&reading);
  reading.tolerance_deg = -1;
  EXPECT_EQ(rondel_polygons_of_features(features_.get(), &reading, nullptr, &made),
            RONDEL_INVALID_INPUT);
  EXPECT_STREQ(rondel_error_message(), "the tolerance -1 is not positive");
  const auto nothing = made_by<Polygons>([&](rondel_polygons** handle) {
    return rondel_polygons_create(nullptr, 0, nullptr, nullptr, nullptr, 0, handle);
  });
  expect_same(nothing.get(), CellRings());
}

}  // namespace
