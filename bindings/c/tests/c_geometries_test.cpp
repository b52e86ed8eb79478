// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Points, lines and polygons in C are those of C++, and every failure is a status.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "rondel.h"
#include "rondel/arrow.h"
#include "rondel/geometries.h"
#include "rondel/regions.h"
#include "rondel/set_operations.h"

namespace {

using rondel::Geometries;
using rondel::GeometryPieces;
using rondel::Index;
using rondel::LonLatGeometries;

template <class T, void (*free_handle)(T*)>
struct FreedHandle {
  void operator()(T* handle) const { free_handle(handle); }
};
using LonLatHandle =
    std::unique_ptr<rondel_lonlat_geometries,
                    FreedHandle<rondel_lonlat_geometries, rondel_lonlat_geometries_free>>;
using GeometriesHandle =
    std::unique_ptr<rondel_geometries, FreedHandle<rondel_geometries, rondel_geometries_free>>;
using PiecesHandle = std::unique_ptr<rondel_pieces, FreedHandle<rondel_pieces, rondel_pieces_free>>;
using FeaturesHandle =
    std::unique_ptr<rondel_features, FreedHandle<rondel_features, rondel_features_free>>;

// Returns the handle that a call makes, and expects that the call succeeds.
template <class Owner, class Call>
Owner handle_of(const Call& call) {
  typename Owner::pointer handle = nullptr;
  EXPECT_EQ(call(&handle), RONDEL_OK) << rondel_error_message();
  return Owner(handle);
}

void add_box(LonLatGeometries& geometries, double west, double south, double east, double north) {
  const std::vector<rondel::LonLat> ring = {
      {west, south}, {east, south}, {east, north}, {west, north}, {west, south}};
  geometries.polygons.rows.rows.append(ring);
  geometries.polygons.rows.end_group();
}

// Ends a geometry of the lines and polygons that were added since the last one.
void end_geometry(LonLatGeometries& geometries) {
  geometries.lines.end_group();
  geometries.polygons.end_group();
}

// Two boxes, of which one is beyond the antimeridian and has a line beside it; nothing.
LonLatGeometries some_areas() {
  LonLatGeometries made;
  add_box(made, 0, 0, 10, 10);
  end_geometry(made);
  add_box(made, 175, -5, 185, 5);
  made.lines.rows.append(std::vector<rondel::LonLat>{{20, 0}, {30, 0}, {30, 10}});
  end_geometry(made);
  end_geometry(made);
  return made;
}

// A line through both boxes' latitudes, points in and beside a box, and a box that overlaps the first.
LonLatGeometries some_others() {
  LonLatGeometries made;
  made.lines.rows.append(std::vector<rondel::LonLat>{{-5, 4}, {15, 5}});
  made.lines.rows.append(std::vector<rondel::LonLat>{{170, 0}, {190, 1}});
  end_geometry(made);
  for (const double lon : {5.0, 10.0, 12.0}) {
    made.lines.rows.append(std::vector<rondel::LonLat>{{lon, 3}});
  }
  end_geometry(made);
  add_box(made, 8, 2, 22, 12);
  end_geometry(made);
  return made;
}

LonLatHandle lonlat_handle(const LonLatGeometries& given) {
  const auto& polygons = given.polygons;
  const auto features = handle_of<FeaturesHandle>([&](rondel_features** made) {
    const auto& positions = polygons.rows.rows.values;
    return rondel_features_create(polygons.offsets.data(), polygons.size(),
                                  polygons.rows.offsets.data(), polygons.rows.rows.offsets.data(),
                                  positions.empty() ? nullptr : &positions.front().lon_deg, made);
  });
  return handle_of<LonLatHandle>([&](rondel_lonlat_geometries** made) {
    const auto& positions = given.lines.rows.values;
    return rondel_lonlat_geometries_create(
        given.lines.offsets.data(), given.size(), given.lines.rows.offsets.data(),
        positions.empty() ? nullptr : &positions.front().lon_deg, features.get(), made);
  });
}

template <class Wanted>
bool are_same(const std::uint64_t* found, const std::vector<Wanted>& wanted) {
  return std::equal(wanted.begin(), wanted.end(), found);
}

void expect_lonlat(const rondel_lonlat_geometries* made, const LonLatGeometries& expected) {
  ASSERT_EQ(rondel_num_lonlat_geometries(made), expected.size());
  EXPECT_TRUE(are_same(rondel_lonlat_line_groups(made), expected.lines.offsets));
  EXPECT_TRUE(are_same(rondel_lonlat_lines(made), expected.lines.rows.offsets));
  const auto& positions = expected.lines.rows.values;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    EXPECT_EQ(rondel_lonlat_line_positions(made)[2 * i], positions[i].lon_deg);
    EXPECT_EQ(rondel_lonlat_line_positions(made)[2 * i + 1], positions[i].lat_deg);
  }
  const rondel_features* const polygons = rondel_lonlat_polygons(made);
  ASSERT_EQ(rondel_num_features(polygons), expected.polygons.size());
  EXPECT_TRUE(are_same(rondel_feature_polygons(polygons), expected.polygons.offsets));
  EXPECT_TRUE(are_same(rondel_feature_rings(polygons), expected.polygons.rows.offsets));
  EXPECT_TRUE(are_same(rondel_feature_positions(polygons), expected.polygons.rows.rows.offsets));
}

void expect_geometries(const rondel_geometries* made, const Geometries& expected) {
  ASSERT_EQ(rondel_num_geometries(made), expected.size());
  EXPECT_TRUE(are_same(rondel_line_groups(made), expected.lines.offsets));
  EXPECT_TRUE(are_same(rondel_lines(made), expected.lines.rows.offsets));
  const auto& points = expected.lines.rows.values;
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(rondel_line_points(made)[3 * i], points[i].x);
    EXPECT_EQ(rondel_line_points(made)[3 * i + 1], points[i].y);
    EXPECT_EQ(rondel_line_points(made)[3 * i + 2], points[i].z);
  }
  const rondel_polygons* const polygons = rondel_geometry_polygons(made);
  ASSERT_EQ(rondel_num_polygons(polygons), expected.polygons.num_cells());
  EXPECT_TRUE(are_same(rondel_polygon_rings(polygons), expected.polygons.cells));
  EXPECT_TRUE(are_same(rondel_polygon_corners(polygons), expected.polygons.rings));
  for (std::size_t i = 0; i < expected.polygons.corners.size(); ++i) {
    const rondel::Point& p = expected.polygons.points[expected.polygons.corners[i]];
    EXPECT_EQ(rondel_polygon_points(polygons)[3 * i], p.x);
    EXPECT_EQ(rondel_polygon_points(polygons)[3 * i + 1], p.y);
    EXPECT_EQ(rondel_polygon_points(polygons)[3 * i + 2], p.z);
  }
  std::vector<double> sizes(expected.size());
  ASSERT_EQ(rondel_line_lengths(made, sizes.data()), RONDEL_OK);
  EXPECT_EQ(sizes, rondel::lengths(expected.lines));
}

// Two sets in C and in C++, which are read together.
class CGeometries : public testing::Test {
 protected:
  CGeometries() {
    std::array<rondel_geometries*, 2> made = {};
    const std::array<const rondel_lonlat_geometries*, 2> sets = {areas_.get(), others_.get()};
    EXPECT_EQ(rondel_geometries_of_lonlat(sets.data(), 2, nullptr, nullptr, made.data()), RONDEL_OK)
        << rondel_error_message();
    a_.reset(made[0]);
    b_.reset(made[1]);
    const std::vector<LonLatGeometries> given = {some_areas(), some_others()};
    std::vector<rondel::FeatureTable> tables = rondel::features_of_geometries(given);
    first_ = {tables[0].lines, tables[0].polygons};
    second_ = {tables[1].lines, tables[1].polygons};
  }

  LonLatHandle areas_ = lonlat_handle(some_areas());
  LonLatHandle others_ = lonlat_handle(some_others());
  GeometriesHandle a_;
  GeometriesHandle b_;
  Geometries first_;
  Geometries second_;
};

TEST_F(CGeometries, are_those_of_cpp) {
  expect_lonlat(areas_.get(), some_areas());
  expect_geometries(a_.get(), first_);
  expect_geometries(b_.get(), second_);
  const auto again = handle_of<GeometriesHandle>([&](rondel_geometries** made) {
    return rondel_geometries_create(rondel_line_groups(b_.get()), second_.size(),
                                    rondel_lines(b_.get()), rondel_line_points(b_.get()),
                                    rondel_geometry_polygons(b_.get()), made);
  });
  expect_geometries(again.get(), second_);
}

TEST_F(CGeometries, go_through_arrow) {
  for (const std::int32_t parts : {RONDEL_POINT_PARTS, RONDEL_LINE_PARTS, RONDEL_POLYGON_PARTS}) {
    ArrowSchema schema;
    ArrowArray array;
    ASSERT_EQ(
        rondel_lonlat_geometries_export_arrow(others_.get(), parts, RONDEL_LONLAT, &schema, &array),
        RONDEL_OK);
    const LonLatGeometries expected = rondel::import_arrow_geometries(schema, array);
    const auto taken = handle_of<LonLatHandle>([&](rondel_lonlat_geometries** made) {
      return rondel_lonlat_geometries_import_arrow(&schema, &array, made);
    });
    expect_lonlat(taken.get(), expected);
    EXPECT_EQ(expected.lines.rows.size(),
              (std::array<std::size_t, 3>{3, 2, 0}[static_cast<std::size_t>(parts)]));
    EXPECT_EQ(expected.polygons.rows.size(), parts == RONDEL_POLYGON_PARTS ? 1U : 0U);
    array.release(&array);
    schema.release(&schema);
  }
}

TEST_F(CGeometries, have_the_set_operations_of_cpp) {
  using Operation = rondel::SetOperation;
  const std::vector<std::array<Index, 2>> pairs = {{0, 1}, {1, 0}, {2, 2}};
  for (const auto& [code, operation] :
       {std::pair{RONDEL_UNION, Operation::unite},
        {RONDEL_INTERSECTION, Operation::intersection},
        {RONDEL_DIFFERENCE, Operation::difference},
        {RONDEL_SYMMETRIC_DIFFERENCE, Operation::symmetric_difference},
        {RONDEL_IDENTITY, Operation::identity}}) {
    const auto all = handle_of<GeometriesHandle>([&, code = code](rondel_geometries** made) {
      return rondel_combine_geometries(a_.get(), b_.get(), code, nullptr, made);
    });
    expect_geometries(all.get(), rondel::combine(first_, second_, operation));
    const auto each = handle_of<GeometriesHandle>([&, code = code](rondel_geometries** made) {
      return rondel_combine_geometry_pairs(a_.get(), b_.get(), pairs.front().data(), pairs.size(),
                                           code, nullptr, made);
    });
    expect_geometries(each.get(), rondel::combine_pairs(first_, second_, pairs, operation));
  }
  const auto united = handle_of<GeometriesHandle>(
      [&](rondel_geometries** made) { return rondel_unite_geometries(b_.get(), nullptr, made); });
  const Geometries expected = rondel::unite(second_);
  expect_geometries(united.get(), expected);
  const auto drawn = handle_of<LonLatHandle>([&](rondel_lonlat_geometries** made) {
    return rondel_lonlat_of_geometries(united.get(), 0.01, nullptr, made);
  });
  LonLatGeometries wanted;
  const rondel::LonLatLines lines = rondel::lonlat_lines(expected.lines, 0.01);
  wanted.lines = {{0, lines.parts.size()}, lines.parts};
  wanted.polygons = rondel::multipolygons(
      rondel::region_polygons(expected.polygons, 0.01, {}, rondel::CellDrawing::apart), 1);
  expect_lonlat(drawn.get(), wanted);
}

void expect_owners(const rondel_pieces* made, const std::vector<Index>& in_a,
                   const std::vector<Index>& in_b) {
  ASSERT_EQ(rondel_num_pieces(made), in_a.size());
  EXPECT_TRUE(std::equal(in_a.begin(), in_a.end(), rondel_piece_owners_in_a(made)));
  EXPECT_TRUE(std::equal(in_b.begin(), in_b.end(), rondel_piece_owners_in_b(made)));
}

TEST_F(CGeometries, divide_each_other_as_in_cpp) {
  for (const std::int32_t keeps_touching : {0, 1}) {
    const auto pieces = handle_of<PiecesHandle>([&](rondel_pieces** made) {
      return rondel_overlay_geometry_pieces(a_.get(), b_.get(), RONDEL_UNION, keeps_touching,
                                            nullptr, made);
    });
    GeometryPieces expected = rondel::overlay_pieces(first_, second_, rondel::SetOperation::unite);
    if (keeps_touching == 0) expected = without_touching_parts(expected, first_, second_);
    expect_owners(pieces.get(), expected.first, expected.second);
    expect_geometries(rondel_piece_geometries(pieces.get()), expected.pieces);
  }
  const auto of_polygons = handle_of<PiecesHandle>([&](rondel_pieces** made) {
    return rondel_overlay_pieces(rondel_geometry_polygons(a_.get()),
                                 rondel_geometry_polygons(b_.get()), RONDEL_IDENTITY, nullptr,
                                 made);
  });
  const rondel::RegionPieces expected =
      rondel::overlay_pieces(first_.polygons, second_.polygons, rondel::SetOperation::identity);
  expect_owners(of_polygons.get(), expected.cells, expected.regions);
  Geometries wanted;
  wanted.polygons = expected.rings;
  wanted.lines.offsets.assign(expected.num_pieces() + 1, 0);
  expect_geometries(rondel_piece_geometries(of_polygons.get()), wanted);
  EXPECT_EQ(expected.num_pieces(), 3U) << "two of the first box, and the second one";
  rondel_pieces_free(nullptr);
}

TEST_F(CGeometries, that_are_not_valid_are_refused) {
  const std::uint64_t groups[] = {0, 1};
  const std::uint64_t lines[] = {0, 2};
  const double jump[] = {0, 0, 190, 0};
  const auto far = handle_of<LonLatHandle>([&](rondel_lonlat_geometries** made) {
    return rondel_lonlat_geometries_create(groups, 1, lines, jump, nullptr, made);
  });
  std::array<const rondel_lonlat_geometries*, 2> sets = {areas_.get(), far.get()};
  std::array<rondel_geometries*, 2> made = {a_.get(), a_.get()};
  EXPECT_EQ(rondel_geometries_of_lonlat(sets.data(), 2, nullptr, nullptr, made.data()),
            RONDEL_INVALID_INPUT);
  EXPECT_EQ(rondel_error_index(), 3U) << "counted over both sets: " << rondel_error_message();
  EXPECT_EQ(made[0], nullptr);
  EXPECT_EQ(made[1], nullptr);
  rondel_reading reading;
  rondel_reading_init(&reading);
  reading.invalid = RONDEL_REPAIR;
  EXPECT_EQ(rondel_geometries_of_lonlat(sets.data(), 2, &reading, nullptr, made.data()), RONDEL_OK);
  for (rondel_geometries* const one : made) rondel_geometries_free(one);
  sets[1] = nullptr;
  EXPECT_EQ(rondel_geometries_of_lonlat(sets.data(), 2, nullptr, nullptr, made.data()),
            RONDEL_INVALID_INPUT);
  EXPECT_STREQ(rondel_error_message(), "a set is NULL");
}

TEST_F(CGeometries, that_do_not_fit_are_refused) {
  const std::uint64_t groups[] = {0, 1};
  const std::uint64_t lines[] = {0, 2};
  const double points[] = {1, 0, 0, 0, 2, 0};
  rondel_geometries* one = nullptr;
  EXPECT_EQ(rondel_geometries_create(groups, 1, lines, points, nullptr, &one),
            RONDEL_INVALID_INPUT);
  EXPECT_STREQ(rondel_error_message(), "point 1 is no unit vector");
  EXPECT_EQ(
      rondel_geometries_create(groups, 1, lines, points, rondel_geometry_polygons(a_.get()), &one),
      RONDEL_INVALID_INPUT);
  const double opposite[] = {1, 0, 0, -1, 0, 0};
  const auto line = handle_of<GeometriesHandle>([&](rondel_geometries** handle) {
    return rondel_geometries_create(groups, 1, lines, opposite, nullptr, handle);
  });
  EXPECT_EQ(rondel_combine_geometries(a_.get(), line.get(), RONDEL_UNION, nullptr, &one),
            RONDEL_INVALID_INPUT);
  EXPECT_EQ(rondel_error_index(), 3U) << "the geometries of B follow those of A";
  EXPECT_EQ(rondel_combine_geometries(a_.get(), nullptr, RONDEL_UNION, nullptr, &one),
            RONDEL_INVALID_INPUT);
  EXPECT_STREQ(rondel_error_message(), "b is NULL");
  EXPECT_EQ(rondel_combine_geometries(a_.get(), b_.get(), 5, nullptr, &one), RONDEL_INVALID_INPUT);
  EXPECT_STREQ(rondel_error_message(), "the set operation 5 is unknown");
  const std::uint32_t pair[] = {0, 9};
  EXPECT_EQ(rondel_combine_geometry_pairs(a_.get(), b_.get(), pair, 1, 0, nullptr, &one),
            RONDEL_INVALID_INPUT);
  EXPECT_EQ(one, nullptr);
  ArrowSchema schema;
  ArrowArray array;
  EXPECT_EQ(rondel_lonlat_geometries_export_arrow(areas_.get(), 3, RONDEL_LONLAT, &schema, &array),
            RONDEL_INVALID_INPUT);
  EXPECT_STREQ(rondel_error_message(), "the parts 3 are unknown");
}

}  // namespace
