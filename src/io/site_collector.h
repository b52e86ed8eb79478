// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The parts that the readers of sites share: checks, unit vectors, lines and progress.
//
// in    coordinates of sites, as a file has them
// out   a SiteTable
// index sites in the order in which they are added
#pragma once

#include <cstddef>
#include <cstdint>

#include "io/site_formats.h"

namespace rondel::io {

// Throws BadValue if n sites are too many for a triangulation. Call it before any of them is read.
void require_indices(std::uint64_t n);

class SiteCollector {
 public:
  // Fills `table`, whose name has been set.
  SiteCollector(SiteTable& table, const ReadJob& options) : table_(table), options_(options) {}

  // Reserves memory for n sites, at most for as many as a triangulation can have.
  void reserve(std::size_t n, bool is_lonlat);

  // Adds the next site, which is in `line` (0 if the format has no lines). Throws BadValue if it is
  // not valid.
  void add_position(double lon, double lat, std::uint64_t line);
  // Adds a site without a place: its coordinates are NaN.
  void add_unlocated(bool is_lonlat, std::uint64_t line);
  void add_point(const Point& point, std::uint64_t line);

  // Turns the site just added into a circle with that radius. Throws BadValue if the radius is not
  // valid.
  void make_circle(double radius);

  // Reports, now and then, that `done` of `total` has been read.
  void report_progress(std::size_t done, std::size_t total) const;

  [[nodiscard]] std::size_t size() const noexcept { return table_.sites.size(); }

 private:
  void note_line(std::uint64_t line);

  SiteTable& table_;
  const ReadJob& options_;
};

}  // namespace rondel::io
