// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Regridding of files: values against weights that are applied by hand, and the same bytes for any
// memory, tiles and threads.

#include "rondel/regrid_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rondel/cell_set.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/fields.h"
#include "rondel/interpolate.h"
#include "rondel/io.h"
#include "rondel/named_grids.h"
#include "rondel/names.h"
#include "rondel/regrid.h"
#include "support/temporary_files.h"
#include "support/thrown.h"

namespace rondel::test {
namespace {

std::string file_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Some smooth numbers of four digits, which floats hold exactly.
double value_at(const LonLat& place, std::size_t field) {
  const double x = std::floor(40 * std::sin(place.lat_deg / 20 + static_cast<double>(field)));
  return 300 + x + std::floor(place.lon_deg / 8);
}

// The grid of an input: its centers, and the fields "warm" of two times, "kind" with flags, and
// "patchy" with gaps.
FieldSet made_fields(const std::vector<LonLat>& places) {
  FieldSet fields;
  fields.num_points = places.size();
  FieldArray warm{"warm", {"time"}, {2}, {}, {{"units", "K"}}, {}, true};
  FieldArray kind{"kind", {}, {}, {}, {{"flag_meanings", "a b c"}}, {{"flag_values", {1, 2, 3}}}};
  FieldArray patchy{"patchy", {}, {}, {}, {}, {}};
  for (std::size_t f = 0; f < 2; ++f) {
    for (const LonLat& place : places) warm.values.push_back(value_at(place, f));
  }
  for (const LonLat& place : places) {
    kind.values.push_back(1 + std::fmod(std::floor(std::abs(place.lat_deg) / 25), 3));
    patchy.values.push_back(place.lon_deg > 100 && place.lat_deg < 40 ? nan : value_at(place, 3));
  }
  fields.arrays = {warm, kind, patchy};
  fields.axes = {{"time", {"time"}, {2}, {0, 6}, {{"units", "hours since 2000-01-01"}}, {}}};
  fields.others = {{"height", {}, {}, {2.5}, {{"units", "m"}}, {}}};
  fields.attributes = {{"title", "a test"}, {"history", "made"}};
  return fields;
}

// Writes the fields on a grid between meridians and parallels.
FieldSet write_input(const std::string& path, const std::string& grid) {
  const NamedGrid named(grid);
  const FieldSet fields = made_fields(named.centers());
  WeightSide side;
  side.axes = *named.axes();
  side.shape = named.shape();
  write_fields({path, {}}, fields, side);
  return fields;
}

FieldSet regridded(const std::string& in, const std::string& target, const std::string& out,
                   const RegridFileOptions& options = {}, const Execution& execution = {}) {
  regrid_file({in, {}}, {target, {}}, {out, {}}, options, execution);
  return read_fields({out, {}}, {}, 0);
}

void expect_values(const std::vector<double>& found, const std::vector<double>& wanted,
                   double tolerance, const std::string& what) {
  ASSERT_EQ(found.size(), wanted.size()) << what;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (std::isnan(wanted[i])) {
      EXPECT_TRUE(std::isnan(found[i])) << what << ' ' << i;
    } else {
      EXPECT_NEAR(found[i], wanted[i], tolerance) << what << ' ' << i;
    }
  }
}

std::vector<double> applied(const Weights& weights, const std::vector<double>& values,
                            std::size_t num_fields) {
  std::vector<double> out(num_fields * weights.num_rows());
  apply(weights, values, out, num_fields, {.max_missing = 0.5});
  return out;
}

TEST(regrid_files, conservative_values_are_means_over_cells) {
  const std::string in = temporary_path("in.nc");
  const FieldSet fields = write_input(in, "grid:10");
  for (const char* const target : {"healpix:2", "healpix:2:ring", "F4", "O4", "C4", "R2B1"}) {
    const Remap remap = rondel::remap(NamedGrid("grid:10").cells(), NamedGrid(target).cells());
    const FieldSet out = regridded(in, target, temporary_path("out.nc"));
    ASSERT_EQ(out.arrays.size(), 3U);
    EXPECT_EQ(out.arrays[0].name, "warm");
    EXPECT_EQ(out.arrays[0].shape, std::vector<std::uint64_t>{2});
    expect_values(out.arrays[0].values, applied(remap.weights, fields.arrays[0].values, 2), 2e-5,
                  target);
    expect_values(out.arrays[2].values, applied(remap.weights, fields.arrays[2].values, 1), 0,
                  target);
    ASSERT_EQ(out.axes.size(), 1U);
    EXPECT_EQ(out.axes[0].values, (std::vector<double>{0, 6}));
    EXPECT_EQ(out.positions.size(), NamedGrid(target).num_cells());
  }
}

// The share of each kind in each target, summed by hand.
TEST(regrid_files, flags_get_the_kind_of_the_largest_part) {
  const std::string in = temporary_path("in.nc");
  const FieldSet fields = write_input(in, "grid:10");
  const Remap remap = rondel::remap(NamedGrid("grid:10").cells(), NamedGrid("C3").cells());
  const FieldSet out = regridded(in, "C3", temporary_path("out.nc"));
  for (std::size_t j = 0; j < remap.target_areas.size(); ++j) {
    std::map<double, double> parts;
    for (auto k = remap.pieces.offsets[j]; k < remap.pieces.offsets[j + 1]; ++k) {
      parts[fields.arrays[1].values[remap.pieces.values[k]]] += remap.areas[k];
    }
    for (const auto& [kind, part] : parts) {
      EXPECT_LE(part, parts[out.arrays[1].values[j]] + 1e-12) << j;
    }
  }
}

TEST(regrid_files, flags_stay_flags_where_values_are_those_of_sources) {
  const std::string in = temporary_path("in.nc");
  write_input(in, "grid:30");
  for (const std::string_view name : names_of<FieldMethod>()) {
    const FieldMethod method = *from_name<FieldMethod>(name);
    if (method == FieldMethod::native) continue;  // grids along axes are no meshes
    for (const auto filling :
         {std::optional<Extrapolation>(), std::optional(Extrapolation::nearest),
          std::optional(Extrapolation::idw)}) {
      RegridFileOptions options{.names = {"kind"}, .method = method};
      if (filling) options.extrapolation = ExtrapolationOptions{.method = *filling};
      const FieldSet out = regridded(in, "grid:45", temporary_path("out.nc"), options);
      const bool is_choice = method == FieldMethod::largest_share || method == FieldMethod::nearest;
      const bool are_flags = is_choice && filling != Extrapolation::idw;
      EXPECT_EQ(out.arrays[0].numbers.size(), are_flags ? 1U : 0U) << name_of(method);
      const auto has_meanings =
          std::ranges::count(out.arrays[0].attributes, "flag_meanings",
                             [](const auto& attribute) { return attribute.first; });
      EXPECT_EQ(has_meanings, are_flags ? 1 : 0) << name_of(method);
    }
  }
}

TEST(regrid_files, a_command_says_what_changes_values) {
  EXPECT_EQ(regrid_command("in.nc", "grid:1"), "rondel regrid in.nc grid:1");
  RegridFileOptions options{.names = {"t", "tas[3]"}, .method = FieldMethod::conservative_2nd};
  options.source = FileName{"a b.nc", {}};
  options.norm = RemapNorm::destarea;
  options.limiter = RemapLimiter::bounds;
  options.max_missing = 0.25;
  options.overlap = CellOverlap::first;
  options.vectors = {{"u", "v"}};
  options.extrapolation =
      ExtrapolationOptions{.method = Extrapolation::idw, .max_distance_km = 50.5, .neighbors = 3};
  options.cells.sides = GridSides::great_circles;
  options.cells.invalid = InvalidPolygons::repair;
  options.cells.corners = MissingCorners::made;
  EXPECT_EQ(regrid_command("it's.nc", "C4", options),
            "rondel regrid 'it'\\''s.nc' C4 --value t --value 'tas[3]' --source 'a b.nc' "
            "--method conservative-2nd --norm destarea --max-missing 0.25 --overlap first "
            "--limiter bounds --vector u,v --extrapolate idw --extrapolate-distance 50.5 "
            "--extrapolate-sources 3 --sides great-circles --invalid repair --corners made");
  RegridFileOptions of_zones;
  of_zones.statistics = zonal_statistics_of("mean,quantile:0.10");
  of_zones.statistic_weights = ZonalWeights::fraction;
  of_zones.cells.edges = PolygonEdges::geodesic;
  of_zones.memory = 1;
  of_zones.cells_per_tile = 5;
  of_zones.resume = true;
  EXPECT_EQ(regrid_command("in.nc", "p.geojson", of_zones),
            "rondel regrid in.nc p.geojson --edges geodesic --statistics mean,quantile:0.1 "
            "--weigh-by fraction");
}

TEST(regrid_files, methods_between_places_are_those_of_the_interpolator) {
  const std::string in = temporary_path("in.nc");
  const FieldSet fields = write_input(in, "grid:10");
  const NamedGrid source("grid:10");
  const NamedGrid target("O3");
  const std::vector<Point> sites = unit_vectors(source.centers());
  const std::vector<Point> targets = unit_vectors(target.centers());
  const Triangulation triangulation = delaunay(sites);
  const Interpolator interpolator(triangulation);
  for (const char* const name : {"nearest", "linear", "laplace", "sibson", "hermite", "cubic"}) {
    const FieldSet out = regridded(in, "O3", temporary_path("out.nc"),
                                   {.names = {"patchy"}, .method = from_name<FieldMethod>(name)});
    const Weights weights = interpolator.weights(targets, {.method = *from_name<Method>(name)});
    expect_values(out.arrays[0].values, applied(weights, fields.arrays[2].values, 1), 0, name);
  }
  const FieldSet out = regridded(in, "O3", temporary_path("out.nc"),
                                 {.names = {"patchy"}, .method = FieldMethod::bilinear});
  expect_values(
      out.arrays[0].values,
      applied(bilinear_weights(*source.axes(), target.centers()), fields.arrays[2].values, 1), 0,
      "bilinear");
}

TEST(regrid_files, bytes_depend_on_neither_tiles_nor_memory_nor_threads) {
  const std::string in = temporary_path("in.nc");
  const std::string out = temporary_path("out.nc");
  const std::string other = temporary_path("other.nc");
  write_input(in, "grid:6");
  for (const char* const target : {"healpix:3", "F10", "grid:9", "N32", "R2B2"}) {
    regridded(in, target, out);
    const std::string whole = file_bytes(out);
    for (const std::size_t tile : {300U, 3000U}) {
      for (const std::uint64_t memory : {std::uint64_t{1} << 21U, std::uint64_t{1} << 30U}) {
        for (const unsigned threads : {1U, 3U}) {
          regridded(in, target, other, {.memory = memory, .cells_per_tile = tile},
                    {.threads = threads});
          EXPECT_TRUE(file_bytes(other) == whole) << target << ' ' << tile << ' ' << memory;
        }
      }
    }
  }
}

// There and back through grids whose files have no coordinates of their own.
TEST(regrid_files, sources_are_named_or_files) {
  const std::string in = temporary_path("in.nc");
  const std::string pixels = temporary_path("pixels.nc");
  const std::string back = temporary_path("back.nc");
  write_input(in, "grid:10");
  regridded(in, "healpix:3", pixels);
  const Remap remap = rondel::remap(NamedGrid("healpix:3").cells(), NamedGrid("grid:20").cells());
  const FieldSet middle = read_fields({pixels, {}}, {}, 0);
  for (const std::size_t tile : {0U, 200U}) {
    const FieldSet out = regridded(pixels, "grid:20", back,
                                   {.source = FileName{"healpix:3", {}}, .cells_per_tile = tile});
    expect_values(out.arrays[2].values, applied(remap.weights, middle.arrays[2].values, 1), 0,
                  "named");
  }
  const FieldSet same = regridded(in, "grid:20", back, {.source = FileName{in, {}}});
  const FieldSet own = regridded(in, "grid:20", back);
  expect_values(same.arrays[2].values, own.arrays[2].values, 0, "file");
}

// A target of which sources cover less than the wanted share has no value; with fracarea the others
// keep constants.
TEST(regrid_files, targets_need_enough_of_what_covers_them) {
  const std::string in = temporary_path("in.nc");
  const LonLatAxes axes{{5, 15, 25, 35}, {-15, -5, 5, 15}};
  FieldSet fields;
  fields.num_points = 16;
  fields.arrays = {{"one", {}, {}, std::vector<double>(16, 7), {}, {}}};
  WeightSide side;
  side.axes = axes;
  side.shape = {4, 4};
  write_fields({in, {}}, fields, side);
  const auto known = [&](double max_missing) {
    const FieldSet out =
        regridded(in, "grid:30", temporary_path("out.nc"), {.max_missing = max_missing});
    std::size_t count = 0;
    for (const double value : out.arrays[0].values) {
      if (std::isnan(value)) continue;
      EXPECT_NEAR(value, 7, 1e-14);
      ++count;
    }
    return count;
  };
  // From 0 to 40 degrees east, 20 degrees on both sides of the equator: the cells from 0 to 30
  // degrees are covered by two thirds, those from 30 to 60 by two ninths.
  EXPECT_EQ(known(0), 0U);
  EXPECT_EQ(known(0.4), 2U);
  EXPECT_EQ(known(0.5), 2U);
  EXPECT_EQ(known(0.8), 4U);
  EXPECT_EQ(known(1), 4U);
}

TEST(regrid_files, refuse_what_does_not_fit) {
  const std::string in = temporary_path("in.nc");
  const std::string out = temporary_path("refused.nc");
  write_input(in, "grid:30");
  const auto why = [&](const std::string& target, const RegridFileOptions& options = {}) {
    return thrown_message<FileError>([&] {
      return regrid_file({in, {}}, {target, {}}, {out, {}}, options);
    });
  };
  EXPECT_EQ(why("N33").substr(0, 20), "'N33' is no grid: N ");
  EXPECT_EQ(why("nothing.nc"), "nothing.nc: No such file or directory");
  EXPECT_EQ(why("healpx:4").substr(0, 55),
            "healpx:4 is neither a file nor a grid: grids are grid:D");
  const std::string table = temporary_path("points.csv");
  std::ofstream(table) << "lon,lat\n0,0\n";
  const auto why_input = [&](const std::string& input, const RegridFileOptions& options = {}) {
    return thrown_message<FileError>([&] {
      return regrid_file({input, {}}, {"grid:60", {}}, {out, {}}, options);
    });
  };
  EXPECT_EQ(why_input(table),
            table +
                ": a table or array does not say which grid its values are on: --source names "
                "it; rondel interpolate carries values at points");
  EXPECT_EQ(why_input(table, {.source = FileName{"grid:60", {}}}),
            table + ": no column of the table is named (--value)");
  const std::string grib = temporary_path("in.grib");
  std::ofstream(grib) << "GRIB";
  for (const std::optional<FileName>& source :
       {std::optional<FileName>(), std::optional(FileName{"grid:60", {}})}) {
    EXPECT_EQ(why_input(grib, {.source = source}),
              grib +
                  ": it is no netCDF, from which fields are read; GRIB has to be converted to "
                  "it, and rondel.regrid in Python takes Zarr that xarray opens");
  }
  EXPECT_EQ(why(table),
            table +
                ": points have no cells, which conservative methods, largest_share and statistics "
                "need; nearest, linear, laplace, sibson, hermite, cubic, bilinear and native are "
                "the methods for points");
  EXPECT_EQ(why(grib),
            grib +
                ": it is neither the name of a grid, nor netCDF with cells, nor polygons "
                "(.geojson, and by GDAL .gpkg .fgb .shp .parquet)");
  EXPECT_EQ(
      why("grid:60", {.source = FileName{"healpix:1", {}}}),
      in + ": no variable has 48 points; left out, as they have no values at the points: warm, "
           "kind, patchy");
  EXPECT_EQ(
      why("grid:60", {.source = FileName{"C3", {}}, .method = FieldMethod::bilinear}).substr(0, 4),
      in.substr(0, 4));
  EXPECT_FALSE(std::filesystem::exists(out));
}

// Writes the fields at places in a list, which the file says are those of O2.
void write_list(const std::string& path, const std::vector<LonLat>& places) {
  FieldSet fields = made_fields(places);
  fields.attributes.emplace_back(grid_attribute, "O2");
  WeightSide side;
  side.points = places;
  write_fields({path, {}}, fields, side);
}

TEST(regrid_files, say_which_place_is_not_that_of_the_grid) {
  const std::string in = temporary_path("moved.nc");
  const std::string out = temporary_path("moved-out.nc");
  std::vector<LonLat> places = NamedGrid("O2").centers();
  const auto why = [&](const RegridFileOptions& options) {
    return thrown_message<FileError>([&] {
      return regrid_file({in, {}}, {"grid:60", {}}, {out, {}}, options);
    });
  };
  write_list(in, places);
  EXPECT_EQ(regrid_file({in, {}}, {"grid:60", {}}, {out, {}}).fields, 4U);
  places[3].lat_deg = 12.5;
  write_list(in, places);
  const std::string wanted = why({.source = FileName{"O2", {}}});
  EXPECT_NE(wanted.find(": no variable is at the 88 wanted places; "), std::string::npos) << wanted;
  EXPECT_NE(wanted.find("; place 3 is at 54 12.5, not at 54 59.44"), std::string::npos) << wanted;
  const std::string named = why({.names = {"patchy"}, .source = FileName{"O2", {}}});
  EXPECT_NE(named.find("variable \"patchy\" is at lon and lat, which are not the places that are "
                       "wanted: place 3 is at 54 12.5"),
            std::string::npos)
      << named;
  const std::string own = why({});
  EXPECT_NE(own.find("; its attributes name the grid O2, but not all of its longitudes and "
                     "latitudes are places of that grid, each once"),
            std::string::npos)
      << own;
  EXPECT_EQ(thrown_message<FileError>([&] { (void)CellSet::read({in, {}}); }), own);
}

// A table of regions is read again, whatever their columns are called.
TEST(regrid_files, tables_have_one_column_for_each_coordinate) {
  const std::string in = temporary_path("fields-of-table.nc");
  write_input(in, "grid:30");
  const std::string polygons = temporary_path("columns.geojson");
  std::ofstream(polygons)
      << R"({"type":"Feature","properties":{"LON":1,"Latitude":2,"x":3,"Y":4,"z":5,"lng_":6},)"
      << R"("geometry":{"type":"Polygon","coordinates":[[[0,0],[40,0],[40,40],[0,0]]]}})";
  const std::string table = temporary_path("columns.csv");
  (void)regrid_file({in, {}}, {polygons, {}}, {table, {}}, {.names = {"patchy"}});
  const std::string text = file_bytes(table);
  EXPECT_EQ(text.substr(0, text.find('\n')), "lon,lat,LON_,Latitude_,x_,Y_,z_,lng_,patchy");
  EXPECT_EQ(read_sites({table, {}}).sites.size(), 1U);
}

}  // namespace
}  // namespace rondel::test
