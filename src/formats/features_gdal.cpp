// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes features by GDAL: write_features_gdal() and require_region_writer(). Geometries are handed
// over as well-known binary. GDAL first writes into its memory, so that
// the file appears whole or not at all.
#include "formats/features_gdal.h"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "formats/gdal.h"
#include "io/ending.h"
#include "rondel/error.h"
#include "system/mutex.h"

namespace rondel::formats {
namespace {

// A format with the ending of its files and the name of GDAL's driver.
struct GdalFormat {
  std::string_view ending;
  const char* driver;
};
constexpr std::array<GdalFormat, 3> gdal_formats = {
    {{".gpkg", "GPKG"}, {".fgb", "FlatGeobuf"}, {".parquet", "Parquet"}}};

// Values of GDAL's enumerations.
constexpr int type_point = 1, type_line = 2, type_polygon = 3, type_collection = 7;
constexpr int type_unknown = 0;
constexpr int to_multi = 3;  // from the type of a part to that of a geometry of several ones
constexpr int field_real = 2, field_text = 4, field_integer = 12;
constexpr int traditional_axes = 0;  // longitude first

// Returns the format of a file; null if GDAL is not needed for it.
const GdalFormat* gdal_format(const FileName& file) {
  return io::find_format<GdalFormat>(gdal_formats, file);
}

// Writes well-known binary (WKB), in the byte order of this machine.
class WkbWriter {
 public:
  // Begins a geometry: the order of its bytes and its type.
  void begin(int type) {
    const unsigned char order = std::endian::native == std::endian::little ? 1 : 0;
    append(&order, 1);
    add_number(static_cast<std::uint32_t>(type));
  }
  // Appends a count, of 32 bits in WKB.
  void add_number(std::uint32_t number) { append(&number, sizeof number); }
  // Appends a longitude and a latitude in degrees.
  void add_position(const LonLat& position) {
    append(&position.lon_deg, sizeof(double));
    append(&position.lat_deg, sizeof(double));
  }
  // Returns the bytes so far.
  [[nodiscard]] const std::vector<unsigned char>& bytes() const { return bytes_; }

 private:
  // Appends the bytes of a value in memory.
  void append(const void* data, std::size_t size) {
    const auto* const first = static_cast<const unsigned char*>(data);
    bytes_.insert(bytes_.end(), first, first + size);
  }

  std::vector<unsigned char> bytes_;
};

constexpr std::array<PartKind, 3> part_kinds = {PartKind::point, PartKind::line, PartKind::polygon};

// Returns the type of the geometries that have parts of one kind.
int type_of(PartKind kind) {
  return std::array{type_point, type_line, type_polygon}.at(static_cast<std::size_t>(kind)) +
         to_multi;
}

// Returns the type of all geometries, type_unknown if they are of several ones.
int common_type(std::span<const DrawnGeometry> geometries) {
  int common = type_unknown;
  for (const PartKind kind : part_kinds) {
    const bool occurs = std::ranges::any_of(
        geometries, [&](const DrawnGeometry& geometry) { return geometry.num_parts(kind) > 0; });
    if (occurs && common != type_unknown) return type_unknown;
    if (occurs) common = type_of(kind);
  }
  return common == type_unknown ? type_of(PartKind::polygon) : common;
}

// Writes the parts of one kind as one geometry.
void add_parts(const DrawnGeometry& geometry, PartKind kind, WkbWriter& wkb) {
  const auto add_positions = [&](std::span<const LonLat> positions) {
    wkb.add_number(static_cast<std::uint32_t>(positions.size()));
    for (const LonLat& position : positions) wkb.add_position(position);
  };
  wkb.begin(type_of(kind));
  wkb.add_number(static_cast<std::uint32_t>(geometry.num_parts(kind)));
  if (kind == PartKind::point) {
    for (const LonLat& point : geometry.points) {
      wkb.begin(type_point);
      wkb.add_position(point);
    }
  } else if (kind == PartKind::line) {
    for (const std::vector<LonLat>& line : geometry.lines) {
      wkb.begin(type_line);
      add_positions(line);
    }
  } else {
    for (const map::PolygonWithHoles& polygon : geometry.polygons) {
      wkb.begin(type_polygon);
      wkb.add_number(static_cast<std::uint32_t>(polygon.rings.size()));
      for (const std::vector<LonLat>& ring : polygon.rings) add_positions(ring);
    }
  }
}

// Returns a geometry: its parts of one kind, or a collection of those of several kinds.
std::vector<unsigned char> wkb_of(const DrawnGeometry& geometry, bool is_single_point) {
  std::vector<PartKind> kinds(part_kinds.begin(), part_kinds.end());
  std::erase_if(kinds, [&](PartKind kind) { return geometry.num_parts(kind) == 0; });
  WkbWriter wkb;
  if (is_single_point) {
    wkb.begin(type_point);
    wkb.add_position(geometry.points.front());
    return wkb.bytes();
  }
  if (kinds.size() > 1) {
    wkb.begin(type_collection);
    wkb.add_number(static_cast<std::uint32_t>(kinds.size()));
  }
  for (const PartKind kind : kinds) add_parts(geometry, kind, wkb);
  return wkb.bytes();
}

// Returns the number if the whole text is one. LLVM's C++ library before 20 has no
// std::from_chars() of doubles.
template <class Number>
std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const char* const last = text.data() + text.size();
  const auto [end, error] = [&] {
    if constexpr (std::is_integral_v<Number>) {
      return std::from_chars(text.data(), last, number);
    } else {
      return fast_float::from_chars(text.data(), last, number);
    }
  }();
  if (error != std::errc() || end != last) return std::nullopt;
  return number;
}

// Returns the type of a field. A column of numbers has integers of 64 bits if all of them are such,
// texts if doubles would round others, and else doubles.
int field_type(const Column& column) {
  if (!column.is_numeric) return field_text;
  for (std::size_t row = 0; row < column.ends.size(); ++row) {
    const std::string_view text = column.cell(row);
    if (text.empty() || number_in<std::int64_t>(text)) continue;
    return column.has_wide_integers() ? field_text : field_real;
  }
  return field_integer;
}

// Returns the names of the fields, one for each column. GeoPackage takes upper and lower case for
// one, and has columns of its own.
std::vector<std::string> field_names(const DrawnFeatures& features, const GdalFormat& format) {
  const bool is_sqlite = format.ending == ".gpkg";
  std::set<std::string> taken;
  for (const Measure& measure : features.measures) taken.insert(measure.name);
  if (is_sqlite) taken.insert({"fid", "geom"});
  std::vector<std::string> names;
  for (const Column& column : features.columns) names.push_back(column.name);
  return free_names(std::move(names), std::move(taken), is_sqlite);
}

// A dataset in GDAL's memory. What fails is told with the path of the file that it becomes.
class GdalFile {
 public:
  // Begins a dataset. Throws FileError if GDAL or its driver is missing, or refuses the dataset.
  GdalFile(const std::string& path, const GdalFormat& format)
      : gdal_(load_gdal(path)),
        quiet_(gdal_),
        date_(gdal_),
        path_(path),
        name_("/vsimem/rondel" + std::string(format.ending)) {
    dataset_ = gdal_.create(driver(path, format), name_.c_str(), 0, 0, 0, 0, nullptr);
    require(dataset_ != nullptr);
  }
  ~GdalFile() {
    if (dataset_ != nullptr) gdal_.close(dataset_);
    gdal_.free_bytes(gdal_.take_bytes(name_.c_str(), nullptr, 1));
  }
  GdalFile(const GdalFile&) = delete;
  GdalFile& operator=(const GdalFile&) = delete;

  // Returns GDAL's driver. \throws FileError if GDAL was built without it
  static GdalHandle driver(const std::string& path, const GdalFormat& format) {
    const Gdal& gdal = load_gdal(path);
    if (GdalHandle const found = gdal.driver_by_name(format.driver)) return found;
    throw FileError(path + ": GDAL " + gdal.version_info("RELEASE_NAME") + " has no driver '" +
                    format.driver +
                    "'; in Python, Regions.to_geopandas().to_parquet() writes such files");
  }

  // Makes the table: its name, the coordinate system and the fields: what is computed, then the
  // columns.
  void make_layer(const std::string& layer_name, const DrawnFeatures& features,
                  std::span<const std::string> names) {
    GdalHandle const reference = gdal_.new_reference(nullptr);
    gdal_.set_well_known_reference(reference, "WGS84");
    gdal_.set_axis_mapping(reference, traditional_axes);
    const int type = features.are_single_points ? type_point : common_type(features.geometries);
    // FlatGeobuf's index would change the order of the sites, which others count.
    std::string no_index = "SPATIAL_INDEX=NO";
    std::array<char*, 2> in_order = {no_index.data(), nullptr};
    const bool keeps_order = features.are_single_points && name_.ends_with(".fgb");
    layer_ = gdal_.create_layer(dataset_, layer_name.c_str(), reference, type,
                                keeps_order ? in_order.data() : nullptr);
    gdal_.destroy_reference(reference);
    require(layer_ != nullptr);
    for (const Measure& measure : features.measures) add_field(measure.name, field_real);
    for (std::size_t k = 0; k < features.columns.size(); ++k) {
      types_.push_back(field_type(features.columns[k]));
      add_field(names[k].c_str(), types_.back());
    }
    // Transactions make it faster, in formats that have them.
    has_transaction_ = gdal_.start_transaction(dataset_, 0) == 0;
  }

  // Adds a feature. A cell of a column that is empty stays NULL, unless it is an empty text of
  // GeoJSON.
  void add(const DrawnFeatures& features, std::size_t row) {
    const std::vector<unsigned char> wkb =
        wkb_of(features.geometries[row], features.are_single_points);
    GdalHandle geometry = nullptr;
    require(gdal_.geometry_of_wkb(wkb.data(), nullptr, &geometry, static_cast<int>(wkb.size())) ==
            0);
    GdalHandle const feature = gdal_.create_feature(gdal_.definition(layer_));
    gdal_.give_geometry(feature, geometry);
    int field = 0;
    for (const Measure& measure : features.measures) {
      gdal_.set_double(feature, field++, measure.values[row]);
    }
    for (std::size_t k = 0; k < features.columns.size(); ++k, ++field) {
      const Column& column = features.columns[k];
      const bool is_text = !column.is_json.empty() && !column.is_json[row];
      if (is_text || !column.cell(row).empty()) set(feature, field, types_[k], column.cell(row));
    }
    const int error = gdal_.add_feature(layer_, feature);
    gdal_.destroy_feature(feature);
    require(error == 0);
  }

  // Closes the dataset, which completes its bytes, and returns them.
  std::string finish() {
    require(!has_transaction_ || gdal_.commit_transaction(dataset_) == 0);
    // Some formats are written when they are closed, which returns nothing before GDAL 3.7.
    gdal_.reset_error();
    gdal_.close(std::exchange(dataset_, nullptr));
    constexpr int failure = 3;
    require(gdal_.last_error_type() < failure);
    unsigned long long size = 0;
    const unsigned char* const bytes = gdal_.take_bytes(name_.c_str(), &size, 0);
    require(bytes != nullptr);
    return {reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size)};
  }

 private:
  // Throws GDAL's last message unless a call was successful.
  void require(bool is_done) const {
    if (!is_done) throw FileError(path_ + ": GDAL: " + gdal_.last_error());
  }

  // Adds a field to the table. Throws FileError if GDAL refuses it.
  void add_field(const char* field_name, int type) {
    GdalHandle const field = gdal_.create_field(field_name, type);
    const int error = gdal_.add_field(layer_, field, 1);
    gdal_.destroy_field(field);
    require(error == 0);
  }

  // Sets a field of a feature from the text of a column.
  void set(GdalHandle feature, int field, int type, std::string_view text) const {
    if (type == field_integer) {
      gdal_.set_integer(feature, field, number_in<std::int64_t>(text).value_or(0));
    } else if (type == field_real) {
      gdal_.set_double(feature, field, number_in<double>(text).value_or(std::nan("")));
    } else {
      gdal_.set_text(feature, field, std::string(text).c_str());
    }
  }

  const Gdal& gdal_;
  QuietGdal quiet_;
  FixedDate date_;
  std::string path_;
  // The name in GDAL's memory, the type of each column's field, and GDAL's handles.
  std::string name_;
  GdalHandle dataset_ = nullptr;
  GdalHandle layer_ = nullptr;
  std::vector<int> types_;
  bool has_transaction_ = false;
};

}  // namespace

bool is_format_of_gdal(const FileName& file) { return gdal_format(file) != nullptr; }

void write_features_gdal(const FileName& file, const DrawnFeatures& features) {
  const std::lock_guard lock(gdal_lock());
  const GdalFormat& format = *gdal_format(file);
  GdalFile made(file.path, format);
  const std::string stem = std::filesystem::path(file.path).stem().string();
  const bool has_name = file.path != "-" && file.bytes == nullptr;
  made.make_layer(has_name                     ? stem
                  : features.are_single_points ? "sites"
                                               : "cells",
                  features, field_names(features, format));
  for (std::size_t i = 0; i < features.geometries.size(); ++i) {
    if (features.is_written[i] && !features.geometries[i].is_empty()) made.add(features, i);
  }
  write_file(file, made.finish());
}

}  // namespace rondel::formats

namespace rondel {

void require_region_writer(const FileName& file) {
  if (const formats::GdalFormat* const format = formats::gdal_format(file)) {
    (void)formats::GdalFile::driver(file.path, *format);
  }
}

}  // namespace rondel
