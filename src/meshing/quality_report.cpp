// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "rondel/error.h"
#include "rondel/mesh_quality.h"
#include "system/message_text.h"

namespace rondel::mesh {
namespace {

// A number of the report: its key in JSON, and its name in the text.
struct ReportEntry {
  const char* key;
  const char* what;
  const char* place;  // "cell", "edge" or "vertex"; null for a number of the whole mesh
  Extremum (*worst)(const Quality&);
};

// These three read one number of the report, with the element where it is found, if there is one.
template <double Quality::*member>
Extremum number(const Quality& quality) {
  return {quality.*member, no_index};
}
template <Extremum Quality::*member>
Extremum worst(const Quality& quality) {
  return quality.*member;
}
template <std::size_t i>
Extremum range(const Quality& quality) {
  return {quality.spacing_range[i], no_index};
}

// The order of the entries is that of the text and of the JSON object.
constexpr std::array entries = {
    ReportEntry{"energy", "energy over that of hexagons", nullptr, number<&Quality::energy>},
    ReportEntry{"mean_centroid_offset", "mean distance of site and center of mass, in spacings",
                nullptr, number<&Quality::mean_centroid_offset>},
    ReportEntry{"max_centroid_offset", "largest", "cell", worst<&Quality::max_centroid_offset>},
    ReportEntry{"min_angle_deg", "smallest angle of a triangle, degrees", "vertex",
                worst<&Quality::min_angle_deg>},
    ReportEntry{"max_angle_deg", "largest", "vertex", worst<&Quality::max_angle_deg>},
    ReportEntry{"share_40_to_80_deg", "share of angles from 40 to 80 degrees", nullptr,
                number<&Quality::share_40_to_80_deg>},
    ReportEntry{"min_edge_ratio", "shortest edge over distance of its cells (dv/dc)", "edge",
                worst<&Quality::min_edge_ratio>},
    ReportEntry{"min_side_ratio", "shortest edge of a cell over its longest", "cell",
                worst<&Quality::min_side_ratio>},
    ReportEntry{"max_distance_ratio", "farthest neighbor of a cell over its nearest", "cell",
                worst<&Quality::max_distance_ratio>},
    ReportEntry{"max_gradient", "largest change of spacing between neighbors", "edge",
                worst<&Quality::max_gradient>},
    ReportEntry{"max_staggering",
                "farthest that the middle of an edge is from the line of its sites", "edge",
                worst<&Quality::max_staggering>},
    ReportEntry{"mean_staggering", "mean", nullptr, number<&Quality::mean_staggering>},
    ReportEntry{"min_spacing", "smallest spacing, radius 1", nullptr,
                number<&Quality::min_spacing>},
    ReportEntry{"max_spacing", "largest", nullptr, number<&Quality::max_spacing>},
    ReportEntry{"spacing_5", "spacing over what the density wants: 5 of 100 cells below", nullptr,
                range<0>},
    ReportEntry{"spacing_95", "95 of 100 cells below", nullptr, range<1>},
    ReportEntry{"kite_sum_error", "sum of kites against the sphere", nullptr,
                number<&Quality::kite_sum_error>},
    ReportEntry{"cell_sum_error", "sum of cells against the sphere", nullptr,
                number<&Quality::cell_sum_error>},
    ReportEntry{"max_kite_error", "kites against their cell or triangle", nullptr,
                number<&Quality::max_kite_error>}};

// Returns the number as JSON has it, null if it is not finite.
std::string number_of(double value) {
  return std::isfinite(value) ? system::shortest_text(value) : "null";
}

std::string json_of(const Histogram& histogram) {
  std::string text = "{\"low\": " + number_of(histogram.low) +
                     ", \"high\": " + number_of(histogram.high) + ", \"counts\": [";
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    if (i > 0) text += ", ";
    text += std::to_string(histogram.counts[i]);
  }
  return text + "]}";
}

// Returns the number of cells with k edges, by k.
std::string sides_json(const Quality& quality) {
  std::string text = "{";
  for (std::size_t k = 0; k < quality.sides.size(); ++k) {
    if (quality.sides[k] == 0) continue;
    if (text.size() > 1) text += ", ";
    text += '"' + std::to_string(k) + "\": " + std::to_string(quality.sides[k]);
  }
  return text + "}";
}

std::string sides_text(const Quality& quality) {
  std::string text;
  for (std::size_t k = 0; k < quality.sides.size(); ++k) {
    if (quality.sides[k] == 0) continue;
    if (!text.empty()) text += ", ";
    text += std::to_string(quality.sides[k]) + " with " + std::to_string(k);
  }
  return text;
}

// Returns a number with six digits, for the text.
std::string short_number(double value) {
  std::array<char, 32> digits;
  std::snprintf(digits.data(), digits.size(), "%.6g", value);
  return digits.data();
}

}  // namespace

std::string quality_text(const Quality& quality) {
  std::string text = std::to_string(quality.num_cells) + " cells, " +
                     std::to_string(quality.num_edges) + " edges, " +
                     std::to_string(quality.num_vertices) + " vertices\n";
  if (quality.num_border_edges > 0) {
    text += "edges at the border: " + std::to_string(quality.num_border_edges) + '\n';
  }
  text += "edges of cells: " + sides_text(quality) + '\n';
  text += "obtuse triangles: " + std::to_string(quality.num_obtuse) + '\n';
  for (const ReportEntry& entry : entries) {
    const Extremum found = entry.worst(quality);
    if (std::isnan(found.value)) continue;
    text += std::string(entry.what) + ": " + short_number(found.value);
    if (entry.place != nullptr) {
      text += std::string(" (") + entry.place + ' ' + std::to_string(found.where) + ')';
    }
    text += '\n';
  }
  return text;
}

std::string quality_json(const Quality& quality) {
  std::string text = "{\"num_cells\": " + std::to_string(quality.num_cells) +
                     ", \"num_edges\": " + std::to_string(quality.num_edges) +
                     ", \"num_vertices\": " + std::to_string(quality.num_vertices) +
                     ", \"num_border_edges\": " + std::to_string(quality.num_border_edges) +
                     ", \"sides\": " + sides_json(quality) +
                     ", \"num_obtuse\": " + std::to_string(quality.num_obtuse);
  for (const ReportEntry& entry : entries) {
    const Extremum found = entry.worst(quality);
    text += std::string(", \"") + entry.key + "\": ";
    if (entry.place == nullptr) {
      text += number_of(found.value);
    } else {
      text += "{\"value\": " + number_of(found.value) +
              ", \"where\": " + std::to_string(found.where) + '}';
    }
  }
  return text + ", \"angles_deg\": " + json_of(quality.angles_deg) +
         ", \"edge_ratios\": " + json_of(quality.edge_ratios) +
         ", \"spacings\": " + json_of(quality.spacings) + "}\n";
}

double quality_value(const Quality& quality, std::string_view name) {
  std::string key(name);
  std::ranges::replace(key, '-', '_');
  if (key == "min_dv_dc") key = "min_edge_ratio";
  if (key == "num_border_edges") return static_cast<double>(quality.num_border_edges);
  if (key == "num_obtuse") return static_cast<double>(quality.num_obtuse);
  for (const ReportEntry& entry : entries) {
    if (key == entry.key) return entry.worst(quality).value;
  }
  throw InvalidInput("'" + std::string(name) + "' is no number of the report");
}

}  // namespace rondel::mesh
