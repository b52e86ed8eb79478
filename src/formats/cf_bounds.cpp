// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Tells which dimensions of bounds count records, in which the bounds of all cells come again, and
// leaves these out: record_dimensions() and read_bounds().
//
// A cell has different corners, so bounds never repeat along the dimension of the corners. What
// joins files gives bounds further dimensions: time, or another one that the coordinates lack.
#include "formats/cf_bounds.h"

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/bad_value.h"
#include "io/number.h"
#include "rondel/conventions.h"
#include "rondel/error.h"
#include "system/message_text.h"

namespace rondel {
namespace {

bool is_same_bound(double a, double b) { return a == b || (a != a && b != b); }

// Chooses the dimensions of records among those of bounds.
class RecordDimensions {
 public:
  RecordDimensions(const BoundsLayout& layout, std::span<const double> values)
      : layout_(layout), values_(values), are_records_(layout.dimensions.size(), false) {
    has_all_places_ = std::ranges::all_of(layout.places, [&](const std::string& name) {
      return std::ranges::count(layout.dimensions, name) == 1;
    });
  }

  // Returns an answer for each dimension.
  std::vector<bool> find() {
    const std::size_t num_places = layout_.places.size();
    const auto drop = [&](std::size_t wanted, const auto& is_meant) {
      for (std::size_t d = 0; d < are_records_.size() && num_left() > wanted; ++d) {
        if (!are_records_[d] && !is_of_places(d) && is_meant(d)) are_records_[d] = true;
      }
    };
    // Bounds whose dimensions have names of their own may be the nodes of a grid.
    const std::size_t least = has_all_places_ ? num_places + 1 : num_places;
    drop(least, [&](std::size_t d) {
      return std::ranges::count(layout_.repeated, layout_.dimensions[d]) != 0;
    });
    drop(least, [&](std::size_t d) { return is_name_of_time(layout_.dimensions[d]); });
    const std::size_t wanted = has_all_places_ || !are_nodes_last() ? num_places + 1 : num_places;
    drop(wanted, [&](std::size_t d) { return !first_change(d); });
    if (num_left() > wanted) refuse_changes();
    return are_records_;
  }

  // Throws InvalidInput if bounds change along a dimension of records.
  void require_same() const {
    for (std::size_t d = 0; d < are_records_.size(); ++d) {
      if (!are_records_[d]) continue;
      if (const auto change = first_change(d)) {
        throw InvalidInput("are " + system::shortest_text(values_[change->first]) + " and " +
                               system::shortest_text(values_[change->second]) +
                               " for one place along '" + layout_.dimensions[d] +
                               "': cells that change are not read",
                           d);
      }
    }
  }

 private:
  [[nodiscard]] std::size_t num_left() const {
    return static_cast<std::size_t>(std::ranges::count(are_records_, false));
  }

  // Throws InvalidInput with the dimensions along which bounds change. Only one counts corners.
  [[noreturn]] void refuse_changes() const {
    std::string names;
    std::size_t first = 0;
    for (std::size_t d = are_records_.size(); d-- > 0;) {
      if (are_records_[d] || is_of_places(d)) continue;
      std::string name = "'";
      name.append(layout_.dimensions[d]).append(names.empty() ? "'" : "' and ");
      names.insert(0, name);
      first = d;
    }
    throw InvalidInput("change along " + names +
                           ", where one dimension counts the corners: cells that change are not "
                           "read",
                       first);
  }

  [[nodiscard]] bool is_of_places(std::size_t d) const {
    return has_all_places_ && std::ranges::count(layout_.places, layout_.dimensions[d]) != 0;
  }

  // True if the last dimensions are one longer than those of the places, in either order.
  [[nodiscard]] bool are_nodes_last() const {
    const std::size_t num_places = layout_.lengths.size();
    if (layout_.shape.size() < num_places) return false;
    std::vector<std::uint64_t> last(layout_.shape.end() - static_cast<std::ptrdiff_t>(num_places),
                                    layout_.shape.end());
    std::vector<std::uint64_t> nodes(layout_.lengths.begin(), layout_.lengths.end());
    for (std::uint64_t& length : nodes) ++length;
    return std::ranges::is_permutation(last, nodes);
  }

  // Returns the numbers of two values that differ only in their place along a dimension, if bounds
  // change along it.
  [[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> first_change(
      std::size_t d) const {
    std::size_t stride = 1;
    for (std::size_t after = d + 1; after < layout_.shape.size(); ++after) {
      stride *= layout_.shape[after];
    }
    const std::size_t block = stride * layout_.shape[d];
    for (std::size_t i = 0; i < values_.size(); ++i) {
      // This is the value at index 0 of dimension d, and the same indices of the others.
      const std::size_t first = i - i % block + i % stride;
      if (!is_same_bound(values_[i], values_[first])) return std::pair(first, i);
    }
    return std::nullopt;
  }

  const BoundsLayout& layout_;
  std::span<const double> values_;
  std::vector<bool> are_records_;
  bool has_all_places_ = false;  // true if the bounds have the dimensions of the coordinate
};

}  // namespace

std::vector<bool> record_dimensions(const BoundsLayout& layout, std::span<const double> values) {
  std::uint64_t size = 1;
  for (const std::uint64_t length : layout.shape) size *= length;
  if (values.size() != size || layout.dimensions.size() != layout.shape.size()) {
    throw InvalidInput(std::to_string(values.size()) + " bounds are not " + std::to_string(size),
                       0);
  }
  RecordDimensions dimensions(layout, values);
  std::vector<bool> are_records = dimensions.find();
  dimensions.require_same();
  return are_records;
}

namespace formats {
namespace {

// Returns the names of dimensions of a file.
std::vector<std::string> names_of_dimensions(const io::NetcdfReader& file,
                                             std::span<const std::size_t> dimensions) {
  std::vector<std::string> names;
  for (const std::size_t d : dimensions) names.push_back(file.dimensions()[d].name);
  return names;
}

}  // namespace

BoundsArray read_bounds(const io::NetcdfReader& file, const io::VariableInFile& bounds,
                        const PlaceArrays& places,
                        std::initializer_list<const io::VariableInFile*> relatives) {
  // Bounds at many times need not be in memory together. Of two dimensions one may be corners.
  const io::VariableInFile given = bounds.shape.size() > 2 ? without_times(file, bounds) : bounds;
  BoundsArray made{given, degrees_of(file, given, UsualUnits::of_name, relatives)};
  const std::vector<std::string> names = names_of_dimensions(file, given.dimensions);
  const std::vector<std::string> of_places = names_of_dimensions(file, places.dimensions);
  const std::vector<std::string> repeated = names_of_dimensions(file, places.repeated);
  std::vector<bool> are_records;
  try {
    are_records =
        record_dimensions({names, given.shape, of_places, places.shape, repeated}, made.values);
  } catch (const InvalidInput& error) {
    throw io::BadValue("the bounds " + io::in_quotes(bounds.name) + " " + error.what());
  }
  if (std::ranges::count(are_records, true) == 0) return made;
  std::vector<std::size_t> order;
  for (const bool is_record : {true, false}) {
    for (std::size_t d = 0; d < are_records.size(); ++d) {
      if (are_records[d] == is_record) order.push_back(d);
    }
  }
  made.values = transposed(given.shape, order, std::move(made.values));
  io::VariableInFile& left = made.variable;
  left.dimensions.clear();
  left.shape.clear();
  left.num_values = 1;
  for (const std::size_t d : order) {
    if (are_records[d]) continue;
    left.dimensions.push_back(given.dimensions[d]);
    left.shape.push_back(given.shape[d]);
    left.num_values *= given.shape[d];
  }
  made.values.resize(left.num_values);
  return made;
}

}  // namespace formats
}  // namespace rondel
