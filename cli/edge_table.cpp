// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "edge_table.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>

#include "validate.h"

namespace rondel::cli {
namespace {

// Returns the site in a cell. Throws FileError, which begins with the place.
Index site_in(std::string_view text, std::size_t num_sites, const std::string& place) {
  const std::string shown = place + ": '" + std::string(text) + "' ";
  const auto first = text.find_first_not_of(" \t");
  if (first != std::string_view::npos) {
    text = text.substr(first, text.find_last_not_of(" \t\r") + 1 - first);
  }
  if (text.size() > 2 && text.starts_with('"') && text.ends_with('"')) {
    text = text.substr(1, text.size() - 2);
  }
  std::uint64_t site = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), site);
  if (text.empty() || end != text.data() + text.size() || error == std::errc::invalid_argument) {
    throw FileError(shown + "is no index of a site");
  }
  if (error != std::errc() || site >= num_sites) {
    throw FileError(shown + "is no site; there " + (num_sites == 1 ? "is " : "are ") +
                    count(num_sites, "site", "sites") + ", counted from 0");
  }
  return static_cast<Index>(site);
}

// Reads the whole of a file. Throws FileError.
std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file.is_open()) throw FileError(path, std::error_code(errno, std::generic_category()));
  std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (file && !std::filesystem::is_directory(path)) return text;
  throw FileError(path + ": the file cannot be read");
}

}  // namespace

EdgeTable read_edge_table(const std::string& path, const SiteTable& sites) {
  if (sites.num_unlocated > 0) {
    throw FileError(path + ": it counts the rows of " + sites.name + ", of which " +
                    count(sites.num_unlocated, "has", "have") + " no place; remove " +
                    (sites.num_unlocated > 1 ? "these" : "this one") + " first");
  }
  const std::size_t num_sites = sites.sites.size();
  const std::string text = text_of(path);
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw FileError(path + ": the file is empty");
  }
  EdgeTable table;
  std::size_t begin = 0;
  for (std::size_t number = 1; begin < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line = std::string_view(text).substr(begin, end - begin);
    begin = end + 1;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.find_first_not_of(" \t") == std::string_view::npos) continue;
    const std::string place = path + ":" + std::to_string(number);
    const auto columns = parts_at_comma(line);
    if (!columns) throw FileError(place + ": '" + std::string(line) + "' is not two columns");
    const bool has_digits = line.find_first_of("0123456789") != std::string_view::npos;
    if (number == 1 && !has_digits) continue;
    table.constraints.push_back(
        {site_in(columns->first, num_sites, place), site_in(columns->second, num_sites, place)});
    table.places.push_back(place);
  }
  return table;
}

void require_edge_table(const std::string& path) {
  if (format_of({path, {}}) == "csv") return;
  throw UsageError("--constraints: '" + path + "' must be a .csv file");
}

void refuse_edges(const CrossingConstraints& error, const EdgeTable& edges,
                  const std::string& hint) {
  const auto [first, second] = error.constraints();
  char place[80];
  std::snprintf(place, sizeof place, "longitude %.9g, latitude %.9g", error.place().lon_deg,
                error.place().lat_deg);
  throw FileError(edges.places[second] + " crosses " + edges.places[first] + " at " + place + hint);
}

void refuse_edges(const InvalidInput& error, const EdgeTable& edges, const std::string& sites) {
  const std::string text = error.what();
  const bool has_place = text.starts_with("constraint ") && error.index() < edges.places.size();
  throw FileError((has_place ? edges.places[error.index()] : sites) + ": " + text);
}

}  // namespace rondel::cli
