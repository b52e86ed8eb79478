// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads sites from GeoJSON (RFC 7946): every Point and every member of a MultiPoint, alone, in a
// geometry collection or in features, whose properties become columns.
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "io/geojson_items.h"
#include "io/number.h"
#include "io/site_collector.h"
#include "io/site_formats.h"

namespace rondel::io {
namespace {

// Collects the Points of a document as sites.
class GeoJsonReader {
 public:
  GeoJsonReader(std::string_view bytes, const ReadJob& options, SiteTable& table)
      : num_bytes_(bytes.size()),
        radius_(options.radius),
        keep_columns_(options.keep_columns),
        table_(table),
        collector_(table, options),
        columns_(table.columns, table.ids),
        items_(bytes) {}

  // Throws BadValue if the document is not valid; line() is then where.
  void read() {
    items_.read({[this](const JsonTree& geometry, const JsonTree& feature) {
                   const std::size_t first = collector_.size();
                   add_geometry(geometry, feature);
                   if (collector_.size() - first > 1) columns_.forget_ids(first);
                 },
                 [this](const JsonTree& /*feature*/) { ++table_.num_unlocated; }});
    columns_.finish(collector_.size());
    const std::vector<std::uint64_t>& lines = table_.lines;
    for (std::size_t i = 1; i < lines.size(); ++i) {
      if (lines[i] != lines[i - 1] || features_[i] == features_[i - 1]) continue;
      table_.features = std::move(features_);
      break;
    }
  }
  [[nodiscard]] std::uint64_t line() const { return items_.line(); }

 private:
  // Adds the sites of a geometry.
  void add_geometry(const JsonTree& geometry, const JsonTree& feature);
  // Adds one site, with the properties of its feature.
  void add_coordinates(const JsonTree& coordinates, const JsonTree& feature);
  // Returns the radius of the site's circle, which is a property of its feature.
  [[nodiscard]] double radius_in(const JsonTree& feature) const;

  std::size_t num_bytes_;
  std::string radius_;  // name of the property
  bool keep_columns_;
  SiteTable& table_;
  SiteCollector collector_;
  PropertyColumns columns_;
  std::vector<std::uint64_t> features_;  // of each site
  GeoJsonItems items_;
};

// Collections may be nested as deep as the text may be.
void GeoJsonReader::add_geometry(const JsonTree& geometry, const JsonTree& feature) {
  const std::string type = geojson_type(geometry);
  const JsonTree& coordinates = geometry.member("coordinates");
  if (type == "Point") return add_coordinates(coordinates, feature);
  const bool is_collection = type == "GeometryCollection";
  if (!is_collection && type != "MultiPoint") {
    throw BadValue("type " + in_quotes(type) + " where a Point is needed");
  }
  const JsonTree& members = is_collection ? geometry.member("geometries") : coordinates;
  if (!members.is_array()) throw BadValue(type + " without members");
  for (const JsonTree& part : members.items) {
    if (is_collection) {
      add_geometry(part, feature);
    } else {
      add_coordinates(part, feature);
    }
  }
}

void GeoJsonReader::add_coordinates(const JsonTree& coordinates, const JsonTree& feature) {
  const LonLat position = geojson_position(coordinates);
  if (keep_columns_) columns_.add(feature, collector_.size());
  features_.push_back(items_.number());
  collector_.add_position(position.lon_deg, position.lat_deg, line());
  if (!radius_.empty()) collector_.make_circle(radius_in(feature));
  collector_.report_progress(items_.num_bytes_read(), num_bytes_);
}

double GeoJsonReader::radius_in(const JsonTree& feature) const {
  const JsonTree& value = feature.member("properties").member(radius_);
  if (value.is_null()) throw BadValue("no property " + in_quotes(radius_));
  if (value.is_number()) return value.number();
  return parse_number(unquoted(value), "radius");
}

}  // namespace

void read_geojson(std::string_view bytes, const ReadJob& options, SiteTable& table) {
  GeoJsonReader reader(bytes, options, table);
  at_line_of(reader, [&] { reader.read(); });
}

}  // namespace rondel::io
