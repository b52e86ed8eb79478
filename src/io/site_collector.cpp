// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/site_collector.h"

#include <algorithm>
#include <limits>
#include <string>

#include "io/number.h"
#include "rondel/delaunay.h"
#include "system/job.h"
#include "system/large_arrays.h"

namespace rondel::io {

void require_indices(std::uint64_t n) {
  if (n <= max_sites) return;
  throw BadValue(std::to_string(n) + " sites are more than the " + std::to_string(max_sites) +
                 " that one triangulation can hold");
}

void SiteCollector::reserve(std::size_t n, bool is_lonlat) {
  n = std::min(n, max_sites);
  system::reserve_large(table_.sites, n);
  if (is_lonlat) table_.positions.reserve(n);
}

void SiteCollector::add_position(double lon, double lat, std::uint64_t line) {
  const LonLat position = checked_position(lon, lat, options_.radians);
  note_line(line);
  table_.positions.push_back(position);
  table_.sites.push_back(unit_vector(position));
}

void SiteCollector::add_point(const Point& point, std::uint64_t line) {
  checked_point(point);
  note_line(line);
  table_.sites.push_back(point);
}

void SiteCollector::add_unlocated(bool is_lonlat, std::uint64_t line) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  note_line(line);
  if (is_lonlat) table_.positions.push_back({none, none});
  table_.sites.push_back({none, none, none});
}

void SiteCollector::make_circle(double radius) {
  const double radius_deg = checked_radius(radius, options_.radians);
  Point& site = table_.sites.back();
  site = checked_point(polar_point(site, radius_deg));
  if (table_.radii_deg.empty()) table_.radii_deg.reserve(table_.sites.capacity());
  table_.radii_deg.push_back(radius_deg);
}

// Line numbers are stored from the first site on whose line does not follow that of the site
// before.
void SiteCollector::note_line(std::uint64_t line) {
  const std::size_t n = table_.sites.size();
  require_indices(n + 1);
  if (n == 0) table_.first_line = line;
  if (table_.lines.empty()) {
    if (line == 0 || line == table_.first_line + n) return;
    table_.lines.reserve(table_.sites.capacity());
    for (std::size_t i = 0; i < n; ++i) table_.lines.push_back(table_.first_line + i);
  }
  table_.lines.push_back(line);
}

void SiteCollector::report_progress(std::size_t done, std::size_t total) const {
  constexpr std::size_t interval = 65536;
  if (size() % interval != 0) return;
  system::announce(options_, "read", done, total);
}

}  // namespace rondel::io
