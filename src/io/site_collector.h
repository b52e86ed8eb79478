// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What the readers of sites have in common: checks, unit vectors, lines and progress.
#pragma once

#include <cstddef>
#include <cstdint>

#include "io/site_formats.h"

namespace rondel::io {

// Throws BadValue if no triangulation can hold n sites, before any of them is read.
void require_indices(std::uint64_t n);

class SiteCollector {
 public:
  // Fills `table`, whose name is set.
  SiteCollector(SiteTable& table, const ReadJob& options) : table_(table), options_(options) {}

  // Room for n sites, as far as one triangulation can hold them.
  void reserve(std::size_t n, bool is_lonlat);

  // Adds the next site, which stands in `line` (0: the format has no lines). Throws BadValue.
  void add_position(double lon, double lat, std::uint64_t line);
  void add_point(const Point& point, std::uint64_t line);

  // Turns the site just added into the circle of that radius around it. Throws BadValue.
  void make_circle(double radius);

  // Reports, now and then, that `done` of `total` is read.
  void report_progress(std::size_t done, std::size_t total) const;

  [[nodiscard]] std::size_t size() const noexcept { return table_.sites.size(); }

 private:
  void note_line(std::uint64_t line);

  SiteTable& table_;
  const ReadJob& options_;
};

}  // namespace rondel::io
