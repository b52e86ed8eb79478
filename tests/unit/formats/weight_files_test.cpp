// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Files of weights: what is written is read back, in all formats, and what is wrong is named.
#include "rondel/weight_files.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "io/binary.h"
#include "io/file_bytes.h"
#include "io/netcdf_reader.h"
#include "io/netcdf_writer.h"
#include "rondel/delaunay.h"
#include "rondel/fields.h"
#include "rondel/weight_check.h"
#include "unit/io/support.h"
#include "unit/meshing/writer.h"

namespace rondel::test {
namespace {

WeightFile example() {
  WeightFile content;
  content.weights.offsets = {0, 2, 2, 3, 6};
  content.weights.columns = {2, 0, 1, 1, 2, 0};
  content.weights.values = {0.25, 0.75, 1, 0.5, 0.25, 0.25};
  content.weights.num_columns = 3;
  content.weights.sites_hash = 0x0123456789abcdefU;
  content.weights.targets_hash = 7;
  content.source.points = {{0, 0}, {90, 0}, {0, 89.5}};
  content.source.areas = {1, 2, 3};
  content.target.points = {{-135, -45}, {45, -45}, {-135, 45}, {45, 45}};
  content.target.shape = {2, 2};
  content.target.mask = {1, 0, 1, 1};
  content.target.corners = {{-180, -90}, {0, -90}, {-90, 0}, {0, -90}, {180, -90}, {90, 0},
                            {-180, 90},  {-90, 0}, {0, 90},  {0, 90},  {90, 0},    {180, 90}};
  content.method = "sibson";
  content.normalization = "none";
  return content;
}

Column column(std::string name, const std::vector<std::string>& cells, bool is_numeric) {
  Column made;
  made.name = std::move(name);
  made.is_numeric = is_numeric;
  for (const std::string& cell : cells) {
    made.text += cell;
    made.ends.push_back(made.text.size());
  }
  return made;
}

TEST(weight_files, keep_the_texts_of_cells) {
  const TemporaryDirectory directory;
  for (const char* format : {"esmf", "scrip"}) {
    WeightFile content = example();
    content.source.columns = {column("only", {"", "a", ""}, false)};
    content.target.columns = {
        column("name, \"it\"", {"\u00c9ire", "a,b", "\"q\"", "two\nlines"}, false),
        column("pop", {"1", "", "-2.5e3", "0"}, true)};
    const FileName file(directory.file("w.nc"), format);
    write_weights(file, content);
    const WeightFile read = read_weights(file.path);
    const auto expect_equal = [](const std::vector<Column>& found,
                                 const std::vector<Column>& wanted) {
      ASSERT_EQ(found.size(), wanted.size());
      for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].name, wanted[i].name);
        EXPECT_EQ(found[i].text, wanted[i].text);
        EXPECT_EQ(found[i].ends, wanted[i].ends);
        EXPECT_EQ(found[i].is_numeric, wanted[i].is_numeric);
      }
    };
    expect_equal(read.source.columns, content.source.columns);
    expect_equal(read.target.columns, content.target.columns);
  }
  WeightFile content = example();
  content.target.columns = {column("short", {"a"}, false)};
  EXPECT_THROW(write_weights(FileName(directory.file("w.nc"), "esmf"), content), InvalidInput);
}

TEST(weight_files, come_back_from_both_kinds_of_netcdf) {
  const TemporaryDirectory directory;
  for (const char* format : {"esmf", "scrip"}) {
    const FileName file(directory.file("w.nc"), format);
    const WeightFile content = example();
    write_weights(file, content);
    const WeightFile read = read_weights(file.path);
    EXPECT_EQ(read.weights, content.weights) << format;
    EXPECT_EQ(read.source.points, content.source.points);
    EXPECT_EQ(read.source.areas, content.source.areas);
    EXPECT_TRUE(read.source.fractions.empty());
    EXPECT_TRUE(read.target.areas.empty());
    EXPECT_EQ(read.target.fractions, (std::vector<double>{1, 0, 1, 1}));
    EXPECT_EQ(read.target.points, content.target.points);
    EXPECT_EQ(read.target.corners, content.target.corners);
    EXPECT_TRUE(read.source.corners.empty());
    EXPECT_EQ(read.target.shape, content.target.shape);
    EXPECT_TRUE(read.source.shape.empty());
    EXPECT_EQ(read.target.mask, content.target.mask);
    EXPECT_EQ(read.method, "sibson");
    EXPECT_EQ(read.normalization, "none");
  }
}

TEST(weight_files, tell_of_corners_that_were_made) {
  const TemporaryDirectory directory;
  for (const char* const format : {"esmf", "scrip"}) {
    WeightFile content = example();
    const FileName file(directory.file("made.nc"), format);
    write_weights(file, content);
    EXPECT_FALSE(read_weights(file.path).source.are_corners_made);
    content.source.are_corners_made = true;
    write_weights(file, content);
    EXPECT_TRUE(read_weights(file.path).source.are_corners_made);
    EXPECT_FALSE(read_weights(file.path).target.are_corners_made);
  }
}

TEST(weight_files, keep_fractions_and_methods_in_npz) {
  const TemporaryDirectory directory;
  WeightFile content;
  content.weights.offsets = {0, 1, 3};
  content.weights.columns = {0, 0, 1};
  content.weights.values = {0.25, 0.5, 0.5};
  content.weights.num_columns = 2;
  content.target.fractions = {0.25, 1};
  content.method = "Conservative remapping";
  content.normalization = "destarea";
  write_weights(directory.file("w.npz"), content);
  WeightFile read = read_weights(directory.file("w.npz"));
  EXPECT_EQ(read.target.fractions, content.target.fractions);
  EXPECT_EQ(read.method, content.method);
  EXPECT_EQ(read.normalization, content.normalization);
  EXPECT_TRUE(check_weights(read).faults.empty());
  read.weights.values[0] = 0.3;
  EXPECT_EQ(check_weights(read).count("row sum"), 1U);
}

TEST(weight_files, come_back_from_npz_without_hashes) {
  const TemporaryDirectory directory;
  WeightFile content = example();
  write_weights(directory.file("w.npz"), content);
  content.weights.sites_hash = content.weights.targets_hash = 0;
  EXPECT_EQ(read_weights(directory.file("w.npz")).weights, content.weights);
}

// What NCO takes of a file with points that are no cells.
TEST(weight_files, of_esmf_have_points_as_cells_of_one_corner) {
  const TemporaryDirectory directory;
  WeightFile content = example();
  content.source.areas.clear();
  write_weights(directory.file("w.nc"), content);
  const std::string bytes = read_all(directory.file("w.nc"));
  const io::NetcdfReader file(bytes);
  EXPECT_EQ(file.require("xv_a").shape, (std::vector<std::uint64_t>{3, 1}));
  EXPECT_EQ(file.numbers(file.require("xv_a")), (std::vector<double>{0, 90, 0}));
  EXPECT_EQ(file.numbers(file.require("yv_a")), (std::vector<double>{0, 0, 89.5}));
  EXPECT_EQ(file.require("xv_b").shape, (std::vector<std::uint64_t>{4, 3}));
  EXPECT_TRUE(read_weights(directory.file("w.nc")).source.corners.empty());
  content.target.corners.pop_back();
  EXPECT_THROW(write_weights(directory.file("w.nc"), content), InvalidInput);
  WeightFile none;
  none.target.corners = {{0, 0}};
  EXPECT_THROW(write_weights(directory.file("w.nc"), none), InvalidInput);
}

TEST(weight_files, have_no_place_for_cells_without_one) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (const LonLat& place : lonlats(std::vector<Point>{{std::nan(""), 0, 1}, {infinite, 0, 0}})) {
    EXPECT_TRUE(std::isnan(place.lon_deg) && std::isnan(place.lat_deg));
  }
  const std::vector<Point> points = {{0, 0, 0}, {0, 0, -2}, {3, 0, 0}};
  const std::vector<LonLat> places = lonlats(points);
  EXPECT_TRUE(std::isnan(places[0].lon_deg) && std::isnan(places[0].lat_deg));
  EXPECT_EQ(places[1], (LonLat{0, -90}));
  EXPECT_EQ(places[2], (LonLat{0, 0}));
  const TemporaryDirectory directory;
  WeightSide side;
  side.points = places;
  FieldSet fields;
  fields.num_points = 3;
  FieldArray array;
  array.name = "v";
  array.values = {std::numeric_limits<double>::quiet_NaN(), 2, 3};
  fields.arrays.push_back(array);
  const std::string table = directory.file("a.csv");
  write_fields(table, fields, side);
  EXPECT_EQ(read_all(table), "lon,lat,v\n,,\n0,-90,2\n0,0,3\n");
  const std::string file = directory.file("a.nc");
  write_fields(file, fields, side);
  const FieldSet read = read_fields(file, {}, 0);
  EXPECT_EQ(read.num_without_place, 1U);
}

TEST(weight_files, may_have_no_entries) {
  const TemporaryDirectory directory;
  WeightFile content;
  content.weights.offsets = {0, 0, 0};
  content.weights.num_columns = 2;
  for (const char* name : {"w.nc", "w.npz"}) {
    write_weights(directory.file(name), content);
    EXPECT_EQ(read_weights(directory.file(name)).weights, content.weights) << name;
  }
}

// The netCDF file of the example, with a change of the bytes of one variable.
TEST(weight_files, tell_what_is_wrong) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("w.nc");
  write_weights(path, example());
  const std::string bytes = read_all(path);
  const auto message = [&](const std::string& changed) {
    return message_of([&] { read_weights(directory.with("bad.nc", changed)); });
  };
  // Whether netCDF-C is there or not.
  EXPECT_TRUE(message("\x89HDF\r\n\x1a\n").starts_with(directory.file("bad.nc") + ": n"));
  EXPECT_EQ(message("CDX"), directory.file("bad.nc") + ": not a netCDF file");
  EXPECT_EQ(message(bytes.substr(0, 100)), directory.file("bad.nc") + ": the header is cut off");
  EXPECT_EQ(message(bytes.substr(0, bytes.size() - 1)),
            directory.file("bad.nc") + ": variable \"S\" ends at byte " +
                std::to_string(bytes.size()) + ", the file at " + std::to_string(bytes.size() - 1));
  // Rows are the numbers before S, which has six doubles at the end of the file.
  std::string wrong = bytes;
  io::store(std::int32_t{9}, wrong.data() + wrong.size() - 48 - 4, std::endian::big);
  EXPECT_EQ(message(wrong), directory.file("bad.nc") + ": entry 5: row 9 is not in 1 to 4");
}

TEST(weight_files, in_any_order_of_entries_are_rows) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("w.nc");
  write_weights(path, example());
  std::string bytes = read_all(path);
  // The rows of the entries: 1 1 3 4 4 4 becomes 4 3 4 1 1 1.
  const std::int32_t rows[] = {4, 3, 4, 1, 1, 1};
  for (std::size_t k = 0; k < 6; ++k) {
    io::store(rows[k], bytes.data() + bytes.size() - 48 - 24 + 4 * k, std::endian::big);
  }
  const Weights read = read_weights(directory.with("other.nc", bytes)).weights;
  EXPECT_EQ(read.offsets, (std::vector<std::uint64_t>{0, 3, 3, 4, 6}));
  EXPECT_EQ(read.columns, (std::vector<Index>{1, 2, 0, 0, 2, 1}));
  EXPECT_EQ(read.values, (std::vector<double>{0.5, 0.25, 0.25, 0.75, 0.25, 1}));
}

TEST(weight_files, that_are_damaged_are_refused_or_read) {
  const TemporaryDirectory directory;
  std::mt19937_64 random(5);
  std::size_t refused = 0;
  for (const char* format : {"esmf", "scrip", "npz"}) {
    const FileName file(directory.file("w.nc"), format);
    write_weights(file, example());
    const std::string bytes = read_all(file.path);
    for (int i = 0; i < 2000; ++i) {
      std::string changed = bytes;
      for (int k = 0; k < 3; ++k) changed[random() % changed.size()] = static_cast<char>(random());
      if (i % 4 == 0) changed.resize(random() % changed.size());
      const FileName bad(directory.with("bad.nc", changed), format);
      const std::string message = message_of([&] { read_weights(bad); });
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      if (!message.empty()) ++refused;
    }
  }
  EXPECT_GT(refused, 1500U);
}

TEST(weight_files, rows_and_columns_are_as_many_as_weights) {
  const TemporaryDirectory directory;
  const auto message_with = [&](std::uint64_t num_rows, std::uint64_t num_columns) {
    MeshWriter file;
    file.add_whole("src_grid_dims", {{"src_grid_rank", 1}}, {4});
    file.add_whole("dst_grid_dims", {{"dst_grid_rank", 1}}, {3});
    file.add("frac_a", {{"n_a", 4}}, std::vector<double>(4, 1.0));
    file.add("frac_b", {{"n_b", 3}}, std::vector<double>(3, 1.0));
    file.add("S", {{"n_s", 2}}, {0.5, 0.5});
    file.add_whole("row", {{"of_rows", num_rows}}, std::vector<double>(num_rows, 1.0));
    file.add_whole("col", {{"of_columns", num_columns}}, std::vector<double>(num_columns, 2.0));
    file.write(directory.file("w.nc"));
    return message_of([&] { (void)read_weights(directory.file("w.nc")); });
  };
  EXPECT_EQ(message_with(2, 2), "");
  EXPECT_NE(message_with(3, 2).find("3 rows and 2 columns for 2 weights"), std::string::npos);
  EXPECT_NE(message_with(2, 1).find("2 rows and 1 columns for 2 weights"), std::string::npos);
}

TEST(weight_files, have_the_format_that_is_named_or_are_refused) {
  const TemporaryDirectory directory;
  const std::vector<std::string> formats = {"esmf", "scrip", "npz"};
  for (const std::string& written : formats) {
    const std::string path = directory.file("w");
    write_weights(FileName(path, written), example());
    for (const std::string& named : formats) {
      const std::string message = message_of([&] { (void)read_weights(FileName(path, named)); });
      EXPECT_EQ(message.empty(), written == named) << written << ' ' << named << ' ' << message;
      if (written == "npz" || written == named) continue;
      EXPECT_TRUE(message.ends_with("not " + named)) << message;
    }
  }
}

TEST(weight_files, have_as_many_points_as_the_lengths_of_their_grids_say) {
  const TemporaryDirectory directory;
  const auto message_with = [&](const std::vector<double>& lengths) {
    MeshWriter file;
    file.add_whole("src_grid_dims", {{"src_grid_rank", lengths.size()}}, lengths);
    file.add("frac_a", {{"n_a", 6}}, std::vector<double>(6, 1.0));
    file.add("frac_b", {{"n_b", 3}}, std::vector<double>(3, 1.0));
    file.add("S", {{"n_s", 2}}, {0.5, 0.5});
    file.add_whole("row", {{"n_s", 2}}, {1, 3});
    file.add_whole("col", {{"n_s", 2}}, {1, 6});
    file.write(directory.file("w.nc"));
    return message_of([&] { (void)read_weights(directory.file("w.nc")); });
  };
  for (const std::vector<double>& lengths : {std::vector<double>{6}, {3, 2}, {0}, {1}}) {
    EXPECT_EQ(message_with(lengths), "");
  }
  EXPECT_TRUE(message_with({4, 2}).ends_with(
      "variable \"src_grid_dims\" is 4 x 2, which does not multiply to 6"));
  EXPECT_TRUE(
      message_with({5}).ends_with("variable \"src_grid_dims\" is 5, which does not multiply to 6"));
}

TEST(weight_files, of_scrip_with_gradients_are_refused) {
  const TemporaryDirectory directory;
  const auto message_with = [&](std::uint64_t num_weights) {
    MeshWriter file;
    file.add_whole("src_grid_dims", {{"src_grid_rank", 1}}, {4});
    file.add_whole("dst_grid_dims", {{"dst_grid_rank", 1}}, {3});
    file.add("src_grid_frac", {{"src_grid_size", 4}}, std::vector<double>(4, 1.0));
    file.add("dst_grid_frac", {{"dst_grid_size", 3}}, std::vector<double>(3, 1.0));
    file.add_whole("src_address", {{"num_links", 2}}, {1, 4});
    file.add_whole("dst_address", {{"num_links", 2}}, {1, 3});
    file.add("remap_matrix", {{"num_links", 2}, {"num_wgts", num_weights}},
             std::vector<double>(2 * num_weights, 0.5));
    file.write(directory.file("w.nc"));
    return message_of([&] { (void)read_weights(FileName(directory.file("w.nc"), "scrip")); });
  };
  EXPECT_EQ(message_with(1), "");
  EXPECT_NE(message_with(3).find("remap_matrix has 3 weights a link"), std::string::npos)
      << message_with(3);
}

// Links as YAC writes them, of two sources and three targets.
std::string file_of_yac(const TemporaryDirectory& directory, double fields) {
  MeshWriter file;
  file.add_attribute("version", "yac weight file 1.0");
  file.add_whole("src_address", {{"num_links", 3}}, {1, 2, 2});
  file.add_whole("dst_address", {{"num_links", 3}}, {1, 1, 3});
  file.add("remap_matrix", {{"num_links", 3}, {"num_wgts", 1}}, {0.25, 0.75, 1});
  std::vector<double> links(static_cast<std::size_t>(fields), 0.0);
  links[0] = 3;
  file.add_whole("num_links_per_src_field", {{"num_src_fields", links.size()}}, links);
  file.write(directory.file("yac.nc"));
  return directory.file("yac.nc");
}

TEST(weight_files, of_yac_need_the_numbers_of_places) {
  const TemporaryDirectory directory;
  const std::string path = file_of_yac(directory, 1);
  EXPECT_EQ(message_of([&] { (void)read_weights(path); }),
            path +
                ": a file of weights of YAC does not say how many sources and targets there "
                "are: the grids are needed as well");
  const WeightFile read = read_weights(path, {.num_sources = 2, .num_targets = 4});
  EXPECT_EQ(read.weights.offsets, (std::vector<std::uint64_t>{0, 2, 2, 3, 3}));
  EXPECT_EQ(read.weights.columns, (std::vector<Index>{0, 1, 1}));
  EXPECT_EQ(read.weights.values, (std::vector<double>{0.25, 0.75, 1}));
  EXPECT_EQ(read.weights.num_columns, 2U);
  EXPECT_EQ(message_of([&] { (void)read_weights(path, {.num_sources = 2, .num_targets = 2}); }),
            path + ": entry 2: row 3 is not in 1 to 2");
  EXPECT_EQ(message_of([&] { (void)read_weights(FileName(path, "esmf")); }),
            path + ": the weights are those of YAC, not esmf");
  EXPECT_EQ(message_of([&] {
              (void)read_weights(file_of_yac(directory, 2), {.num_sources = 2, .num_targets = 4});
            }),
            path + ": the links are of 2 fields of sources where those of one are needed");
}

TEST(weight_files, may_count_from_zero_where_that_is_accepted) {
  const TemporaryDirectory directory;
  const auto written = [&](const std::vector<double>& rows, const std::vector<double>& columns) {
    MeshWriter file;
    file.add("frac_a", {{"n_a", 4}}, std::vector<double>(4, 1.0));
    file.add("frac_b", {{"n_b", 3}}, std::vector<double>(3, 1.0));
    file.add("S", {{"n_s", 2}}, {0.5, 0.5});
    file.add_whole("row", {{"n_s", 2}}, rows);
    file.add_whole("col", {{"n_s", 2}}, columns);
    file.write(directory.file("w.nc"));
    return directory.file("w.nc");
  };
  EXPECT_EQ(message_of([&] {
              (void)read_weights(written({0, 2}, {1, 4}));
            }),
            directory.file("w.nc") + ": entry 0: row 0 is not in 1 to 3");
  const WeightReadOptions lenient{.are_checked = true};
  const WeightFile read = read_weights(written({0, 2}, {1, 4}), lenient);
  EXPECT_EQ(read.weights.offsets, (std::vector<std::uint64_t>{0, 1, 1, 2}));
  EXPECT_EQ(read.weights.columns, (std::vector<Index>{0, 3}));
  EXPECT_TRUE(read.target.counts_from_zero);
  EXPECT_FALSE(read.source.counts_from_zero);
  EXPECT_EQ(check_weights(read).count("numbering"), 1U);
  EXPECT_TRUE(read_weights(written({1, 2}, {0, 3}), lenient).source.counts_from_zero);
  EXPECT_FALSE(read_weights(written({1, 2}, {1, 3}), lenient).source.counts_from_zero);
  // Numbers from 0 to the number of points are of neither kind.
  EXPECT_EQ(message_of([&] {
              (void)read_weights(written({0, 3}, {1, 4}), lenient);
            }),
            directory.file("w.nc") + ": entry 0: row 0 is not in 1 to 3");
}

TEST(weight_files, of_three_weights_a_link_are_checked_by_the_first) {
  const TemporaryDirectory directory;
  MeshWriter file;
  file.add("src_grid_frac", {{"src_grid_size", 2}}, {1, 1});
  file.add("dst_grid_frac", {{"dst_grid_size", 2}}, {1, 1});
  file.add_whole("src_address", {{"num_links", 2}}, {1, 2});
  file.add_whole("dst_address", {{"num_links", 2}}, {2, 1});
  file.add("remap_matrix", {{"num_links", 2}, {"num_wgts", 3}}, {0.5, 7, 8, 0.25, 9, 10});
  file.write(directory.file("w.nc"));
  EXPECT_EQ(message_of([&] { (void)read_weights(directory.file("w.nc")); }),
            directory.file("w.nc") +
                ": remap_matrix has 3 weights a link, of which all but the first need gradients");
  const WeightFile read = read_weights(directory.file("w.nc"), {.are_checked = true});
  EXPECT_EQ(read.weights.values, (std::vector<double>{0.25, 0.5}));
  EXPECT_EQ(read.weights.columns, (std::vector<Index>{1, 0}));
  EXPECT_EQ(read.remarks.front(),
            "remap_matrix has 3 weights a link: all but the first, which multiply gradients, are "
            "left out");
}

// Conservative weights as SCRIP has them, whose values are areas of pieces.
struct ScripAreas {
  std::string normalization = "none";
  std::string method = "Conservative remapping";
  std::vector<double> areas = {0.5, 0.25, 0.125};  // none: no variable
};

WeightFile read_areas(const TemporaryDirectory& directory, const ScripAreas& wanted) {
  MeshWriter file;
  if (!wanted.normalization.empty()) file.add_attribute("normalization", wanted.normalization);
  file.add_attribute("map_method", wanted.method);
  file.add("src_grid_area", {{"src_grid_size", 2}}, {0.375, 0.25});
  file.add("dst_grid_frac", {{"dst_grid_size", 3}}, {0, 0, 0});
  if (!wanted.areas.empty()) file.add("dst_grid_area", {{"dst_grid_size", 3}}, wanted.areas);
  file.add_whole("src_address", {{"num_links", 3}}, {1, 2, 2});
  file.add_whole("dst_address", {{"num_links", 3}}, {1, 1, 2});
  file.add("remap_matrix", {{"num_links", 3}, {"num_wgts", 1}}, {0.375, 0.125, 0.125});
  file.write(directory.file("w.nc"));
  return read_weights(directory.file("w.nc"));
}

TEST(weight_files, of_scrip_that_are_areas_are_divided_by_those_of_targets) {
  const TemporaryDirectory directory;
  const std::vector<double> as_written = {0.375, 0.125, 0.125};
  const WeightFile divided = read_areas(directory, {});
  EXPECT_EQ(divided.weights.values, (std::vector<double>{0.75, 0.25, 0.5}));
  EXPECT_EQ(divided.normalization, "destarea");
  ASSERT_EQ(divided.remarks.size(), 1U);
  EXPECT_NE(divided.remarks[0].find("dst_grid_area"), std::string::npos);
  EXPECT_TRUE(check_weights(divided).faults.empty());
  // Programs write the word in upper and lower case.
  for (const char* word : {"None", "NONE"}) {
    EXPECT_EQ(read_areas(directory, {.normalization = word}).weights.values,
              divided.weights.values);
  }
  // Weights of other normalizations and methods are means already and stay as they are.
  for (const ScripAreas& other :
       {ScripAreas{.normalization = "destarea"}, ScripAreas{.normalization = "fracarea"},
        ScripAreas{.method = "Bilinear remapping"}}) {
    const WeightFile read = read_areas(directory, other);
    EXPECT_EQ(read.weights.values, as_written) << other.normalization << other.method;
    EXPECT_EQ(read.normalization, other.normalization);
    EXPECT_TRUE(read.remarks.empty());
  }
  EXPECT_EQ(read_areas(directory, {.normalization = "DestArea"}).normalization, "destarea");
  // Nothing says what the weights are, or nothing that is known.
  const WeightFile unsaid = read_areas(directory, {.normalization = ""});
  EXPECT_EQ(unsaid.weights.values, as_written);
  ASSERT_EQ(unsaid.remarks.size(), 1U);
  EXPECT_NE(unsaid.remarks[0].find("no attribute normalization"), std::string::npos);
  EXPECT_NE(message_of([&] {
              (void)read_areas(directory, {.normalization = "srcarea"});
            }).find("the attribute normalization is \"srcarea\""),
            std::string::npos);
  // A target without entries needs no area.
  EXPECT_EQ(read_areas(directory, {.areas = {0.5, 0.25, 0}}).weights.values[2], 0.5);
  EXPECT_NE(message_of([&] {
              (void)read_areas(directory, {.areas = {0.5, 0, 1}});
            }).find("the area of target 1 in dst_grid_area is 0, to divide them by"),
            std::string::npos);
  for (const std::vector<double>& missing : {std::vector<double>{}, std::vector<double>(3, 0.0)}) {
    EXPECT_NE(message_of([&] {
                (void)read_areas(directory, {.areas = missing});
              }).find("there are no areas of targets, dst_grid_area, to divide them by"),
              std::string::npos);
  }
}

TEST(weight_files, of_scrip_with_a_method_of_this_library_are_means) {
  const TemporaryDirectory directory;
  WeightFile content = example();
  content.method = "conservative";
  write_weights(FileName(directory.file("w.nc"), "scrip"), content);
  const WeightFile read = read_weights(directory.file("w.nc"));
  EXPECT_EQ(read.weights.values, content.weights.values);
  EXPECT_TRUE(read.remarks.empty());
}

// Packed weights are meant unpacked, and coordinates without units are in those of the others.
TEST(weight_files, have_the_numbers_that_their_attributes_mean) {
  const TemporaryDirectory directory;
  MeshWriter file;
  file.add_whole("src_grid_dims", {{"src_grid_rank", 1}}, {2});
  file.add_whole("dst_grid_dims", {{"dst_grid_rank", 1}}, {1});
  file.add("xc_a", {{"n_a", 2}}, {0, 0.5});
  file.add("yc_a", {{"n_a", 2}}, {0, -0.25}, {{"units", "radians"}});
  file.add("xv_a", {{"n_a", 2}, {"nv_a", 3}}, {0, 0.5, 0, 0, 0.5, 0.5});
  file.add("yv_a", {{"n_a", 2}, {"nv_a", 3}}, {0, 0, 0.5, 0, 0, 0.5});
  file.add("area_a", {{"n_a", 2}}, {1, 2}, {}, {{"scale_factor", 3}});
  file.add("frac_b", {{"n_b", 1}}, {1});
  file.add_whole("S", {{"n_s", 2}}, {1, 3}, {}, {{"scale_factor", 2}});
  file.add_whole("row", {{"n_s", 2}}, {1, 1});
  file.add_whole("col", {{"n_s", 2}}, {1, 2});
  file.write(directory.file("w.nc"));
  const WeightFile read = read_weights(directory.file("w.nc"));
  EXPECT_EQ(read.weights.values, (std::vector<double>{2, 6}));
  EXPECT_EQ(read.source.areas, (std::vector<double>{3, 6}));
  constexpr double half = 0.5 * 180 / std::numbers::pi;
  ASSERT_EQ(read.source.points.size(), 2U);
  EXPECT_NEAR(read.source.points[1].lon_deg, half, 1e-13);
  EXPECT_NEAR(read.source.points[1].lat_deg, -half / 2, 1e-13);
  ASSERT_EQ(read.source.corners.size(), 6U);
  EXPECT_NEAR(read.source.corners[5].lon_deg, half, 1e-13);
  EXPECT_NEAR(read.source.corners[5].lat_deg, half, 1e-13);
}

TEST(weight_files, without_a_mask_all_take_part) {
  const TemporaryDirectory directory;
  WeightFile content = example();
  content.source.mask.clear();
  content.target.mask.clear();
  const std::string path = directory.file("w.nc");
  write_weights(path, content);
  io::FileBytes bytes(path);
  const io::NetcdfReader file(bytes);
  for (const char* name : {"mask_a", "mask_b"}) {
    for (const double part : file.numbers(file.require(name))) EXPECT_EQ(part, 1) << name;
  }
}

TEST(fields, come_back) {
  const TemporaryDirectory directory;
  FieldSet fields;
  fields.num_points = 4;
  fields.arrays = {{"t", {"time"}, {2}, {1, 2, 3, 4, 5, 6, 7, 0.1}, {{"units", "K"}}}};
  fields.axes = {{"time", {"time"}, {2}, {0, 6}, {{"units", "hours since 2000-01-01"}}}};
  const WeightSide side = example().target;
  write_fields(directory.file("f.nc"), fields, side);
  const FieldSet read = read_fields(directory.file("f.nc"), {}, 4);
  ASSERT_EQ(read.arrays.size(), 1U);
  EXPECT_EQ(read.arrays[0].values, fields.arrays[0].values);
  EXPECT_EQ(read.arrays[0].shape, fields.arrays[0].shape);
  EXPECT_EQ(read.arrays[0].attributes, fields.arrays[0].attributes);
  ASSERT_EQ(read.axes.size(), 1U);
  EXPECT_EQ(read.axes[0].values, fields.axes[0].values);
  write_fields(directory.file("f.npy"), fields, side);
  EXPECT_EQ(read_fields(directory.file("f.npy"), {}, 4).arrays[0].values, fields.arrays[0].values);
  write_fields(directory.file("f.csv"), fields, side);
  const std::vector<std::string> names = {"t_2000-01-01T06:00:00"};
  EXPECT_EQ(read_fields(directory.file("f.csv"), names, 4).arrays[0].values,
            (std::vector<double>{5, 6, 7, 0.1}));
}

TEST(fields, of_a_column_with_empty_lines_say_which) {
  const TemporaryDirectory directory;
  const std::vector<std::string> names = {"m"};
  const auto message = [&](const std::string& text) {
    const std::string file = directory.with("m.csv", text);
    return message_of([&] { (void)read_fields(file, names, 3); }).substr(file.size());
  };
  const std::string rows = ": 2 rows for 3 points";
  const std::string no_row = R"( is empty, which is no row: "" is a missing value)";
  EXPECT_EQ(message("m\n1\n\n0\n"), rows + "; line 3" + no_row);
  EXPECT_EQ(message("m\r\n\r\n1\r\n0\r\n"), rows + "; line 2" + no_row);
  EXPECT_EQ(message("m\n1\n0\n\n"), rows + "; line 4" + no_row);
  EXPECT_EQ(message("m\n1\n0\n"), rows);
  EXPECT_EQ(message("m,n\n1,\"\n\"\n0,\n"), rows);
  const FieldSet read = read_fields(directory.with("n.csv", "m\n1\n\"\"\n\n0\n"), names, 3);
  EXPECT_TRUE(std::isnan(read.arrays.at(0).values.at(1)));
  EXPECT_EQ(read.lines, (std::vector<std::uint64_t>{2, 3, 5}));
}

TEST(fields, of_an_array_that_is_cut_or_too_long_say_how_long_it_is) {
  const TemporaryDirectory directory;
  FieldSet fields;
  fields.num_points = 3;
  fields.arrays = {{"v", {}, {}, {1, 2, 3}, {}}};
  const std::string path = directory.file("v.npy");
  write_fields(path, fields, {});
  const std::string bytes = read_all(path);
  const auto message = [&](const std::string& changed) {
    const std::string file = directory.with("w.npy", changed);
    return message_of([&] { (void)read_fields(file, {}, 3); }).substr(file.size());
  };
  EXPECT_EQ(message(bytes.substr(0, bytes.size() - 5)),
            ": shape (3,): 3 numbers of 8 bytes are needed, there are 19 bytes");
  EXPECT_EQ(message(bytes + "more"),
            ": shape (3,): 3 numbers of 8 bytes are needed, there are 28 bytes");
}

// netCDF's rules for names; programs refuse a classic file with others.
TEST(fields, have_names_that_netcdf_takes) {
  const TemporaryDirectory directory;
  WeightSide side;
  side.points = {{0, 0}, {1, 1}};
  FieldSet fields;
  fields.num_points = 2;
  for (const char* name : {"a/b", "a_b", "a b", "/", "t\n", "end ", "-x", "2m", "\xC3\xA9"}) {
    FieldArray array;
    array.name = name;
    array.values = {1, 2};
    fields.arrays.push_back(array);
  }
  write_fields(directory.file("f.nc"), fields, side);
  const std::string bytes = read_all(directory.file("f.nc"));
  const io::NetcdfReader file(bytes);
  std::vector<std::string> names;
  for (const auto& variable : file.variables()) names.push_back(variable.name);
  EXPECT_EQ(names, (std::vector<std::string>{"lat", "lon", "a_b", "a_b_", "a b", "_", "t_", "end_",
                                             "column_-x", "2m", "\xC3\xA9"}));
}

TEST(fields, of_integers_of_eight_bytes) {
  const TemporaryDirectory directory;
  const std::vector<std::uint64_t> numbers = {3, 1, 1ULL << 40U, 7};
  for (const char* type : {"<u8", "<i8"}) {
    std::string bytes("\x93NUMPY\x01\x00", 8);
    std::string header =
        std::string("{'descr': '") + type + "', 'fortran_order': False, 'shape': (4,), }";
    header.resize(117, ' ');
    header += '\n';
    bytes += static_cast<char>(header.size());
    bytes += '\0';
    bytes += header;
    bytes.append(reinterpret_cast<const char*>(numbers.data()), 8 * numbers.size());
    const FieldSet fields = read_fields(directory.with("f.npy", bytes), {}, 4);
    EXPECT_EQ(fields.arrays[0].values, (std::vector<double>{3, 1, 0x1p40, 7})) << type;
  }
}

TEST(fields, without_places_say_so) {
  const TemporaryDirectory directory;
  FieldSet fields;
  fields.num_points = 4;
  fields.arrays = {{"t", {}, {}, {1, 2, 3, 4}, {}}};
  write_fields(directory.file("f.nc"), fields, WeightSide{});
  const auto message = [&](std::size_t count) {
    return message_of([&] { read_fields(directory.file("f.nc"), {}, count); });
  };
  EXPECT_NE(message(0).find("no variable has longitudes and latitudes"), std::string::npos)
      << message(0);
  EXPECT_NE(message(5).find("no variable has 5 points"), std::string::npos) << message(5);
}

TEST(fields, of_infinite_values_are_refused) {
  const TemporaryDirectory directory;
  FieldSet fields;
  fields.num_points = 4;
  fields.arrays = {
      {"t", {"time"}, {2}, {1, 2, 3, 4, 5, -std::numeric_limits<double>::infinity(), 7, 8}, {}}};
  for (const char* name : {"f.nc", "f.npy"}) {
    const std::string file = directory.file(name);
    write_fields(file, fields, example().target);
    const std::string message = message_of([&] {
      const FieldFile in(file, {}, 4);
      std::vector<double> values(4);
      for (std::size_t a = 0; a < in.fields().arrays.size(); ++a) {
        for (std::size_t f = 0; f < in.fields().arrays[a].num_fields(); ++f) in.read(a, f, values);
      }
    });
    EXPECT_TRUE(message.starts_with(file)) << message;
    EXPECT_NE(message.find("-inf"), std::string::npos) << message;
  }
}

TEST(fields, have_the_columns_of_their_points) {
  const TemporaryDirectory directory;
  FieldSet fields;
  fields.num_points = 3;
  fields.arrays = {{"tas", {}, {}, {1, 2, 3}, {}}};
  WeightSide side;
  side.points = {{0, 0}, {10, 0}, {20, 0}};
  side.columns = {column("tas", {"Fiji", "", "\u00c9ire"}, false),
                  column("a/b c", {"1.5", "", "-2e3"}, true)};
  write_fields(directory.file("f.nc"), fields, side);
  io::FileBytes bytes(directory.file("f.nc"));
  const std::string text(bytes.text());
  const io::NetcdfReader file(text);
  EXPECT_EQ(file.numbers(file.require("tas")), (std::vector<double>{1, 2, 3}));
  const std::vector<double> numbers = file.numbers(file.require("a_b_c"));
  EXPECT_EQ(numbers[0], 1.5);
  EXPECT_TRUE(std::isnan(numbers[1]));
  EXPECT_EQ(numbers[2], -2000);
  const io::VariableInFile& names = file.require("tas_");
  EXPECT_EQ(names.shape, (std::vector<std::uint64_t>{3, 5}));
  EXPECT_EQ(text.substr(names.offset, 15), std::string("Fiji\0\0\0\0\0\0\u00c9ire", 15));
  write_fields(directory.file("f.csv"), fields, side);
  io::FileBytes table(directory.file("f.csv"));
  EXPECT_EQ(std::string(table.text()),
            "lon,lat,tas_,a/b c,tas\n0,0,Fiji,1.5,1\n10,0,,,2\n20,0,\u00c9ire,-2e3,3\n");
  side.columns[0].ends.pop_back();
  EXPECT_THROW(write_fields(directory.file("f.csv"), fields, side), InvalidInput);
}

// The points of a netCDF file of one variable of the dimensions (2, 2) and coordinates.
std::vector<Point> places_of(std::initializer_list<const char*> names,
                             const std::vector<std::vector<std::size_t>>& dimensions) {
  const TemporaryDirectory directory;
  {
    io::AtomicFile file(directory.file("f.nc"));
    io::NetcdfWriter out(file);
    out.add_dimension("y", 2);
    out.add_dimension("x", 2);
    std::size_t i = 0;
    for (const char* name : names) {
      out.add_variable({name, io::NetcdfType::float32, dimensions[i++], {}});
    }
    out.add_variable({"t", io::NetcdfType::float64, {0, 1}, {}});
    out.begin();
    float first = 0;  // another one for a third variable
    for (const auto& of : dimensions) {
      if (&of - dimensions.data() == 2) first = 5;
      for (std::size_t k = 0; k < (of.size() == 2 ? 4 : 2); ++k) {
        out.write(std::span<const float>(std::array{first + 30 * static_cast<float>(k)}));
      }
    }
    out.write(std::span<const double>(std::array<double, 4>{}));
    out.finish();
    file.commit();
  }
  const std::vector<std::string> values = {"t"};
  return read_fields(directory.file("f.nc"), values, 4).points;
}

TEST(fields, of_netcdf_say_where_they_are) {
  EXPECT_EQ(places_of({"lat", "lon"}, {{0}, {1}}),
            unit_vectors(std::vector<LonLat>{{0, 0}, {30, 0}, {0, 30}, {30, 30}}));
  EXPECT_EQ(places_of({"longitude", "lat"}, {{0, 1}, {0, 1}}),
            unit_vectors(std::vector<LonLat>{{0, 0}, {30, 30}, {60, 60}, {90, 90}}));
  EXPECT_TRUE(places_of({"lat", "lon", "longitude"}, {{0}, {1}, {1}}).empty()) << "two longitudes";
  EXPECT_TRUE(places_of({"lat"}, {{0}}).empty());
}

// Rows of a grid of two dimensions need not be parallels.
TEST(fields, on_a_curved_grid_have_coordinates_of_each_point) {
  const TemporaryDirectory directory;
  FieldSet fields;
  fields.num_points = 6;
  fields.arrays = {{"t", {}, {}, {1, 2, 3, 4, 5, 6}, {}}};
  WeightSide side;
  side.points = {{0, 1}, {10, 2}, {20, 3}, {1, 11}, {11, 12}, {21, 13}};
  side.shape = {2, 3};
  write_fields(directory.file("f.nc"), fields, side);
  const std::string bytes = read_all(directory.file("f.nc"));
  const io::NetcdfReader file(bytes);
  EXPECT_EQ(file.numbers(file.require("lon")), (std::vector<double>{0, 10, 20, 1, 11, 21}));
  EXPECT_EQ(file.numbers(file.require("lat")), (std::vector<double>{1, 2, 3, 11, 12, 13}));
  EXPECT_EQ(file.numbers(file.require("t")), fields.arrays[0].values);
  EXPECT_EQ(file.require("lon").shape, (std::vector<std::uint64_t>{2, 3}));
}

// Fields, their other dimensions and axes may be called as the coordinates of the points are.
TEST(fields, that_share_a_name_with_others_get_an_underscore) {
  const TemporaryDirectory directory;
  WeightSide side;
  side.points = {{0, -45}, {180, -45}, {0, 45}, {180, 45}};
  side.shape = {2, 2};
  FieldSet fields;
  fields.num_points = 4;
  for (int k = 0; k < 2; ++k) {
    FieldArray array;
    array.name = "lat";
    array.dimensions = {"lon"};
    array.shape = {2};
    array.values = {1, 2, 3, 4, 5, 6, 7, 8};
    fields.arrays.push_back(array);
  }
  FieldArray axis;
  axis.name = "lon";
  axis.dimensions = {"lon"};
  axis.shape = {2};
  axis.values = {10, 20};
  fields.axes.push_back(axis);
  const std::string path = directory.file("same.nc");
  write_fields(path, fields, side);
  const std::string bytes = read_all(path);
  const io::NetcdfReader file(bytes);
  std::vector<std::string> names;
  for (const auto& variable : file.variables()) names.push_back(variable.name);
  EXPECT_EQ(names, (std::vector<std::string>{"lon_", "lat", "lon", "lat_", "lat__"}));
  EXPECT_EQ(file.numbers(file.require("lon_")), (std::vector<double>{10, 20}));
  EXPECT_EQ(file.numbers(file.require("lon")), (std::vector<double>{0, 180}));
  names.clear();
  for (const std::size_t d : file.require("lat__").dimensions) {
    names.push_back(file.dimensions()[d].name);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"lon_", "lat", "lon"}));
  EXPECT_EQ(file.numbers(file.require("lat_")), fields.arrays[0].values);
}

}  // namespace
}  // namespace rondel::test
