// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Tables of names: coordinates, bounds, connectivities and dimensions as CF and models call them.
// They decide only where the attributes of a variable do not. What attributes say is in
// cf_coordinates.cpp, units are in cf_units.cpp.
#include "formats/cf_names.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <sstream>
#include <string>
#include <vector>

namespace rondel::formats {
namespace {

// A pair of names that models give to longitudes and latitudes.
struct KnownNames {
  std::string_view lon;
  std::string_view lat;
};
// Names in lower case: plain ones, and those of NEMO, ROMS, POP and CICE, MOM6, WRF and its
// preprocessor, NEMO's mesh masks, ICON, MPAS, SCRIP.
constexpr std::array known_names = {
    KnownNames{"lon", "lat"},
    KnownNames{"longitude", "latitude"},
    KnownNames{"lons", "lats"},
    KnownNames{"longitudes", "latitudes"},
    KnownNames{"nav_lon", "nav_lat"},
    KnownNames{"lon_rho", "lat_rho"},
    KnownNames{"tlong", "tlat"},
    KnownNames{"tlon", "tlat"},
    KnownNames{"geolon", "geolat"},
    KnownNames{"xlong", "xlat"},
    KnownNames{"xlong_m", "xlat_m"},
    KnownNames{"glamt", "gphit"},
    KnownNames{"clon", "clat"},
    KnownNames{"loncell", "latcell"},
    KnownNames{"grid_center_lon", "grid_center_lat"},
};

// MPAS and ICON give their coordinates in radians, and not all of their files have units.
constexpr std::array<std::string_view, 12> names_in_radians = {
    "lonCell", "latCell", "lonVertex", "latVertex", "lonEdge", "latEdge",
    "clon",    "clat",    "vlon",      "vlat",      "elon",    "elat"};

// The usual names of bounds: "lon_bnds", or "corner_lon".
constexpr std::array<std::string_view, 5> bounds_endings = {"_bnds", "_bounds", "_b", "_vertices",
                                                            "_corners"};
constexpr std::string_view bounds_beginning = "corner_";

}  // namespace

bool is_known_name(std::string_view name, CoordinateKind kind) {
  const std::string lower = lower_case(name);
  return std::ranges::any_of(known_names, [&](const KnownNames& names) {
    return lower == (kind == CoordinateKind::lon ? names.lon : names.lat);
  });
}

bool is_name_of_places(std::string_view name, CoordinateKind kind) {
  const std::string_view of_mom = kind == CoordinateKind::lon ? "geolon" : "geolat";
  return is_known_name(name, kind) || is_name_of_part(name, kind) ||
         lower_case(name).starts_with(of_mom);
}

bool is_named_like_degrees(const VariableHeader& variable) {
  const std::string name = lower_case(variable.name);
  if (name.ends_with('_') || !degrees_per_unit(variable.text("units"))) return false;
  constexpr std::array<std::string_view, 9> words = {
      "lon", "lat", "long", "longitude", "latitude", "lons", "lats", "longitudes", "latitudes"};
  const auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
  for (auto begin = name.begin(); begin != name.end();) {
    begin = std::find_if(begin, name.end(), is_letter);
    const auto end = std::find_if_not(begin, name.end(), is_letter);
    const std::string_view run(name.data() + (begin - name.begin()),
                               static_cast<std::size_t>(end - begin));
    if (run.starts_with("lon") || run.starts_with("lat")) return true;
    if (std::ranges::any_of(words, [&](std::string_view word) { return run.ends_with(word); })) {
      return true;
    }
    begin = end;
  }
  return false;
}

bool is_name_of_part(std::string_view name, CoordinateKind kind) {
  constexpr std::array names = {KnownNames{"lonVertex", "latVertex"},
                                KnownNames{"lonEdge", "latEdge"}, KnownNames{"vlon", "vlat"},
                                KnownNames{"elon", "elat"}};
  return std::ranges::any_of(names, [&](const KnownNames& pair) {
    return name == (kind == CoordinateKind::lon ? pair.lon : pair.lat);
  });
}

bool is_in_radians(std::string_view name) {
  return std::ranges::find(names_in_radians, name) != names_in_radians.end();
}

bool is_rotated_or_projected(const VariableHeader& variable) {
  constexpr std::array<std::string_view, 6> names = {"grid_longitude",
                                                     "grid_latitude",
                                                     "projection_x_coordinate",
                                                     "projection_y_coordinate",
                                                     "projection_x_angular_coordinate",
                                                     "projection_y_angular_coordinate"};
  return std::ranges::find(names, variable.text("standard_name")) != names.end();
}

std::string remark_on_rotation(const VariableHeader& variable) {
  return "'" + variable.name + "' has the standard_name '" + variable.text("standard_name") +
         "': coordinates of a rotated pole or a projection are no longitudes and latitudes";
}

bool are_partners(std::string_view lon, std::string_view lat) {
  // The longer words come first, since "long" is the beginning of "longitude".
  constexpr std::array<KnownNames, 4> words = {KnownNames{"longitude", "latitude"},
                                               KnownNames{"glam", "gphi"},
                                               KnownNames{"long", "lat"}, KnownNames{"lon", "lat"}};
  const std::string of_lon = lower_case(lon);
  for (const KnownNames& word : words) {
    const std::size_t at = of_lon.find(word.lon);
    if (at == std::string::npos) continue;
    std::string other = of_lon;
    return lower_case(lat) == other.replace(at, word.lon.size(), word.lat);
  }
  return false;
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

bool is_connectivity(const VariableHeader& variable) {
  const std::string_view name = variable.name;
  const bool is_of_mpas = name.ends_with("OnCell") || name.ends_with("OnVertex") ||
                          name.ends_with("OnEdge") ||
                          (name.starts_with("indexTo") && name.ends_with("ID"));
  // Fields such as leaf_area_index have the ending of parent_cell_index, too.
  const bool is_of_icon = name.ends_with("_of_cell") || name.ends_with("cell_index") ||
                          name.ends_with("edge_index") || name.ends_with("vertex_index");
  return is_of_mpas || is_of_icon || variable.text("cf_role").ends_with("_connectivity");
}

bool is_name_of_bounds(std::string_view name, std::string_view coordinate) {
  if (name.starts_with(bounds_beginning)) {
    return name.substr(bounds_beginning.size()) == coordinate;
  }
  return name.starts_with(coordinate) &&
         std::ranges::find(bounds_endings, name.substr(coordinate.size())) != bounds_endings.end();
}

std::vector<std::string> usual_names_of_bounds(std::string_view coordinate) {
  std::vector<std::string> names;
  for (const std::string_view ending : bounds_endings) {
    names.push_back(std::string(coordinate) += ending);
    // A coordinate that begins as bounds do has no bounds of that ending.
    if (!is_name_of_bounds(names.back(), coordinate)) names.pop_back();
  }
  names.push_back(std::string(bounds_beginning) += coordinate);
  return names;
}

std::vector<std::string_view> usual_coordinates_of_bounds(std::string_view name) {
  if (name.starts_with(bounds_beginning)) return {name.substr(bounds_beginning.size())};
  std::vector<std::string_view> coordinates;
  for (const std::string_view ending : bounds_endings) {
    if (name.ends_with(ending)) coordinates.push_back(name.substr(0, name.size() - ending.size()));
  }
  return coordinates;
}

std::string text_of_others(std::vector<std::string> grids) {
  std::ranges::sort(grids);
  grids.erase(std::unique(grids.begin(), grids.end()), grids.end());
  std::string text;
  constexpr std::size_t most = 3;
  for (std::size_t k = 0; k < grids.size() && k < most; ++k) {
    text += (k == 0 ? "" : ", ") + grids[k];
  }
  return grids.size() > most ? text + " and more" : text;
}

}  // namespace rondel::formats

namespace rondel {

bool is_name_of_cells(std::string_view dimension) {
  // These are the names in files of MPAS, ICON, CAM, UGRID, SCRIP and ESMF.
  constexpr std::array<std::string_view, 9> names = {"nCells",    "ncells",       "cell",
                                                     "ncol",      "n_face",       "nMesh2_face",
                                                     "grid_size", "elementCount", "cells"};
  return std::ranges::find(names, dimension) != names.end();
}

std::vector<std::size_t> dimensions_of_cells(std::span<const std::string> names,
                                             std::span<const std::uint64_t> lengths,
                                             std::uint64_t num_cells) {
  std::vector<std::size_t> named;
  std::vector<std::size_t> others;
  for (std::size_t d = 0; d < names.size(); ++d) {
    if (lengths[d] == num_cells) (is_name_of_cells(names[d]) ? named : others).push_back(d);
  }
  if (!named.empty()) return named;
  if (others.size() > 1) std::erase_if(others, [&](auto d) { return is_name_of_time(names[d]); });
  return others;
}

bool is_name_of_time(std::string_view dimension) {
  const std::string lower = formats::lower_case(dimension);
  // NEMO has time_counter, ROMS ocean_time.
  return lower == "time" || lower == "t" || lower == "times" || lower == "ntime" ||
         lower == "time_counter" || lower == "ocean_time" || lower == "record";
}

}  // namespace rondel
