// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The names of enumerations, as help texts, files and Python have them.

#include "rondel/names.h"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

#include "rondel/cell_set.h"
#include "rondel/graphs.h"
#include "rondel/io.h"
#include "rondel/polygon_files.h"
#include "rondel/query.h"
#include "rondel/regrid.h"
#include "rondel/remap.h"
#include "rondel/triangulation.h"

namespace rondel::test {
namespace {

template <class Value>
void expect_names(const std::vector<std::string_view>& names) {
  EXPECT_EQ(names_of<Value>(), names);
  for (std::size_t k = 0; k < names.size(); ++k) {
    EXPECT_EQ(name_of(static_cast<Value>(k)), names[k]);
    EXPECT_EQ(from_name<Value>(names[k]), static_cast<Value>(k));
  }
  for (const int number : {static_cast<int>(names.size()), 255}) {
    EXPECT_EQ(name_of(static_cast<Value>(number)), "");
  }
  for (const std::string_view other : {"", "Linear", "no name"}) {
    EXPECT_FALSE(from_name<Value>(other).has_value());
  }
}

TEST(names, are_those_of_the_enumerators) {
  EXPECT_EQ(from_name<Method>("sibson"), Method::sibson);
  EXPECT_EQ(from_name<GraphKind>("mst"), GraphKind::spanning_tree);
  EXPECT_EQ(from_name<PolygonOverlap>("error"), PolygonOverlap::error);
  EXPECT_EQ(from_name<CellOverlap>("error"), CellOverlap::error);
  EXPECT_EQ(name_of(RemapNorm::fracarea), "fracarea");
  EXPECT_EQ(name_of(GridSides::great_circles), "great_circles");
  EXPECT_EQ(name_of(PolygonEdges::geodesic), "geodesic");
  EXPECT_EQ(name_of(Model::weighted), "weighted");
  EXPECT_EQ(name_of(Where::outside), "outside");
}

TEST(names, lead_back_to_their_values) {
  expect_names<Method>({"nearest", "linear", "laplace", "sibson", "hermite", "cubic"});
  expect_names<RegridMethod>({"bilinear", "nearest_d2s"});
  expect_names<Outside>({"nan", "nearest", "error"});
  expect_names<SharedPlace>({"first", "mean", "error"});
  expect_names<Normalization>({"unity", "homogeneous"});
  expect_names<Undetermined>({"zero", "missing"});
  expect_names<GraphKind>({"delaunay", "urquhart", "gabriel", "relative", "mst"});
  expect_names<GridSides>({"parallels", "great_circles"});
  expect_names<PolygonEdges>({"lonlat", "geodesic"});
  expect_names<PolygonOverlap>({"keep", "error", "first"});
  expect_names<NetcdfKind>({"by_name", "cdf2", "cdf5", "nc4"});
  expect_names<RemapNorm>({"destarea", "fracarea"});
  expect_names<CellOverlap>({"error", "first", "share"});
  expect_names<Model>({"projected", "weighted"});
  expect_names<Where>({"vertex", "edge", "face", "outside"});
}

}  // namespace
}  // namespace rondel::test
