// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds the dimensions of points by lengths and names (rules 3 and 4 of field_layout.h), for
// variables without coordinates: by_lengths(). Dimensions of length 1 make no difference, since an
// array of (1, n) has the same order of values as one of (n).
#include <algorithm>
#include <set>
#include <string>

#include "formats/cf_names.h"
#include "formats/field_layout.h"
#include "io/bad_value.h"
#include "io/number.h"
#include "system/checked_product.h"

namespace rondel::formats {
namespace {

// Returns the products of the last 0, 1, 2 ... lengths, where lengths of 1 do not count.
std::vector<std::uint64_t> products(std::span<const std::uint64_t> lengths) {
  std::vector<std::uint64_t> result = {1};
  for (std::size_t k = lengths.size(); k-- > 0;) {
    if (lengths[k] != 1) result.push_back(result.back() * lengths[k]);
  }
  return result;
}

// True if arrays of these lengths hold the same values in the same order, where one may have
// several dimensions of the other joined to one.
bool agree(std::span<const std::uint64_t> a, std::span<const std::uint64_t> b) {
  const std::vector<std::uint64_t> of_a = products(a);
  const std::vector<std::uint64_t> of_b = products(b);
  // The products of the shape (2, 3, 4) are 1, 4, 12, 24 and contain those of (6, 4), 1, 4, 24.
  return std::ranges::includes(of_a, of_b) || std::ranges::includes(of_b, of_a);
}

// Returns the dimensions that are longer than 1.
std::set<std::size_t> long_ones(std::span<const std::size_t> dimensions,
                                std::span<const std::uint64_t> lengths) {
  std::set<std::size_t> result;
  for (std::size_t k = 0; k < dimensions.size(); ++k) {
    if (lengths[k] > 1) result.insert(dimensions[k]);
  }
  return result;
}

// Returns the numbers in the file of those dimensions of a variable that are longer than 1;
// `places` are positions of dimensions in the variable.
std::set<std::size_t> long_ones_of(const io::VariableInFile& variable,
                                   std::span<const std::size_t> places) {
  std::vector<std::size_t> dimensions;
  std::vector<std::uint64_t> lengths;
  for (const std::size_t d : places) {
    dimensions.push_back(variable.dimensions[d]);
    lengths.push_back(variable.shape[d]);
  }
  return long_ones(dimensions, lengths);
}

}  // namespace

bool fit_lengths(std::span<const std::uint64_t> wanted, const io::VariableInFile& variable,
                 std::vector<std::size_t>& points) {
  if (wanted.size() < 2) return true;
  std::vector<std::uint64_t> lengths;
  lengths.reserve(points.size());
  for (const std::size_t d : points) lengths.push_back(variable.shape[d]);
  if (agree(lengths, wanted)) return true;
  std::ranges::reverse(lengths);
  std::ranges::reverse(points);
  return agree(lengths, wanted);
}

void take_other_dimensions(const io::VariableInFile& variable, FieldDimensions& layout) {
  for (std::size_t d = 0; d < variable.shape.size(); ++d) {
    if (std::ranges::count(layout.points, d) == 0) layout.leading.push_back(d);
  }
}

std::optional<FieldDimensions> FieldDimensionFinder::by_lengths(
    const io::VariableInFile& variable) {
  FieldDimensions layout;
  layout.points = run_of_points(variable);
  const std::vector<std::size_t> before = layout.points;
  if (layout.points.empty() || !fit_lengths(shape_, variable, layout.points)) return std::nullopt;
  if (!may_be_of_places(variable, layout.points)) return std::nullopt;
  if (!has_same_dimensions(variable, layout.points)) return std::nullopt;
  layout.is_reversed = layout.points != before;
  if (!orient(variable, layout)) return std::nullopt;
  take_other_dimensions(variable, layout);
  return layout;
}

// Returns the dimensions of all coordinates of the file that are as many as the points, those at
// the anchor apart from others. They are found once.
const FieldDimensionFinder::SetsOfPlaces& FieldDimensionFinder::sets_of_places() {
  if (sets_of_places_) return *sets_of_places_;
  sets_of_places_.emplace();
  for (const CoordinatePair& pair : coordinates_.pairs()) {
    const io::VariableInFile& lon = file_.variables()[pair.lon];
    const std::uint64_t most =
        pair.are_axes ? lon.num_values * file_.variables()[pair.lat].num_values : lon.num_values;
    if (!pair.is_used || most < num_points_) continue;
    try {
      const KnownPlaces& known = places_of_pair(pair);
      if (known.places.size() != num_points_ && known.num_known != num_points_) continue;
      FieldDimensions along;
      along.places = known.places;
      leave_out_missing(known, along);
      const bool is_same = !anchor_ || is_at_anchor({pair.lon, pair.lat, std::move(along)});
      (is_same ? sets_of_places_->same : sets_of_places_->other)
          .push_back(long_ones(known.dimensions, known.shape));
    } catch (const io::BadValue&) {
      continue;  // coordinates that are no places
    }
  }
  return *sets_of_places_;
}

// True if the variable may be at the points: if the file has longitudes and latitudes of them,
// values along other dimensions of the same lengths are elsewhere.
bool FieldDimensionFinder::may_be_of_places(const io::VariableInFile& variable,
                                            std::span<const std::size_t> points) {
  const SetsOfPlaces& sets = sets_of_places();
  const DimensionSet own = long_ones_of(variable, points);
  if (std::ranges::count(sets.same, own) != 0) return true;
  return sets.same.empty() && std::ranges::count(sets.other, own) == 0;
}

// True if the variable has the points along the same dimensions as the variables before it, as it
// must where the file has no longitudes and latitudes of them.
bool FieldDimensionFinder::has_same_dimensions(const io::VariableInFile& variable,
                                               std::span<const std::size_t> points) {
  if (!sets_of_places().same.empty()) return true;
  DimensionSet own = long_ones_of(variable, points);
  if (!dimensions_of_points_) {
    dimensions_of_points_ = std::move(own);
    first_by_lengths_ = variable.name;
    return true;
  }
  if (own == *dimensions_of_points_) return true;
  const auto names = [&](const DimensionSet& dimensions) {
    std::string text;
    for (const std::size_t d : dimensions) {
      text += (text.empty() ? "" : " and ") + file_.dimensions()[d].name;
    }
    return text;
  };
  const std::string of_first =
      io::in_quotes(first_by_lengths_) + " along " + names(*dimensions_of_points_);
  // If the dimension of the first variable is called cells, the other variable is elsewhere;
  // otherwise nothing says which of the two is meant.
  if (are_along_cells_) {
    why_not_ = "has its points along " + names(own) + ", not as " + of_first;
    return false;
  }
  throw SeveralReadings("variables " + of_first + " and " + io::in_quotes(variable.name) +
                        " along " + names(own) + " have " + std::to_string(num_points_) +
                        " places each: name those that are meant, or give the file longitudes "
                        "and latitudes");
}

// The dimension that is called cells decides before those that only have the right length.
void FieldDimensionFinder::choose_dimension_of_cells(
    std::span<const io::VariableInFile* const> variables) {
  for (const io::VariableInFile* const variable : variables) {
    std::vector<std::string> names;
    for (const std::size_t d : variable->dimensions) names.push_back(file_.dimensions()[d].name);
    const std::vector<std::size_t> found = dimensions_of_cells(names, variable->shape, num_points_);
    if (num_points_ < 2 || found.empty() || !is_name_of_cells(names[found[0]])) continue;
    dimensions_of_points_ = {variable->dimensions[found[0]]};
    first_by_lengths_ = variable->name;
    are_along_cells_ = true;
    return;
  }
}

// True if the dimension has an axis of times or heights, so that no places are along it.
bool FieldDimensionFinder::is_other_axis(std::size_t dimension) const {
  const std::string& name = file_.dimensions()[dimension].name;
  if (is_name_of_time(name)) return true;
  return std::ranges::any_of(headers_, [&](const VariableHeader& header) {
    const std::string axis = header.text("axis");
    return header.name == name && header.dimensions.size() == 1 && header.dimensions[0] == name &&
           (axis == "T" || axis == "Z" || !header.text("positive").empty() ||
            lower_case(header.text("units")).find(" since ") != std::string::npos);
  });
}

// Returns the dimensions of the points: the one that is called cells, or else dimensions as long as
// those of the grid, or else those whose lengths multiply to the number of points. Dimensions of
// length 1 are left out where that is possible.
std::vector<std::size_t> FieldDimensionFinder::run_of_points(
    const io::VariableInFile& variable) const {
  const std::span<const std::uint64_t> shape = variable.shape;
  const std::size_t rank = shape.size();
  std::vector<std::vector<std::size_t>> best;
  int rank_of_best = 0;
  for (std::size_t begin = 0; begin < rank; ++begin) {
    std::uint64_t product = 1;
    for (std::size_t end = begin + 1; end <= rank; ++end) {
      if (!system::multiply_checked(product, shape[end - 1], product)) break;
      if (product != num_points_) continue;
      const bool is_single = end == begin + 1;
      const std::string& name = file_.dimensions()[variable.dimensions[begin]].name;
      bool has_other_axis = false;
      for (std::size_t d = begin; d < end; ++d) {
        has_other_axis = has_other_axis || (shape[d] > 1 && is_other_axis(variable.dimensions[d]));
      }
      // A run of dimensions is the better the more says for it: the name of cells, the lengths of
      // the grid, and no axis of time or height.
      const int preference = is_single && is_name_of_cells(name)                             ? 4
                             : std::ranges::equal(shape.subspan(begin, end - begin), shape_) ? 3
                             : !has_other_axis                                               ? 2
                                                                                             : 1;
      if (preference < rank_of_best) continue;
      if (preference > rank_of_best) best.clear();
      rank_of_best = preference;
      std::vector<std::size_t> run(end - begin);
      for (std::size_t d = begin; d < end; ++d) run[d - begin] = d;
      // The last of those that differ in dimensions of length 1 has the fewest of these at its
      // front.
      const auto is_same = [&](const std::vector<std::size_t>& other) {
        return long_ones_of(variable, other) == long_ones_of(variable, run);
      };
      if (!best.empty() && is_same(best.back())) best.pop_back();
      best.push_back(std::move(run));
      break;
    }
  }
  if (best.size() < 2) return best.empty() ? std::vector<std::size_t>() : best.front();
  std::string text;
  for (const std::vector<std::size_t>& run : best) {
    text += text.empty() ? "" : ", or of ";
    for (std::size_t k = 0; k < run.size(); ++k) {
      text += (k == 0 ? "" : " and ") + file_.dimensions()[variable.dimensions[run[k]]].name;
    }
  }
  throw io::BadValue("the " + std::to_string(num_points_) + " points of variable " +
                     io::in_quotes(variable.name) + " may be those of " + text +
                     ": give the file longitudes and latitudes, or name the dimension that is "
                     "meant cell");
}

}  // namespace rondel::formats
