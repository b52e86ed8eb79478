// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// isolines, bands, write_isolines, write_bands: what rondel/contours.h promises of any sites and values.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "fuzz/fuzz_input.h"
#include "fuzz/scratch_folder.h"
#include "fuzz/table_input.h"
#include "fuzz/valid_polygons.h"
#include "rondel/contours.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"

namespace rondel::fuzz {
namespace {

// Quarters, which are often equal, missing ones, and at times any numbers.
double next_value(ByteSource& source) {
  const std::size_t which = source.below(32);
  if (which == 0) return std::numeric_limits<double>::quiet_NaN();
  if (which == 1) return source.finite_double();
  if (which == 2 && source.below(16) == 0) return std::numeric_limits<double>::infinity();
  const auto halves = source.small() / 64;
  return 0.5 * static_cast<double>(halves);
}

std::vector<double> next_levels(ByteSource& source) {
  std::vector<double> levels{source.below(4) == 0 ? source.finite_double() : source.small() / 64.0};
  while (levels.size() < 4 && source.below(4) != 0) {
    const double level = levels.back() + (1 + source.small() % 4) / 2.0;
    if (level > levels.back()) levels.push_back(level);
  }
  return levels;
}

bool is_simple(std::span<const Point> points) {
  std::vector<std::array<double, 3>> places;
  for (const Point& p : points) {
    if (!(std::abs(p.x * p.x + p.y * p.y + p.z * p.z - 1) < 1e-14)) return false;
    places.push_back({p.x, p.y, p.z});
  }
  std::ranges::sort(places);
  return std::ranges::adjacent_find(places) == places.end();
}

void test_isolines(const Isolines& lines) {
  require(lines.lines.offsets.size() == lines.levels.size() + 1 &&
              lines.lines.offsets.back() == lines.num_lines() &&
              lines.lines.rows.size() == lines.num_lines() &&
              lines.lines.rows.offsets.back() == lines.lines.rows.values.size(),
          "the arrays of isolines fit together");
  for (std::size_t i = 0; i < lines.num_lines(); ++i) {
    const auto points = lines.lines.rows[i];
    require(points.size() >= (lines.is_closed[i] != 0 ? 3U : 2U) && is_simple(points),
            "isolines are simple");
  }
}

// The area to the left of a ring up to multiples of 4 pi, by triangles (Oosterom, Strackee 1983) at a place
// that is the antipode of no point.
double ring_area(std::span<const Point> ring) {
  const double length = std::hypot(0.4157097201, 0.8828118405, 0.2189138513);
  const Point a{0.4157097201 / length, 0.8828118405 / length, 0.2189138513 / length};
  double area = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point& b = ring[i];
    const Point& c = ring[(i + 1) % ring.size()];
    const Point d{c.x - b.x, c.y - b.y, c.z - b.z};
    const double volume = a.x * (b.y * d.z - b.z * d.y) + a.y * (b.z * d.x - b.x * d.z) +
                          a.z * (b.x * d.y - b.y * d.x);
    const auto dot = [](const Point& p, const Point& q) {
      return p.x * q.x + p.y * q.y + p.z * q.z;
    };
    area += 2 * std::atan2(volume, 1 + dot(a, b) + dot(b, c) + dot(c, a));
  }
  return area;
}

// Rows are the same however they are appended.
void test_rows(const RowGroups<CompressedRows<Point>>& polygons) {
  RowGroups<CompressedRows<Point>> copy;
  CompressedRows<Point> one_by_one;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    for (auto row = polygons.offsets[i]; row < polygons.offsets[i + 1]; ++row) {
      copy.rows.append(polygons.rows[row]);
      for (const Point& p : polygons.rows[row]) one_by_one.values.push_back(p);
      one_by_one.end_row();
    }
    copy.end_group();
  }
  CompressedRows<Point> at_once;
  at_once.append_rows(one_by_one);
  require(copy == polygons && at_once == copy.rows, "rows are what was appended");
}

void test_bands(const Bands& bands) {
  test_rows(bands.bands.rows);
  require(bands.bands.offsets.size() == bands.num_bands() + 1 &&
              bands.bands.offsets.back() == bands.num_polygons() &&
              bands.bands.rows.offsets.back() == bands.rings().size() &&
              bands.rings().offsets.back() == bands.rings().values.size(),
          "the arrays of bands fit together");
  for (std::size_t ring = 0; ring < bands.rings().size(); ++ring) {
    const auto points = bands.rings()[ring];
    require(points.size() >= 3 && is_simple(points), "rings are simple");
  }
}

double area_of(const Bands& bands) {
  double area = 0;
  for (std::size_t ring = 0; ring < bands.rings().size(); ++ring) {
    area += ring_area(bands.rings()[ring]);
  }
  return area;
}

// Whether doubles tell the ends of all edges apart, and from the antipodes of each other.
bool has_clear_edges(const Triangulation& t) {
  const auto unit = [&](Index site) {
    const Point& p = t.sites()[site];
    const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    const Point scaled{p.x / largest, p.y / largest, p.z / largest};
    const double length = std::hypot(scaled.x, scaled.y, scaled.z);
    return Point{scaled.x / length, scaled.y / length, scaled.z / length};
  };
  for (const Triple& face : t.faces()) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Point p = unit(face[i]);
      const Point q = unit(face[(i + 1) % 3]);
      if (std::hypot(p.x - q.x, p.y - q.y, p.z - q.z) < 1e-9) return false;
      if (std::hypot(p.x + q.x, p.y + q.y, p.z + q.z) < 1e-4) return false;
    }
  }
  return true;
}

// Values that count are values of the place, and missing ones are missing in all sites of it.
void test_first_values(const Triangulation& t, const std::vector<double>& values) {
  std::vector<Index> place(values.size());
  for (Index i = 0; i < place.size(); ++i) place[i] = i;
  for (const auto& [site, representative] : t.duplicates()) place[site] = representative;
  std::vector<double> expected(values.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = values.size(); i-- > 0;) {
    if (!std::isnan(values[i])) expected[place[i]] = values[i];
  }
  const std::vector<double> found = first_values(t, values);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double wanted = place[i] == i ? expected[i] : values[i];
    require(found[i] == wanted || (std::isnan(found[i]) && std::isnan(wanted)),
            "the first value of a place counts");
  }
}

// Levels divide the surface; they change nothing of what it covers.
void test_area(const Bands& bands, const Bands& undivided) {
  const double difference = area_of(bands) - area_of(undivided);
  require(std::abs(std::remainder(difference, 4 * std::numbers::pi)) < 1e-9,
          "bands cover the surface");
}

// Positions on the map, closed rings.
void test_document(const nlohmann::json& document, std::size_t num_features) {
  require(document.at("features").size() == num_features, "a feature for each level or band");
  for (const auto& feature : document.at("features")) {
    if (feature.at("geometry").is_null()) continue;
    const bool is_polygon = feature["geometry"].at("type") == "MultiPolygon";
    for (const auto& item : feature["geometry"].at("coordinates")) {
      for (const auto& ring : is_polygon ? item : nlohmann::json::array({item})) {
        require(ring.size() >= (is_polygon ? 4U : 2U), "enough positions");
        require(!is_polygon || ring.front() == ring.back(), "rings are closed");
        for (const auto& position : ring) {
          require(std::abs(position[0].get<double>()) <= 180 &&
                      std::abs(position[1].get<double>()) <= 90,
                  "positions are on the map");
        }
      }
    }
  }
}

void test_any_order(std::vector<Point> sites, std::vector<double> values, const Options& options,
                    std::span<const double> levels, const Bands& expected) {
  std::ranges::reverse(sites);
  std::ranges::reverse(values);
  const Triangulation t = delaunay(sites, options);
  if (!t.duplicates().empty()) return;  // which value counts depends on the order
  const Bands found = bands(t, values, levels);
  require(found.bands.rows == expected.bands.rows, "the order of the sites changes nothing");
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  static const fuzz::ScratchFolder folder;
  fuzz::ByteSource source(data, size);
  const bool is_written = source.below(8) == 0;
  const std::vector<double> levels = fuzz::next_levels(source);
  std::vector<double> pool;
  for (int i = 0; i < 16; ++i) pool.push_back(fuzz::next_value(source));
  const fuzz::Scales scales = fuzz::next_scales(source);
  const std::size_t limit = fuzz::next_limit(source, 30);
  const Options options;
  const std::vector<Point> sites = fuzz::all_sites(source, limit, scales, options);
  std::vector<double> values;
  for (std::size_t i = 0; i < sites.size(); ++i) values.push_back(pool[i * i / 3 % pool.size()]);
  const Triangulation t = delaunay(sites, options);
  const auto infinite =
      std::ranges::find_if(values, [](double value) { return std::isinf(value); });
  try {
    const Isolines lines = isolines(t, values, levels);
    fuzz::require(infinite == values.end(), "infinite values are refused");
    fuzz::test_isolines(lines);
    fuzz::test_first_values(t, values);
    const Bands found = bands(t, values, levels);
    fuzz::test_bands(found);
    if (fuzz::has_clear_edges(t)) fuzz::test_area(found, bands(t, values, {}));
    fuzz::test_any_order(sites, values, options, levels, found);
    if (!is_written) return 0;
    const std::string path = folder.file("contours.geojson");
    write_isolines(path, lines, 5);
    fuzz::test_document(nlohmann::json::parse(fuzz::content(path)), levels.size());
    write_bands(path, found, 5);
    const auto written = nlohmann::json::parse(fuzz::content(path));
    fuzz::test_document(written, levels.size() + 1);
    const bool is_whole = t.dimension() == 2 && t.num_ghost_faces() == 0 &&
                          std::ranges::none_of(values, [](double v) { return std::isnan(v); });
    fuzz::require_valid(written, is_whole);
  } catch (const InvalidInput& error) {
    fuzz::require(infinite != values.end() &&
                      error.index() == static_cast<std::size_t>(infinite - values.begin()),
                  "the first infinite value is named");
  }
  return 0;
}
