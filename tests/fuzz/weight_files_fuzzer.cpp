// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// netCDF's classic formats, as files of weights, of fields and of cells: any bytes give what they hold, or a
// FileError of one line.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "fuzz/fuzz_input.h"
#include "fuzz/scratch_folder.h"
#include "fuzz/table_input.h"
#include "rondel/conventions.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/fields.h"
#include "rondel/io.h"
#include "rondel/native_weights.h"
#include "rondel/read_cells.h"
#include "rondel/remap.h"
#include "rondel/weight_check.h"
#include "rondel/weight_comparison.h"
#include "rondel/weight_files.h"
#include "rondel/zonal_statistics.h"

namespace rondel::fuzz {
namespace {

template <typename Read>
void expect_answer(Read read) {
  try {
    read();
  } catch (const FileError& error) {
    const std::string what = error.what();
    require(what.find('\n') == std::string::npos, "a message is one line: " + what);
    require(!error.code(), "the system had nothing against it: " + what);
  }
}

// Three numbers of the input as a point.
void test_lonlats(std::string_view bytes) {
  std::array<double, 3> xyz{};
  std::memcpy(xyz.data(), bytes.data(), std::min(bytes.size(), sizeof xyz));
  const auto [x, y, z] = xyz;
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) return;
  const LonLat place = lonlats(std::vector<Point>{{x, y, z}}).front();
  if (x == 0 && y == 0 && z == 0) {
    require(std::isnan(place.lon_deg) && std::isnan(place.lat_deg), "the center has no place");
    return;
  }
  require(std::abs(place.lon_deg) <= 180 && std::abs(place.lat_deg) <= 90, "a place on the map");
}

// The input as corners of cells, and as axes of a grid.
void test_corners(std::string_view bytes) {
  constexpr std::size_t most = 64;
  std::vector<double> numbers(std::min(bytes.size() / sizeof(double), most) / 2 * 2);
  if (numbers.empty()) return;
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(double));
  std::vector<LonLat> corners;
  for (std::size_t i = 0; i < numbers.size(); i += 2)
    corners.push_back({numbers[i], numbers[i + 1]});
  const std::size_t corners_per_cell = 1 + static_cast<unsigned char>(bytes.front()) % 6;
  try {
    const CellRings cells = cells_of_corners(corners, corners_per_cell);
    require(cells.num_cells() == corners.size() / corners_per_cell, "corners make their cells");
    const std::vector<LonLat> centers(
        corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(cells.num_cells()));
    const CentersOutside outside = centers_outside(cells, centers);
    require(outside.number <= outside.of && outside.of <= cells.num_cells(), "centers are counted");
    require(outside.number > 0 || !outside.are_most(), "no most of none");
    require(CellSet::polygons(cells).num_cells() == cells.num_cells(), "which can be prepared");
  } catch (const InvalidInput&) {
  }
  try {
    const std::size_t rows = corners.size() / corners_per_cell;
    const std::size_t num_cells = rows == 0 ? 0 : (rows - 1) * (corners_per_cell - 1);
    const std::vector<LonLat> centers(num_cells, corners.front());
    require(corners_of_grid(corners, {rows, corners_per_cell}, centers,
                            {corners_per_cell - 1, rows - 1})
                    .size() == 4 * num_cells,
            "four corners for each cell");
  } catch (const InvalidInput&) {
  }
  try {
    const std::span<const double> axes = numbers;
    const LonLatGrid grid =
        grid_around(axes.first(numbers.size() / 2), axes.last(numbers.size() / 2));
    require(grid.lon_deg.size() == numbers.size() / 2 + 1, "lines on both sides of each");
    static_cast<void>(CellSet::lonlat_grid(grid));
  } catch (const InvalidInput&) {
  }
}

void test_faults(const WeightFile& file) {
  const WeightReport report = check_weights(file);
  const Weights& weights = file.weights;
  require(report.empty_rows <= weights.num_rows(), "rows are counted once");
  require(report.count("repeated") <= weights.values.size(), "entries are counted once");
  require(report.count("row sum") + report.empty_rows <= weights.num_rows(), "a row has one sum");
  require(report.count("conservation") <= weights.num_columns, "a source is counted once");
  for (const WeightFault& fault : report.faults) {
    require(fault.count > 0 && fault.what.find('\n') == std::string::npos, "a fault is one line");
  }
}

// Values that are read and written in slices are the same as those that are read and written at once.
void test_slices(const ScratchFolder& folder, const std::string& path, const FieldSet& whole) {
  const FieldFile file(path, {}, 4);
  file.keep_chunks(std::size_t{1} << 16U);
  const FieldSet& fields = file.fields();
  require(fields.arrays.size() == whole.arrays.size(), "the same fields");
  const std::string at_once = folder.file("at_once.nc");
  const std::string in_slices = folder.file("in_slices.nc");
  write_fields(at_once, whole, {});
  FieldWriter writer(in_slices, fields, {});
  for (std::size_t k = 0; k < whole.arrays.size(); ++k) {
    const std::vector<double>& values = whole.arrays[k].values;
    std::vector<double> slice(4);
    for (std::size_t first = 0; first < whole.arrays[k].num_fields(); ++first) {
      file.read(k, first, slice);
      for (std::size_t i = 0; i < 4; ++i) {
        const double expected = values[4 * first + i];
        require(slice[i] == expected || (std::isnan(slice[i]) && std::isnan(expected)),
                "a slice has the values of the whole");
      }
      writer.write(slice);
    }
  }
  for (const std::string& remark : writer.remarks()) {
    require(remark.find('\n') == std::string::npos, "a remark is one line");
  }
  require(!fields.arrays.empty() || file.bytes_beside() == 0, "nothing is read of no fields");
  writer.finish();
  require(content(in_slices) == content(at_once), "slices are written as the whole is");
}

// The cells of a file have what the file says of them.
void test_cells(const CellSet& cells, const CellTable& table) {
  const std::size_t size = table.num_cells();
  require(cells.num_cells() == size, "cells are kept");
  require(cells.centers().size() == size, "a cell has a center");
  require((cells.lines() != nullptr) == table.grid.has_value(), "a grid has lines");
  WeightSide side = weight_side(cells.with_facts(cells.facts()));
  require(side.points == cells.places() && side.points.size() == size, "a cell has a place");
  const std::size_t num_corners = cells.corners().size();
  require(cells.bounds().size() == num_corners, "each corner is one of the bounds");
  require(side.corners.size() == num_corners && (num_corners == 0 || num_corners % size == 0),
          "a cell has as many corners as others");
  use_corners_as_bounds(side);
  require(side.corners.size() == num_corners && (num_corners > 0 || !side.has_bounds),
          "bounds are made of corners");
}

// Right weights are found right; of changed ones as many are wrong as were changed.
void test_comparison(const CellSet& cells, const Remap& same, std::string_view bytes) {
  WeightFile file = weight_file(same);
  const WeightComparison right = compare_weights(file, cells, cells);
  require(right.faults.empty() && right.max_error < 1e-9, "weights of cells are right");
  require(right.norm == WeightNorm::either, "each target is covered");
  const auto at = static_cast<unsigned char>(bytes[0]) % file.weights.values.size();
  file.weights.values[at] = bytes.size() > 2 ? static_cast<double>(bytes[2]) / 64 : 0.5;
  if (std::abs(file.weights.values[at] - 1) < 0.01) return;
  const WeightComparison wrong = compare_weights(file, cells, cells);
  require(wrong.count("wrong weight") + wrong.count("missing piece") == 1, "one weight is wrong");
  require(ErrorDistribution::end_of(0) == 1e-16, "the first decade");
}

// Each zone is one cell, of which all statistics are its value.
void test_zones(const Remap& same, std::string_view bytes) {
  const auto statistics =
      zonal_statistics_of("mean,min,max,median,quantile:0.25,majority,minority");
  require(statistics[4].name() == "quantile_0.25", "a quantile has a name");
  std::vector<double> values(same.source_areas.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = bytes[i % bytes.size()];
  std::vector<double> numbers(statistics.size() * values.size());
  zonal_statistics(same, statistics, values, numbers);
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    require(std::abs(numbers[n] - values[n % values.size()]) < 1e-12, "the value of its cell");
  }
  try {
    static_cast<void>(zonal_statistics_of(bytes));
  } catch (const InvalidInput&) {
  }
}

// The centers of a grid of the sphere are between its lines.
void test_global_grid(std::string_view bytes) {
  if (bytes.size() < 2) return;
  const GlobalGrid grid{1U + static_cast<unsigned char>(bytes[0]) % 64,
                        1U + static_cast<unsigned char>(bytes[1]) % 32};
  const CellSet cells = CellSet::lonlat_grid(grid);
  const LonLatAxes axes = grid.centers();
  require(cells.places() == axes.places(), "places are the centers");
  for (std::size_t i = 0; i < cells.num_cells(); ++i) {
    require(axes.place(i) == cells.places()[i], "a place is the same alone");
  }
  require(cells.lines()->lon_deg == grid.lines().lon_deg, "lines are kept");
  const std::vector<double> exact = grid.areas();
  for (std::size_t i = 0; i < exact.size(); ++i) {
    require(std::abs(cells.areas()[i] - exact[i]) <= 1e-14 * exact[i], "areas are those of lines");
  }
  const Remap same = remap(cells, cells);
  require(weight_file(same).target.areas == same.target_areas, "a file has the areas");
  require(told_areas(cells, same.target_areas) == same.target_areas, "areas stay as they are");
  test_comparison(cells, same, bytes);
  test_zones(same, bytes);
}

void test_weights(std::string_view bytes) {
  test_global_grid(bytes);
  test_lonlats(bytes);
  test_corners(bytes);
  static const ScratchFolder folder;
  const std::string path = folder.file("fuzzed.nc");
  std::ofstream(path, std::ios::binary) << bytes;
  set_netcdf_library("none");
  require(is_netcdf_file(path), "the ending tells netCDF");
  require(file_and_variable(path + ":a:b").second == "a:b", "a name may have colons");
  expect_answer([&] {
    const NetcdfSites sites = read_netcdf_sites(path, {}, true);
    require(sites.unmasked().size() == sites.table.sites.size(), "each site takes part or not");
    require(sites.table.positions.size() == sites.table.sites.size(), "sites have positions");
  });
  expect_answer([&] {
    const WeightFile file = read_weights(path);
    const std::vector<double> in(file.weights.num_columns < 1000 ? file.weights.num_columns : 0);
    std::vector<double> out(file.weights.num_rows());
    const bool are_finite =
        std::ranges::all_of(file.weights.values, [](double value) { return std::isfinite(value); });
    try {
      if (in.size() == file.weights.num_columns) {
        apply(file.weights, in, out);
        require(are_finite, "weights that are no numbers are refused");
      }
    } catch (const InvalidInput&) {
      require(!are_finite, "weights of a file are applied");
    }
    if (file.weights.num_columns < 100'000) test_faults(file);
    if (!are_finite) return;
    const std::string again = folder.file("again.nc");
    if (file.weights.num_columns == 0 || file.weights.num_rows() == 0) return;
    write_weights(again, file);
    require(read_weights(again).weights.columns == file.weights.columns, "weights come back");
  });
  expect_answer([&] {
    const CellTable table = read_cells(path);
    const std::vector<std::int32_t>& mask = table.facts.mask;
    require(mask.empty() || mask.size() == table.num_cells(), "a mask has all cells");
    require(can_read_cells(path), "a file of cells has an ending of cells");
    require_grid_or_file(path);
    test_cells(CellSet::of(table), table);
    const CellSet cells = CellSet::read(path);
    test_cells(cells, table);
    require(!can_read_polygons(path), "netCDF has no polygons of features");
    FieldSet fields;
    WeightSide side;
    side.points = cells.places();
    describe_cells(path, fields, side);
    require(!side.has_bounds || side.corners.size() % side.points.size() == 0,
            "each place has as many bounds");
  });
  expect_answer([&] {
    const CellTable table = read_cells(path, MissingCorners::made);
    require(table.facts.remarks.empty() ? !table.facts.are_corners_made : true,
            "corners that were made are told");
    test_cells(CellSet::of(table), table);
  });
  expect_answer([&] {
    const std::vector<LonLat> places = read_netcdf_sites(path, {}, false).table.positions;
    const NativeCells native = read_native_cells(path, places);
    require(native.cells.points.size() == places.size(), "a corner for each place");
  });
  expect_answer([&] {
    const FieldSet fields = read_fields(path, {}, 4);
    require(can_write_fields(path), "fields are written as netCDF");
    for (const FieldArray& array : fields.arrays) {
      require(array.values.size() == 4 * array.num_fields(), "a field has a value a point");
      require(names_of_fields(array, fields.axes).size() == array.num_fields(), "and a name");
      FieldArray without = array;
      remove_flags(without);
      require(std::ranges::none_of(without.numbers, is_attribute_of_flags, &NumericAttribute::name),
              "no flag is left");
      require(array.lengths_in_words().empty() == array.dimensions.empty(), "and lengths");
    }
    if (fields.arrays.size() == 1) write_fields(folder.file("again.npy"), fields, {});
    if (!fields.arrays.empty()) test_slices(folder, path, fields);
    for (const FieldArray& array : fields.arrays) {
      expect_answer([&] {
        const NetcdfSites sites = read_sites_on_mesh(path, path, {&array.name, 1}, true);
        require(sites.table.columns.size() <= 1, "one field is one column");
        require(sites.table.positions.size() == sites.table.sites.size(), "sites have positions");
        require(sites.unmasked().size() == sites.table.sites.size(), "each takes part or not");
      });
    }
  });
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  rondel::fuzz::test_weights({reinterpret_cast<const char*>(data), size});
  return 0;
}
