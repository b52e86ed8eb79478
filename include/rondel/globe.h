// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// A globe to turn in the browser (target rondel::globe): one page of HTML that needs nothing else,
/// neither a server nor a network. Whoever opens it can turn and zoom, down to centimetres,
/// pick sites, cells and triangles, search, choose what is shown, and save a picture.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rondel/contours.h"
#include "rondel/diagram.h"
#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel {

/// Coasts as lines of longitude and latitude: line k is `positions[offsets[k]] ... positions[offsets[k+1]-1]`.
/// Longitudes go on beyond 180 degrees where a line does.
struct CoastLines {
  std::vector<LonLat> positions;
  std::vector<std::uint64_t> offsets = {0};
};

/// The coasts of Natural Earth at 1:110 million, which globes show: 126 closed lines, in hundredths of a degree.
/// The last position of a line is its first, or, around the south pole, a turn away from it.
RONDEL_API CoastLines coast_lines();

/// Which lines a globe shows at first.
enum class GlobeLines : std::uint8_t { delaunay, voronoi, both };

/// What the colors of a globe's cells mean at first.
enum class GlobeFill : std::uint8_t { none, area, values };

/// What a globe shows when it is opened; all of it can be switched in the page.
struct GlobeOptions {
  std::string title = "Globe";
  GlobeLines lines = GlobeLines::delaunay;
  GlobeFill fill = GlobeFill::none;
  bool show_sites = true;
  bool show_circles = false;  ///< those of weighted sites
  bool show_coast = true;
  double graticule_deg = 30;     ///< between meridians; 0: none at first
  std::optional<LonLat> view{};  ///< in the middle of the whole globe; none: the sites, near enough
  double up_deg = 0;             ///< the direction that points up, clockwise from north
  std::string value_name = "Value";
  const Isolines* isolines = nullptr;  ///< drawn over the cells, as isolines() gives them
  std::span<const double> values{};  ///< one of each site, or empty; what is not finite is no value
};

/// The page. It carries the sites, the faces, the diagram and the columns of the table, compressed;
/// of 2,000 sites it has 240 KB, a million sites take 70 MB. Any triangulation has a page,
/// also one without faces or sites.
/// \throws InvalidInput if sites, diagram and values are not those of one triangulation, the arrays of the
///         isolines do not fit together, or an option is not finite.
RONDEL_API std::string globe_page(const SiteTable& table, const Triangulation& triangulation,
                                  const Diagram& diagram, const GlobeOptions& options = {},
                                  const Execution& execution = {});

/// Writes globe_page() to a file, all or nothing; "-" is standard output. \throws FileError also.
RONDEL_API void write_globe(const std::string& path, const SiteTable& table,
                            const Triangulation& triangulation, const Diagram& diagram,
                            const GlobeOptions& options = {}, const Execution& execution = {});

}  // namespace rondel
