// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads sites and features by GDAL: read_sites_gdal() and geojson_of_gdal(). Files with a path are opened by GDAL itself, since a
// shapefile has others beside it; what comes from standard input is put into GDAL's memory.
#include "formats/sites_gdal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <mutex>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/cf_names.h"
#include "formats/gdal.h"
#include "io/bad_value.h"
#include "io/column_text.h"
#include "io/ending.h"
#include "io/file_bytes.h"
#include "io/geojson_writer.h"
#include "io/number.h"
#include "io/site_collector.h"
#include "rondel/error.h"

namespace rondel::formats {
namespace {

// A format with the ending of its files and the name of GDAL's driver.
struct SiteFormat {
  std::string_view ending;
  const char* driver;
};
constexpr std::array<SiteFormat, 4> site_formats = {{{".gpkg", "GPKG"},
                                                     {".fgb", "FlatGeobuf"},
                                                     {".shp", "ESRI Shapefile"},
                                                     {".parquet", "Parquet"}}};

// Values of GDAL's enumerations.
constexpr unsigned open_vector = 4, open_with_errors = 64;
constexpr int point_type = 1, line_string_type = 2, polygon_type = 3, multi_point_type = 4,
              multi_polygon_type = 6, collection_type = 7;
constexpr std::array<std::string_view, 8> type_names = {
    "",           "Point",           "LineString",   "Polygon",
    "MultiPoint", "MultiLineString", "MultiPolygon", "GeometryCollection"};
constexpr int integer_field = 0, real_field = 2, long_field = 12;
constexpr int failure = 3;

// A field of the layer that is read.
struct Field {
  int type = 0;
  Column column;
};

// Returns the position of the field with that name; the number of fields if the name is empty.
// Throws BadValue if there is none.
std::size_t radius_field(const std::vector<Field>& fields, const std::string& name) {
  if (name.empty()) return fields.size();
  const auto found = std::ranges::find(fields, name, [](const Field& f) { return f.column.name; });
  if (found == fields.end()) throw io::BadValue("no field " + io::in_quotes(name));
  return static_cast<std::size_t>(found - fields.begin());
}

// A file that GDAL has open. What GDAL refuses is told with the name of the file.
class SiteSource {
 public:
  // Opens the file. Throws FileError.
  SiteSource(const FileName& file, io::FileBytes& bytes, const SiteFormat& format)
      : gdal_(load_gdal(bytes.name(), GdalUse::reading)),
        quiet_(gdal_),
        name_(bytes.name()),
        memory_("/vsimem/rondel-input" + std::string(format.ending)) {
    if (gdal_.driver_by_name(format.driver) == nullptr) {
      throw FileError(name_ + ": GDAL " + gdal_.version_info("RELEASE_NAME") + " has no driver '" +
                      format.driver + "'");
    }
    path_ = bytes.has_path() ? file.path : placed(bytes, format);
    const std::array<const char*, 2> drivers = {format.driver, nullptr};
    gdal_.reset_error();
    dataset_ =
        gdal_.open(path_.c_str(), open_vector | open_with_errors, drivers.data(), nullptr, nullptr);
    if (dataset_ == nullptr) fail();
  }
  ~SiteSource() {
    if (dataset_ != nullptr) gdal_.close(dataset_);
    if (is_in_memory_) gdal_.remove_file(memory_.c_str());
  }
  SiteSource(const SiteSource&) = delete;
  SiteSource& operator=(const SiteSource&) = delete;

  // Reads the sites and, if they are kept, the columns. Throws BadValue or FileError.
  void read(const io::ReadJob& options, SiteTable& table);
  // True if the first feature with a place has a polygon, or several geometries. Throws BadValue.
  [[nodiscard]] bool begins_with_polygon() const;
  // Returns the features as GeoJSON. Throws BadValue or FileError.
  [[nodiscard]] std::string geojson() const;

 private:
  // Throws what GDAL said last.
  [[noreturn]] void fail() const { throw FileError(name_ + ": GDAL: " + gdal_.last_error()); }
  // Puts the bytes into GDAL's memory, and returns the name that they have there.
  std::string placed(io::FileBytes& bytes, const SiteFormat& format);
  // Returns the only layer of the file.
  [[nodiscard]] GdalHandle only_layer() const;
  // Throws BadValue unless the layer has degrees of longitude and latitude.
  void require_degrees(GdalHandle layer) const;
  // Returns the fields of the layer, whose columns have no cells.
  [[nodiscard]] std::vector<Field> fields_of(GdalHandle layer) const;
  // Appends a cell to the column of a field.
  void add_cell(GdalHandle feature, int number, Field& field) const;
  // Returns the places of a feature.
  [[nodiscard]] std::vector<LonLat> places_of(GdalHandle feature) const;
  // Appends a geometry, or its coordinates, as GeoJSON. An empty geometry is null, or no part.
  void append_geometry(GdalHandle geometry, std::string& text) const;
  void append_coordinates(GdalHandle geometry, int type, std::string& text) const;
  // Calls visit() for each feature of a layer with its number. Throws BadValue that says which one.
  template <class Visit>
  void for_each_feature(GdalHandle layer, const Visit& visit) const {
    gdal_.reset_reading(layer);
    gdal_.reset_error();
    for (std::uint64_t row = 0;; ++row) {
      GdalHandle const feature = gdal_.next_feature(layer);
      if (feature == nullptr) break;
      const auto destroy = [&](GdalHandle handle) { gdal_.destroy_feature(handle); };
      const std::unique_ptr<void, decltype(destroy)> owner(feature, destroy);
      io::at_item("feature", row, [&] { visit(feature, row); });
    }
    if (gdal_.last_error_type() >= failure) fail();
  }
  // Returns the radius in a field. Throws BadValue if it is no number.
  [[nodiscard]] double radius_in(GdalHandle feature, int number, const Field& field) const;

  const Gdal& gdal_;
  QuietGdal quiet_;
  std::string name_;
  std::string memory_;  // a name in GDAL's memory
  std::string path_;    // what GDAL opens
  bool is_in_memory_ = false;
  GdalHandle dataset_ = nullptr;
};

std::string SiteSource::placed(io::FileBytes& bytes, const SiteFormat& format) {
  if (format.ending == ".shp") {
    throw FileError(name_ + ": a shapefile is several files, which are read by their name");
  }
  const std::string_view text = bytes.text();
  // GDAL only reads the bytes, which `bytes` keeps.
  auto* const data = reinterpret_cast<unsigned char*>(const_cast<char*>(text.data()));
  GdalHandle const made = gdal_.place_file(memory_.c_str(), data, text.size(), 0);
  if (made == nullptr) fail();
  gdal_.close_file(made);
  is_in_memory_ = true;
  return memory_;
}

GdalHandle SiteSource::only_layer() const {
  const int number = gdal_.num_layers(dataset_);
  if (number == 1) return gdal_.layer(dataset_, 0);
  std::string names;
  for (int i = 0; i < number; ++i) {
    names += (i == 0 ? "" : ", ") + std::string(gdal_.layer_name(gdal_.layer(dataset_, i)));
  }
  throw io::BadValue(number == 0 ? "it has no layer"
                                 : "it has several layers: " + names +
                                       "; 'ogr2ogr one.fgb FILE LAYER' takes one out of it");
}

void SiteSource::require_degrees(GdalHandle layer) const {
  GdalHandle const reference = gdal_.layer_reference(layer);
  if (reference == nullptr) return;  // as in .csv
  constexpr double degree = std::numbers::pi / 180;
  constexpr double tolerance = 1e-9;  // of the numbers that files have for a degree
  const bool is_usual = gdal_.is_geographic(reference) != 0 &&
                        std::abs(gdal_.angular_units(reference, nullptr) - degree) < tolerance &&
                        gdal_.prime_meridian(reference, nullptr) == 0;
  if (is_usual) return;
  const char* const text = gdal_.reference_name(reference);
  const std::string name = text == nullptr ? "" : text;
  // GeoPackage has systems that stand for none, which GDAL writes where none is known.
  if (gdal_.is_local(reference) != 0 && lower_case(name).starts_with("undefined ")) return;
  throw io::BadValue("the coordinate system " + io::in_quotes(name) +
                     " is not longitude and latitude in degrees; 'ogr2ogr -t_srs EPSG:4326 "
                     "OUT.gpkg FILE' converts it");
}

std::vector<Field> SiteSource::fields_of(GdalHandle layer) const {
  GdalHandle const definition = gdal_.definition(layer);
  std::vector<Field> fields(static_cast<std::size_t>(gdal_.num_fields(definition)));
  for (std::size_t i = 0; i < fields.size(); ++i) {
    GdalHandle const field = gdal_.field(definition, static_cast<int>(i));
    fields[i].type = gdal_.field_type(field);
    fields[i].column = io::make_column(gdal_.field_name(field));
    const int type = fields[i].type;
    fields[i].column.is_numeric = type == integer_field || type == long_field || type == real_field;
  }
  return fields;
}

// A field that is not set is an empty cell; of a column of texts, which may be empty themselves,
// `is_json` tells null from them.
void SiteSource::add_cell(GdalHandle feature, int number, Field& field) const {
  Column& column = field.column;
  const bool is_set = gdal_.is_set(feature, number) != 0;
  if (!column.is_numeric) {
    io::append_cell(column, is_set ? gdal_.text(feature, number) : "");
    column.is_json.push_back(!is_set);
    return;
  }
  if (is_set && field.type == real_field) {
    const double value = gdal_.real(feature, number);
    if (std::isinf(value)) {
      throw io::BadValue(io::in_quotes(column.name) + " is infinite");
    }
    if (!std::isnan(value)) io::append_number(column.text, value);
  } else if (is_set) {
    column.text += std::to_string(gdal_.integer(feature, number));
  }
  column.ends.push_back(column.text.size());
}

std::vector<LonLat> SiteSource::places_of(GdalHandle feature) const {
  std::vector<LonLat> places;
  GdalHandle const geometry = gdal_.geometry(feature);
  if (geometry == nullptr || gdal_.is_empty(geometry) != 0) return places;
  const int type = gdal_.flat_type(gdal_.geometry_type(geometry));
  const auto add = [&](GdalHandle point) {
    if (gdal_.is_empty(point) == 0) places.push_back({gdal_.x(point, 0), gdal_.y(point, 0)});
  };
  if (type == point_type) {
    add(geometry);
  } else if (type == multi_point_type) {
    const int number = gdal_.num_parts(geometry);
    for (int i = 0; i < number; ++i) add(gdal_.part(geometry, i));
  } else {
    throw io::BadValue("it has lines or polygons where a Point is needed");
  }
  return places;
}

double SiteSource::radius_in(GdalHandle feature, int number, const Field& field) const {
  if (gdal_.is_set(feature, number) == 0) throw io::BadValue("the radius is missing");
  if (field.column.is_numeric) return gdal_.real(feature, number);
  return io::parse_number(gdal_.text(feature, number), "radius");
}

void SiteSource::append_coordinates(GdalHandle geometry, int type, std::string& text) const {
  const auto append_position = [&](int i) {
    text += '[';
    io::append_number(text, gdal_.x(geometry, i));
    text += ',';
    io::append_number(text, gdal_.y(geometry, i));
    text += ']';
  };
  if (type == point_type) return append_position(0);
  const bool is_line = type == line_string_type;
  const int number = is_line ? gdal_.num_points(geometry) : gdal_.num_parts(geometry);
  bool is_first = true;
  text += '[';
  for (int i = 0; i < number; ++i) {
    GdalHandle const part = is_line ? nullptr : gdal_.part(geometry, i);
    if (!is_line && gdal_.is_empty(part) != 0) continue;
    if (!std::exchange(is_first, false)) text += ',';
    if (is_line) {
      append_position(i);
    } else if (type == collection_type) {
      append_geometry(part, text);
    } else {
      append_coordinates(part, gdal_.flat_type(gdal_.geometry_type(part)), text);
    }
  }
  text += ']';
}

void SiteSource::append_geometry(GdalHandle geometry, std::string& text) const {
  if (geometry == nullptr || gdal_.is_empty(geometry) != 0) {
    text += "null";
    return;
  }
  const int type = gdal_.flat_type(gdal_.geometry_type(geometry));
  if (type < point_type || type > collection_type) {
    throw io::BadValue("it has curves or surfaces where points, lines or polygons are needed");
  }
  text += R"({"type":")";
  text += type_names[static_cast<std::size_t>(type)];
  text += type == collection_type ? R"(","geometries":)" : R"(","coordinates":)";
  append_coordinates(geometry, type, text);
  text += '}';
}

bool SiteSource::begins_with_polygon() const {
  GdalHandle const layer = only_layer();
  gdal_.reset_reading(layer);
  int type = 0;
  while (type == 0) {
    GdalHandle const feature = gdal_.next_feature(layer);
    if (feature == nullptr) return false;
    GdalHandle const geometry = gdal_.geometry(feature);
    const bool is_located = geometry != nullptr && gdal_.is_empty(geometry) == 0;
    if (is_located) type = gdal_.flat_type(gdal_.geometry_type(geometry));
    gdal_.destroy_feature(feature);
  }
  return type == polygon_type || type == multi_polygon_type || type == collection_type;
}

std::string SiteSource::geojson() const {
  GdalHandle const layer = only_layer();
  require_degrees(layer);
  std::vector<Field> fields = fields_of(layer);
  std::vector<std::string> geometries;
  for_each_feature(layer, [&](GdalHandle feature, std::uint64_t) {
    for (std::size_t i = 0; i < fields.size(); ++i) {
      add_cell(feature, static_cast<int>(i), fields[i]);
    }
    append_geometry(gdal_.geometry(feature), geometries.emplace_back());
  });
  std::vector<Column> columns;
  for (Field& field : fields) columns.push_back(std::move(field.column));
  const std::vector<std::string> keys = io::property_keys(columns, {});
  std::string text = R"({"type":"FeatureCollection","features":[)";
  for (std::size_t row = 0; row < geometries.size(); ++row) {
    text +=
        row == 0 ? R"({"type":"Feature","properties":{)" : R"(,{"type":"Feature","properties":{)";
    for (std::size_t i = 0; i < columns.size(); ++i) {
      text += i == 0 ? keys[i].substr(1) : keys[i];
      io::append_value(text, columns[i], row);
    }
    text += io::geometry_begin + std::exchange(geometries[row], {}) + '}';
  }
  return text + "]}";
}

void SiteSource::read(const io::ReadJob& options, SiteTable& table) {
  GdalHandle const layer = only_layer();
  require_degrees(layer);
  std::vector<Field> fields = fields_of(layer);
  const std::size_t radius = radius_field(fields, options.radius);
  const auto total = static_cast<std::size_t>(std::max(0LL, gdal_.num_features(layer, 0)));
  io::SiteCollector collector(table, options);
  collector.reserve(total, true);
  for_each_feature(layer, [&](GdalHandle feature, std::uint64_t row) {
    const std::vector<LonLat> places = places_of(feature);
    if (places.empty()) ++table.num_unlocated;
    for (const LonLat& place : places) {
      collector.add_position(place.lon_deg, place.lat_deg, 0);
      if (radius < fields.size()) {
        collector.make_circle(radius_in(feature, static_cast<int>(radius), fields[radius]));
      }
      for (std::size_t i = 0; i < fields.size() && options.keep_columns; ++i) {
        add_cell(feature, static_cast<int>(i), fields[i]);
      }
      collector.report_progress(row, total);
    }
  });
  table.first_line = 0;
  for (Field& field : fields) {
    if (options.keep_columns) table.columns.push_back(std::move(field.column));
  }
}

// Returns what take() returns for a file that is open.
template <class Take>
auto from_source(const FileName& file, const Take& take) {
  const std::lock_guard lock(gdal_lock());
  io::FileBytes bytes(file, true);
  if (bytes.head().empty()) throw FileError(bytes.name() + ": the file is empty");
  const SiteSource source(file, bytes, *io::find_format<SiteFormat>(site_formats, file));
  return io::in_file(bytes.name(), [&] { return take(source); });
}

}  // namespace

bool is_read_by_gdal(const FileName& file) {
  return io::find_format<SiteFormat>(site_formats, file) != nullptr;
}

std::string geojson_of_gdal(const FileName& file) {
  return from_source(file, [](const SiteSource& source) { return source.geojson(); });
}

bool begins_with_polygon(const FileName& file) {
  return from_source(file, [](const SiteSource& source) { return source.begins_with_polygon(); });
}

void read_sites_gdal(const FileName& file, const io::ReadJob& options, SiteTable& table) {
  const std::lock_guard lock(gdal_lock());
  io::FileBytes bytes(file, true);
  table.name = bytes.name();
  if (bytes.head().empty()) throw FileError(table.name + ": the file is empty");
  SiteSource source(file, bytes, *io::find_format<SiteFormat>(site_formats, file));
  io::in_file(table.name, [&] { source.read(options, table); });
}

}  // namespace rondel::formats
