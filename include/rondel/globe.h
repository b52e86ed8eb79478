// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// An interactive globe in the browser (target rondel::geo): one page of HTML that needs neither
/// a server nor a network. Its reader can turn the globe and zoom in down to centimetres, pick
/// sites, cells and triangles, search, choose what is shown, and save a picture.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rondel/compressed_rows.h"
#include "rondel/contours.h"
#include "rondel/diagram.h"
#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel {

/// Returns the coasts of Natural Earth at 1:110 million, which globes show: 126 closed lines, a row
/// each, in hundredths of a degree. Longitudes exceed 180 degrees where a line crosses the
/// antimeridian. The last position of a line equals its first, or, around the south pole, is 360
/// degrees from it.
RONDEL_API CompressedRows<LonLat> coast_lines();

/// The lines that a globe shows when it is opened.
enum class GlobeLines : std::uint8_t { delaunay, voronoi, both };

/// Returns the name of a value: "delaunay", "voronoi", "both"; empty for other numbers.
RONDEL_API std::string_view name_of(GlobeLines lines) noexcept;

/// The meaning of the colors of a globe's cells when it is opened.
enum class GlobeFill : std::uint8_t { none, area, values };

/// Returns the name of a value: "none", "area", "values"; empty for other numbers.
RONDEL_API std::string_view name_of(GlobeFill fill) noexcept;

/// What a globe shows when it is opened; all of it can be changed in the page.
struct GlobeOptions {
  std::string title = "Globe";
  GlobeLines lines = GlobeLines::delaunay;
  GlobeFill fill = GlobeFill::none;
  bool show_sites = true;
  bool show_circles = false;  ///< the circles of weighted sites
  bool show_coast = true;
  double graticule_deg = 30;  ///< distance of the drawn meridians and parallels; 0: none
  /// The middle of the picture, with the whole globe in view; if empty, the view is filled by the
  /// sites.
  std::optional<LonLat> view{};
  double up_deg = 0;  ///< the direction that points up, clockwise from north
  std::string value_name = "Value";
  const Isolines* isolines = nullptr;  ///< drawn over the cells; null: none
  /// One value for each site, or empty; a value that is not finite is missing.
  std::span<const double> values{};
};

/// Returns the page. It has the sites, the faces, the diagram and the columns of the table,
/// compressed: 240 KB for 2,000 sites, 70 MB for a million. Any triangulation has a page, also one
/// without faces or sites.
/// \throws InvalidInput if sites, diagram and values do not belong to one triangulation, the arrays
///         of the isolines do not fit together, or an option is not finite.
RONDEL_API std::string globe_page(const SiteTable& table, const Triangulation& triangulation,
                                  const Diagram& diagram, const GlobeOptions& options = {},
                                  const Execution& execution = {});

/// Writes globe_page() to a file, completely or not at all; "-" is standard output. \throws
/// FileError also.
RONDEL_API void write_globe(const FileName& file, const SiteTable& table,
                            const Triangulation& triangulation, const Diagram& diagram,
                            const GlobeOptions& options = {}, const Execution& execution = {});

}  // namespace rondel
