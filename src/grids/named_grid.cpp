// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include "exact/angles.h"
#include "exact/vector.h"
#include "grids/formula_cells.h"
#include "grids/gaussian_lines.h"
#include "grids/grid_formula.h"
#include "io/bad_value.h"
#include "io/number.h"
#include "meshing/point_rings.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/extrapolate.h"
#include "rondel/named_grids.h"
#include "rondel/query.h"
#include "system/arithmetic.h"
#include "system/job.h"
#include "system/message_text.h"

namespace rondel {
namespace {

// The largest grids of each kind: with more cells, or rows, indices or tables would not fit.
constexpr std::uint64_t max_parallels = 1'000'000;
constexpr std::uint64_t max_healpix_order = 13;
constexpr std::uint64_t max_gaussian = 8000;
constexpr std::uint64_t max_cube_side = 20'000;
constexpr std::uint64_t max_root = 100;
constexpr double min_tripolar_columns = 12;
constexpr double max_tripolar_columns = 60'000;

// The names of kinds of grids, before what says which one.
constexpr std::string_view global_kind = "grid:";
constexpr std::string_view healpix_kind = "healpix:";
constexpr std::string_view healpix_text = "healpix";  // of attributes
constexpr std::string_view hexagon_kind = "hexagons:";
constexpr std::string_view tripolar_kind = "tripolar:";

[[noreturn]] void refuse(std::string_view name, const std::string& why) {
  throw InvalidInput("'" + std::string(name) + "' is no grid: " + why);
}

// Returns the whole number that a text is, or nothing.
std::optional<std::uint64_t> number_of(std::string_view text) {
  std::uint64_t number = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_whole = read.ec == std::errc() && read.ptr == text.data() + text.size();
  return is_whole && !text.empty() ? std::optional(number) : std::nullopt;
}

// Returns the number that a text is if it is in a range. `name` and `what` are for the message.
std::uint64_t number_in(std::string_view text, std::uint64_t least, std::uint64_t most,
                        std::string_view name, const char* what) {
  const auto number = number_of(text);
  if (number && *number >= least && *number <= most) return *number;
  refuse(name,
         std::string(what) + " is from " + std::to_string(least) + " to " + std::to_string(most));
}

// Returns how many steps, as a text has them, an angle consists of; 0 if they are no whole number. The
// quotient may be off by one ulp of the step, such as 0.1, and by the rounding of the division.
double whole_steps(double angle, std::string_view text) {
  double step = 0;
  try {
    step = io::parse_number(text, "the step");
  } catch (const io::BadValue&) {
    return 0;
  }
  if (!(step > 0)) return 0;
  const double count = angle / step;
  const double whole = std::round(count);
  return std::abs(count - whole) <= count * 0x1p-50 ? whole : 0;
}

// Returns the grid that the text after "grid:" describes.
GlobalGrid global_grid(std::string_view text, std::string_view name) {
  constexpr const char* why =
      "grid:DEG divides 180 degrees into equal parts, at most 1000000 of them, grid:NLONxNLAT has "
      "NLON by NLAT cells";
  if (const std::size_t cross = text.find('x'); cross != std::string_view::npos) {
    const auto num_lon = number_of(text.substr(0, cross));
    const auto num_lat = number_of(text.substr(cross + 1));
    const bool is_good = num_lon && num_lat && *num_lon >= 1 && *num_lon <= 2 * max_parallels &&
                         *num_lat >= 1 && *num_lat <= max_parallels;
    if (!is_good) refuse(name, why);
    return {*num_lon, *num_lat};
  }
  const double whole = whole_steps(180, text);
  if (whole < 1 || whole > static_cast<double>(max_parallels)) refuse(name, why);
  const auto num_lat = static_cast<std::uint64_t>(whole);
  return {2 * num_lat, num_lat};
}

// Returns the lines and the centers of ECMWF's grid F.
std::pair<LonLatGrid, LonLatAxes> gaussian_grid(std::uint64_t number) {
  const std::uint64_t num_lon = 4 * number;
  LonLatAxes axes;
  axes.lat_deg = grids::gaussian_latitudes(number);
  LonLatGrid lines;
  lines.lat_deg = grids::lines_between(axes.lat_deg);
  for (std::uint64_t i = 0; i <= num_lon; ++i) {
    const double step = static_cast<double>(i);
    if (i < num_lon) axes.lon_deg.push_back(360 * step / static_cast<double>(num_lon));
    lines.lon_deg.push_back(360 * (step - 0.5) / static_cast<double>(num_lon));
  }
  return {std::move(lines), std::move(axes)};
}

std::string in_lower_case(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

// Returns the pixels that the text after "healpix:" describes.
std::unique_ptr<grids::GridFormula> healpix(std::string_view text, std::string_view name,
                                            GridSides sides) {
  const std::size_t colon = text.find(':');
  const std::string scheme = colon == std::string_view::npos
                                 ? "nested"
                                 : in_lower_case(std::string(text.substr(colon + 1)));
  if (scheme != "nested" && scheme != "ring") refuse(name, "the order is nested or ring");
  const auto order = static_cast<unsigned>(
      number_in(text.substr(0, colon), 0, max_healpix_order, name, "the level of HEALPix"));
  return grids::healpix_grid(order, scheme == "ring", sides);
}

// How the sides of an icosahedron are divided.
struct IcosahedronParts {
  unsigned root;
  unsigned bisections;
};

bool is_digits(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

// True for "R2B6", with any numbers.
bool names_icosahedron(std::string_view text) {
  const std::size_t b = text.find('B');
  return text.starts_with('R') && b != std::string_view::npos && is_digits(text.substr(1, b - 1)) &&
         is_digits(text.substr(b + 1));
}

// Returns what "R2B6" says; the text may be a part of the name.
IcosahedronParts icosahedron_parts(std::string_view text, std::string_view name) {
  if (!names_icosahedron(text)) refuse(name, "hexagons:R2B6 is such a name, with any numbers");
  const std::size_t b = text.find('B');
  const std::uint64_t root =
      number_in(text.substr(1, b - 1), 1, max_root, name, "the division of the sides");
  const std::uint64_t bisections =
      number_in(text.substr(b + 1), 0, 15, name, "the number of bisections");
  if (20 * root * root << (2 * bisections) >= no_index) refuse(name, "it has too many cells");
  return {static_cast<unsigned>(root), static_cast<unsigned>(bisections)};
}

// Returns the tripolar grid that the text after "tripolar:" describes.
std::unique_ptr<grids::GridFormula> tripolar(std::string_view text, std::string_view name) {
  const double columns = whole_steps(360, text);
  if (!(columns >= min_tripolar_columns) || columns > max_tripolar_columns ||
      std::fmod(columns, 4) != 0) {
    refuse(name, "tripolar:DEG divides 360 degrees into 12 to 60000 columns, a multiple of 4");
  }
  return grids::tripolar_grid(static_cast<unsigned>(columns));
}

std::vector<Index> octahedral_counts(std::size_t number) {
  std::vector<Index> counts;
  for (std::size_t row = 0; row < 2 * number; ++row) {
    counts.push_back(static_cast<Index>(mesh::octahedral_count(number, row)));
  }
  return counts;
}

// Returns the cells of a grid other than `grid:` and `F`.
std::unique_ptr<grids::GridFormula> formula_of(std::string_view name, GridSides sides) {
  const auto after = [&](std::string_view kind) { return name.substr(kind.size()); };
  if (name.starts_with(healpix_kind)) return healpix(after(healpix_kind), name, sides);
  if (name.starts_with(tripolar_kind)) return tripolar(after(tripolar_kind), name);
  if (name.starts_with(hexagon_kind)) {
    const IcosahedronParts parts = icosahedron_parts(after(hexagon_kind), name);
    return grids::hexagon_grid(parts.root, parts.bisections);
  }
  const std::string_view number = name.substr(1);
  switch (name.front()) {
    case 'R': {
      const IcosahedronParts parts = icosahedron_parts(name, name);
      return grids::triangle_grid(parts.root, parts.bisections);
    }
    case 'C':
      return grids::cubed_sphere_grid(static_cast<unsigned>(
          number_in(number, 1, max_cube_side, name, "the number of cells along a face")));
    case 'O':
      return grids::reduced_gaussian_grid(octahedral_counts(
          number_in(number, 1, max_gaussian, name, "the number of latitudes of a hemisphere")));
    default: {
      std::vector<Index> counts = grids::counts_of_reduced(static_cast<unsigned>(
          number_in(number, 1, max_gaussian, name, "the number of latitudes of a hemisphere")));
      if (counts.empty()) refuse(name, "N is one of " + grids::numbers_of_reduced());
      return grids::reduced_gaussian_grid(std::move(counts));
    }
  }
}

std::string text_of(const GridMapping& attributes, std::string_view name) {
  for (const auto& [key, text] : attributes.texts) {
    if (key == name) return text;
  }
  return {};
}

// Returns a number, or -1 if there is none.
double number_of(const GridMapping& attributes, std::string_view name) {
  for (const auto& [key, number] : attributes.numbers) {
    if (key == name) return number;
  }
  return -1;
}

bool is_of_pixels(const GridMapping& attributes) {
  return in_lower_case(text_of(attributes, "grid_mapping_name")) == healpix_text ||
         in_lower_case(text_of(attributes, "grid_name")) == healpix_text;  // as xdggs has it
}

// The attributes by which a grid mapping has a number or a text, in the order in which they count.
constexpr std::string_view level_names[] = {"refinement_level", "level"};
constexpr std::string_view side_names[] = {"healpix_nside", "nside"};
constexpr std::string_view order_names[] = {"indexing_scheme", "healpix_order"};

// Returns the first of these attributes and its number, or -1.
std::pair<std::string_view, double> first_number(const GridMapping& attributes,
                                                 std::span<const std::string_view> names) {
  for (const std::string_view name : names) {
    if (const double number = number_of(attributes, name); number >= 0) return {name, number};
  }
  return {{}, -1};
}

// Returns the level of pixels that attributes have, or -1 if they have none, or two.
int level_of(const GridMapping& attributes) {
  double level = first_number(attributes, level_names).second;
  const double side = first_number(attributes, side_names).second;
  for (unsigned k = 0; level < 0 && k <= max_healpix_order; ++k) {
    if (side == static_cast<double>(1U << k)) level = k;
  }
  if (!(level >= 0) || level > max_healpix_order || level != std::floor(level)) return -1;
  if (side >= 0 && side != std::ldexp(1, static_cast<int>(level))) return -1;
  return static_cast<int>(level);
}

// Returns the order of pixels that a word means, "ring" or "nested", or an empty text.
std::string order_named(std::string word) {
  word = in_lower_case(std::move(word));
  if (word == "ring") return word;
  return word == "nested" || word == "nest" ? "nested" : "";
}

// Returns in which order attributes say that pixels are, "ring" or "nested", or an empty text if they
// say none, or two.
std::string order_of(const GridMapping& attributes) {
  std::string order;
  for (const std::string_view name : order_names) {
    const std::string word = text_of(attributes, name);
    if (word.empty()) continue;
    const std::string own = order_named(word);
    if (own.empty() || (!order.empty() && own != order)) return {};
    order = own;
  }
  return order;
}

// Returns why attributes have no level, for lack_of_mapping().
std::string lack_of_level(const GridMapping& attributes) {
  const auto [level_name, level] = first_number(attributes, level_names);
  const auto [side_name, side] = first_number(attributes, side_names);
  if (level < 0 || side < 0) {
    return "refinement_level (0 to 13) or healpix_nside (a power of two up to 8192)";
  }
  return "level that " + std::string(level_name) + " = " + system::shortest_text(level) + " and " +
         std::string(side_name) + " = " + system::shortest_text(side) + " agree on";
}

// Returns why attributes have no order, for lack_of_mapping().
std::string lack_of_order(const GridMapping& attributes) {
  const std::string scheme = text_of(attributes, order_names[0]);
  const std::string order = text_of(attributes, order_names[1]);
  if (scheme.empty() && order.empty()) return "indexing_scheme or healpix_order (nested or ring)";
  if (scheme.empty() || order.empty()) {
    const bool is_scheme = order.empty();
    return "order that is read, nested or ring: its " +
           std::string(order_names[is_scheme ? 0 : 1]) + " is " +
           io::in_quotes(is_scheme ? scheme : order);
  }
  return "order that indexing_scheme = " + scheme + " and healpix_order = " + order + " agree on";
}

}  // namespace

std::string grid_named_by(const GridMapping& attributes) {
  if (std::string name = text_of(attributes, grid_attribute); NamedGrid::is_name(name)) return name;
  if (!is_of_pixels(attributes)) return {};
  const int level = level_of(attributes);
  const std::string order = order_of(attributes);
  if (level < 0 || order.empty()) return {};
  return "healpix:" + std::to_string(level) + ":" + order;
}

std::string lack_of_mapping(const GridMapping& attributes) {
  if (!is_of_pixels(attributes)) return {};
  std::string lack;
  if (level_of(attributes) < 0) lack = lack_of_level(attributes);
  if (order_of(attributes).empty()) {
    lack += (lack.empty() ? "" : ", and ") + lack_of_order(attributes);
  }
  return lack;
}

bool NamedGrid::is_name(std::string_view text) {
  for (const std::string_view kind : {global_kind, healpix_kind, hexagon_kind, tripolar_kind}) {
    if (text.starts_with(kind)) return true;
  }
  if (text.size() < 2 || names_icosahedron(text)) return text.size() >= 2;
  const std::string_view rest = text.substr(1);
  return std::string_view("FNOC").find(text.front()) != std::string_view::npos && is_digits(rest);
}

std::string_view NamedGrid::forms() {
  return "grid:DEG, grid:NLONxNLAT, healpix:7, healpix:7:ring, F320, N320, O320, C384, R2B6, "
         "hexagons:R2B6 and tripolar:DEG";
}

NamedGrid::NamedGrid(std::string_view name, GridSides sides)
    : name_(name.starts_with(healpix_kind) ? in_lower_case(std::string(name)) : name),
      sides_(sides) {
  const system::ArithmeticScope arithmetic;
  if (!is_name(name)) {
    refuse(name, "grids are " + std::string(forms()) + ", with any numbers");
  }
  if (name.starts_with(global_kind)) {
    const GlobalGrid grid = global_grid(name.substr(global_kind.size()), name);
    if (grid.num_lon >= no_index / grid.num_lat) refuse(name, "it has too many cells");
    lines_ = grid.lines();
    axes_ = grid.centers();
  } else if (name.front() == 'F') {
    std::tie(lines_, axes_) = gaussian_grid(number_in(name.substr(1), 1, max_gaussian, name,
                                                      "the number of latitudes of a hemisphere"));
  } else {
    formula_ = formula_of(name, sides);
  }
  if (axes_) shape_ = {axes_->lat_deg.size(), axes_->lon_deg.size()};
  if (formula_) shape_ = formula_->shape();
  num_cells_ = 1;
  for (const std::uint64_t length : shape_) num_cells_ *= length;
}

bool NamedGrid::covers_sphere() const { return !formula_ || formula_->covers_sphere(); }

LonLat NamedGrid::center(std::size_t cell) const {
  const system::ArithmeticScope arithmetic;
  return axes_ ? axes_->place(cell) : formula_->center(static_cast<Index>(cell));
}

std::vector<LonLat> NamedGrid::centers() const {
  const system::ArithmeticScope arithmetic;
  if (axes_) return axes_->places();
  std::vector<LonLat> centers(num_cells_);
  for (std::size_t i = 0; i < num_cells_; ++i) {
    centers[i] = formula_->center(static_cast<Index>(i));
  }
  return centers;
}

GridMapping NamedGrid::mapping() const {
  if (name_.starts_with(global_kind)) return {};
  if (!name_.starts_with(healpix_kind)) return {{{grid_attribute, name_}}, {}};
  const std::string level =
      name_.substr(healpix_kind.size(), name_.find(':', healpix_kind.size()) - healpix_kind.size());
  const bool is_in_rings = name_.ends_with(":ring");
  const auto order = *number_of(level);
  // The last two are those that tools for HEALPix had before.
  return {{{"grid_mapping_name", "healpix"},
           {"indexing_scheme", is_in_rings ? "ring" : "nested"},
           {"healpix_order", is_in_rings ? "ring" : "nest"}},
          {{"refinement_level", static_cast<double>(order)},
           {"healpix_nside", static_cast<double>(std::uint64_t{1} << order)}}};
}

CellSet NamedGrid::cells(const Execution& execution) const {
  const system::Call call(execution);
  if (!lines_) {
    std::vector<Index> all(num_cells_);
    std::iota(all.begin(), all.end(), Index{0});
    CellSet cells = grids::cells_of(*formula_, all, execution);
    return cells.with_facts({.name = name_, .centers = centers(), .shape = shape_});
  }
  const CellSet cells = CellSet::lonlat_grid(*lines_, sides_, execution);
  CellFacts facts = cells.facts();
  facts.name = name_;
  facts.axes = *axes_;
  return cells.with_facts(std::move(facts));
}

CellSet NamedGrid::cells(std::span<const Index> numbers, const Execution& execution) const {
  const system::Call call(execution);
  if (!formula_) throw InvalidInput("the cells of '" + name_ + "' are between lines");
  std::vector<bool> is_there(num_cells_);
  CellFacts facts;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const Index number = numbers[k];
    if (number >= num_cells_ || is_there[number]) {
      throw InvalidInput(number < num_cells_
                             ? "the cell " + std::to_string(number) + " is there twice"
                             : "'" + name_ + "' has no cell " + std::to_string(number),
                         k);
    }
    is_there[number] = true;
    facts.centers.push_back(formula_->center(number));
  }
  facts.name = "cells of " + name_;  // a name of its own, as it is not that grid
  facts.shape = {numbers.size()};
  return grids::cells_of(*formula_, numbers, execution).with_facts(std::move(facts));
}

std::vector<Index> NamedGrid::numbers_at(std::span<const LonLat> places, double max_apart_deg,
                                         const Execution& execution) const {
  const system::Call call(execution);
  if (!formula_ || places.empty() || places.size() > num_cells_) return {};
  const std::vector<Point> sites = unit_vectors(centers());
  const std::vector<Point> points = known_unit_vectors(places);
  std::vector<Index> nearest = Locator(delaunay(sites, {}, execution)).nearest(points, execution);
  const double max_apart = max_apart_deg / exact::degrees_per_radian;
  std::vector<bool> is_there(num_cells_);
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Point apart = points[k] - sites[nearest[k]];
    const bool is_known = std::isfinite(places[k].lon_deg) && std::isfinite(places[k].lat_deg);
    if (!is_known || is_there[nearest[k]] || dot(apart, apart) > max_apart * max_apart) return {};
    is_there[nearest[k]] = true;
  }
  return nearest;
}

}  // namespace rondel
