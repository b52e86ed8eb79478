// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A file of points is read once. Whether GeoJSON has points or polygons shows when it is read, so
// that a message may need a second reading, of a file that is refused anyway.
#include "formats/places_of_points.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>

#include "formats/cf_names.h"
#include "formats/field_columns.h"
#include "formats/sites_gdal.h"
#include "io/ending.h"
#include "rondel/conventions.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/polygon_files.h"
#include "rondel/read_cells.h"

namespace rondel::formats {
namespace {

// Reads the sites of a file; features may have the ending .json, too.
SiteTable sites_of(FileName file, const ReadOptions& options, const Execution& execution) {
  if (io::is_geojson(file)) file.format = "geojson";
  return read_sites(file, options, execution);
}

// Returns a message of the reader of tables without the options that name columns and delimiters: those
// of a target are found by its header and its ending alone.
std::string without_options(std::string message) {
  constexpr std::pair<std::string_view, std::string_view> advice[] = {
      {" (--delimiter)", " A target has commas, or tabs in .tsv"},
      {"; name one of them", "; rename or remove one of them"},
      {"; name those to read", "; rename or remove those of one kind"},
      {": --lon ", ", call them lon and lat"},
  };
  for (const auto& [option, instead] : advice) {
    const std::size_t at = message.rfind(option);
    if (at == std::string::npos) continue;
    // Behind --lon come the names of both columns, to the end.
    const bool is_to_end = option.starts_with(": --");
    message.replace(at, is_to_end ? std::string::npos : option.size(), instead);
  }
  return message;
}

// True if a file that could not be read as points has polygons, valid ones or not.
bool has_polygons(const FileName& file) {
  if (!io::is_geojson(file)) return is_read_by_gdal(file) && can_read_polygons(file);
  try {
    PolygonOptions options;
    options.invalid = InvalidPolygons::repair;
    return read_polygons(file, options).num_cells() > 0;
  } catch (const FileError&) {
    return false;
  } catch (const InvalidInput&) {
    return false;
  }
}

// Removes the columns of the coordinates; properties of features are none.
void keep_value_columns(const FileName& file, const ReadOptions& options, SiteTable& table) {
  if (io::is_geojson(file) || is_read_by_gdal(file)) return;
  const std::vector<std::string> kept = value_columns(table, options);
  std::size_t next = 0;  // `kept` has the names in the order of the columns
  std::erase_if(table.columns, [&](const Column& column) {
    const bool is_kept = next < kept.size() && column.name == kept[next];
    if (is_kept) ++next;
    return !is_kept;
  });
}

// Throws FileError for the first point in the middle of the sphere, where no direction is a place.
void require_directions(const SiteTable& table, const std::vector<LonLat>& places) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!std::isnan(places[i].lon_deg)) continue;
    throw FileError(table.where(i) + ": the point has no direction, so that it is no place");
  }
}

bool is_time(const std::string& dimension, const FieldArray* axis) {
  if (axis == nullptr) return is_name_of_time(dimension);
  return std::ranges::any_of(axis->attributes, [](const auto& attribute) {
    const auto& [name, text] = attribute;
    return (name == "units" && text.find(" since ") != std::string::npos) ||
           (name == "standard_name" && text == "time") || (name == "axis" && text == "T");
  });
}

// True if an axis has heights, depths or pressures by CF (section 4.3).
bool is_vertical(const FieldArray* axis) {
  if (axis == nullptr) return false;
  constexpr std::string_view pressures[] = {"Pa", "hPa", "mbar", "millibar", "bar", "dbar"};
  return std::ranges::any_of(axis->attributes, [&](const auto& attribute) {
    const auto& [name, text] = attribute;
    return name == "positive" || (name == "axis" && text == "Z") ||
           (name == "units" && std::ranges::count(pressures, text) > 0);
  });
}

// Returns the feature that an array has at a site; empty if CF has no name for it.
std::string_view feature_of(const FieldArray& array, const std::vector<FieldArray>& axes) {
  bool has_times = false;
  bool has_levels = false;
  for (const std::string& dimension : array.dimensions) {
    const auto found = std::ranges::find_if(
        axes, [&](const FieldArray& axis) { return axis.dimensions.front() == dimension; });
    const FieldArray* const axis = found == axes.end() ? nullptr : &*found;
    if (is_time(dimension, axis)) {
      has_times = true;
    } else if (is_vertical(axis)) {
      has_levels = true;
    } else {
      return {};
    }
  }
  if (has_times) return has_levels ? "timeSeriesProfile" : "timeSeries";
  return has_levels ? "profile" : "point";
}

// True if each cell names one site.
bool are_names(const Column& column) {
  std::set<std::string_view> names;
  for (std::size_t row = 0; row < column.ends.size(); ++row) {
    const std::string_view name = column.cell(row);
    if (name.empty() || !names.insert(name).second) return false;
  }
  return !names.empty();
}

// Gives a role to the names of sites: to those that had one in their file, or else to the first texts.
// Returns the column that had a role and is no name of one site each, if no other one has a role now.
std::string give_role(const std::string& role, std::vector<Column>& columns) {
  Column* names = nullptr;
  bool had_role = false;
  std::string without_role;
  for (Column& column : columns) {
    const bool has_role = std::erase_if(column.attributes, [](const auto& attribute) {
                            return attribute.first == "cf_role";
                          }) > 0;
    const bool is_better =
        names == nullptr ? has_role || !are_numbers(column) : has_role && !had_role;
    if (!is_better) continue;
    if (!are_names(column)) {
      if (has_role && without_role.empty()) without_role = column.name;
      continue;
    }
    names = &column;
    had_role = has_role;
  }
  if (role.empty()) return {};
  if (names != nullptr) names->attributes.emplace_back("cf_role", role);
  return had_role ? std::string() : without_role;
}

}  // namespace

bool may_have_points(const FileName& file) {
  constexpr std::string_view formats[] = {"csv", "tsv", "xyz", "txt", "npy"};
  return io::is_geojson(file) || is_read_by_gdal(file) ||
         std::ranges::count(formats, format_of(file)) > 0;
}

PlacesOfPoints read_places_of_points(const FileName& file, const Execution& execution) {
  ReadOptions options;
  options.keep_columns = true;
  SiteTable table;
  try {
    table = sites_of(file, options, execution);
  } catch (const FileError& error) {
    if (!has_polygons(file)) throw FileError(without_options(error.what()));
    throw FileError(file.path +
                    ": it has polygons, which are no places: conservative methods, largest_share "
                    "and statistics are over polygons, and other methods between places");
  }
  keep_value_columns(file, options, table);
  PlacesOfPoints points;
  points.places = table.is_lonlat() ? std::move(table.positions) : lonlats(table.sites);
  points.columns = std::move(table.columns);
  require_directions(table, points.places);
  if (points.places.empty()) points.remarks.emplace_back("there are no points");
  if (table.num_unlocated > 0) {
    points.remarks.push_back("left out " + std::to_string(table.num_unlocated) +
                             (table.num_unlocated == 1 ? " target" : " targets") +
                             " without a place");
  }
  return points;
}

void refuse_points_as_cells(const FileName& file, const Execution& execution) {
  if (!may_have_points(file)) return;
  if (io::is_geojson(file) || is_read_by_gdal(file)) {
    try {
      if (is_read_by_gdal(file) && can_read_polygons(file)) return;
      if (sites_of(file, {}, execution).sites.empty()) return;
    } catch (const FileError&) {
      return;  // the reader of polygons says what is wrong
    }
  }
  throw FileError(
      file.path +
      ": points have no cells, which conservative methods, largest_share and statistics "
      "need; nearest, linear, laplace, sibson, hermite, cubic, bilinear and native are "
      "the methods for points");
}

// Arrays without times and levels are properties of a site, beside those that have some.
std::string describe_features(FieldSet& fields, WeightSide& side) {
  std::set<std::string_view> features;
  for (const FieldArray& array : fields.arrays) {
    if (!array.dimensions.empty()) features.insert(feature_of(array, fields.axes));
  }
  if (features.size() > 1 || features.contains("")) return {};
  const std::string feature(features.empty() ? "point" : *features.begin());
  fields.attributes.emplace_back("featureType", feature);
  const std::string column = give_role(feature == "point"     ? ""
                                       : feature == "profile" ? "profile_id"
                                                              : "timeseries_id",
                                       side.columns);
  return column.empty() ? std::string()
                        : column + " has no cf_role, as a name is empty or there more than once";
}

}  // namespace rondel::formats
