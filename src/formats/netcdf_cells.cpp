// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Functions that the readers of all conventions share: they read nodes, connectivities, masks and
// centers into MeshContent, check them, and throw BadValue with the names of the variables.
#include "formats/netcdf_cells.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "formats/cf_values.h"
#include "io/bad_value.h"
#include "io/number.h"
#include "system/large_arrays.h"
#include "system/message_text.h"

namespace rondel::formats {
namespace {

using io::BadValue;

// Returns, for example, "3 of 17 cells".
std::string cells_in_words(std::size_t count, std::size_t of_all) {
  return std::to_string(count) + " of " + std::to_string(of_all) + " cells";
}

// Reads the rows of a connectivity, cell by cell.
class ConnectivityReader {
 public:
  ConnectivityReader(const io::NetcdfReader& file, const Connectivity& connectivity,
                     const std::vector<double>& counts, MeshContent& mesh)
      : of_(connectivity),
        counts_(counts),
        mesh_(mesh),
        entries_(file.numbers(connectivity.variable)),
        meant_(entries_) {
    ValueRules(of_.variable).apply(meant_);
  }

  // Reads all rows. Ragged rows follow each other; others have one length and may be transposed.
  void read() {
    if (!is_ragged()) require_values(of_.variable, of_.num_cells * of_.corners_per_cell);
    std::uint64_t begin = 0;  // where the row of the cell begins
    for (std::uint64_t i = 0; i < of_.num_cells; ++i) {
      const Row row = {i, begin, length_of(i, begin)};
      take_row(row);
      begin += is_ragged() ? row.length : of_.corners_per_cell;
    }
    if (is_ragged()) require_values(of_.variable, begin);
    tell();
  }

 private:
  // A cell with the place of its entries; `begin` is not in use if rows are transposed.
  struct Row {
    std::uint64_t cell;
    std::uint64_t begin;
    std::uint64_t length;  // number of entries in use
  };

  // True if rows have different lengths and follow each other, as ESMF may have them.
  [[nodiscard]] bool is_ragged() const { return of_.corners_per_cell == 0; }
  // Returns the index of entry k of a row among all entries.
  [[nodiscard]] std::uint64_t place_of(const Row& row, std::uint64_t k) const {
    return of_.is_transposed ? k * of_.num_cells + row.cell : row.begin + k;
  }
  // Returns the quoted name of the variable, for messages.
  [[nodiscard]] std::string name() const { return io::in_quotes(of_.variable.name); }

  // Returns the number of entries of a row that are in use. Throws BadValue for a count that is no
  // whole number or more than the row has.
  [[nodiscard]] std::uint64_t length_of(std::uint64_t cell, std::uint64_t begin) const {
    if (counts_.empty()) return of_.corners_per_cell;
    const std::uint64_t most = is_ragged() ? entries_.size() - begin : of_.corners_per_cell;
    const double given = counts_[cell];
    if (given >= 0 && given <= static_cast<double>(most) && given == std::floor(given)) {
      return static_cast<std::uint64_t>(given);
    }
    throw BadValue("cell " + std::to_string(cell) + " has " + system::shortest_text(given) +
                   " corners of " + std::to_string(most));
  }

  // True if an entry begins a further ring: `polybreak_value` of ESMF.
  [[nodiscard]] bool is_break(std::uint64_t at) const {
    return of_.break_value < of_.first && entries_[at] == of_.break_value;
  }
  // True if an entry stands for no corner: a missing value, or a number less than the first one.
  [[nodiscard]] bool is_none(std::uint64_t at) const {
    return std::isnan(meant_[at]) || entries_[at] < of_.first;
  }
  // True if an entry is the number of a node.
  [[nodiscard]] bool is_node(std::uint64_t at) const {
    const double node = entries_[at] - of_.first;
    return !is_none(at) && node < static_cast<double>(mesh_.nodes.size()) &&
           node == std::floor(node);
  }
  // Returns the index of a node, from 0. Precondition: is_node(at).
  [[nodiscard]] Index node_at(std::uint64_t at) const {
    return static_cast<Index>(entries_[at] - of_.first);
  }

  // Entries that are no corners may only follow all corners of a row that has no length of its own,
  // or fill a row: elsewhere a corner would be lost. Corners of masked cells may be anything.
  void take_row(const Row& row) {
    const bool is_masked = !mesh_.mask.empty() && mesh_.mask[row.cell] == 0;
    const std::size_t before = mesh_.cells.corners.size();
    std::uint64_t num_none = 0;
    std::uint64_t first_none = 0;
    for (std::uint64_t k = 0; k < row.length; ++k) {
      const std::uint64_t at = place_of(row, k);
      if (is_break(at)) {
        mesh_.cells.end_ring();
      } else if (is_none(at)) {
        if (num_none++ == 0) first_none = k;
        if (!is_masked && !std::isnan(meant_[at])) ++num_undeclared_;
      } else if (is_node(at)) {
        if (num_none > 0 && !is_masked) refuse_none(row, first_none);
        mesh_.cells.corners.push_back(node_at(at));
      } else if (!is_masked) {
        refuse_node(row.cell, at);
      }
    }
    const bool has_corners = mesh_.cells.corners.size() > before;
    if (num_none > 0 && has_corners && !counts_.empty() && !is_masked) refuse_none(row, first_none);
    if (!counts_.empty() && !is_ragged() && !is_masked) find_further_corners(row, before);
    mesh_.cells.end_ring();
    mesh_.cells.end_cell();
  }

  // Notes a cell that has other corners behind those that its number of corners counts. Programs
  // fill up rows with numbers that are no nodes, or by repeating corners.
  void find_further_corners(const Row& row, std::size_t before) {
    const std::span<const Index> corners = std::span(mesh_.cells.corners).subspan(before);
    for (std::uint64_t k = row.length; k < of_.corners_per_cell; ++k) {
      const std::uint64_t at = place_of(row, k);
      if (!is_node(at) || std::ranges::count(corners, node_at(at)) != 0) continue;
      if (num_longer_++ == 0) first_longer_ = row.cell;
      return;
    }
  }

  // Throws BadValue for entry k of a row, which is no corner though others follow or are counted.
  [[noreturn]] void refuse_none(const Row& row, std::uint64_t k) const {
    throw BadValue("cell " + std::to_string(row.cell) + " has the number " +
                   system::shortest_text(entries_[place_of(row, k)]) +
                   ", which is no node, as corner " + std::to_string(k) + " in " + name() +
                   (counts_.empty()
                        ? ", before other corners"
                        : ", though it has " + std::to_string(row.length) + " corners"));
  }

  // Throws BadValue for an entry that is too large, with a hint if numbers seem to count from 1.
  [[noreturn]] void refuse_node(std::uint64_t cell, std::uint64_t at) const {
    const bool may_count_from_1 = of_.first == 0 &&
                                  entries_[at] == static_cast<double>(mesh_.nodes.size()) &&
                                  std::ranges::count(entries_, 0.0) == 0;
    throw BadValue(
        "cell " + std::to_string(cell) + " has a corner " + system::shortest_text(entries_[at]) +
        " of " + std::to_string(mesh_.nodes.size()) + " nodes in " + name() +
        (may_count_from_1
             ? ", counted from 0; if they are counted from 1, its attribute start_index = 1 must "
               "say so"
             : std::string()));
  }

  // Adds remarks on entries that were passed over.
  void tell() const {
    if (num_undeclared_ > 0) {
      mesh_.remarks.push_back(std::to_string(num_undeclared_) + " numbers of " + name() +
                              " are less than " + system::shortest_text(of_.first) +
                              " and taken for no corners, though no _FillValue says so");
    }
    if (num_longer_ > 0) {
      mesh_.remarks.push_back(cells_in_words(num_longer_, of_.num_cells) +
                              " have further corners in " + name() +
                              " behind the number of corners that they are said to have, the first "
                              "one cell " +
                              std::to_string(first_longer_));
    }
  }

  const Connectivity& of_;
  const std::vector<double>& counts_;
  MeshContent& mesh_;
  // Entries as they are in the file; break values and numbers of nodes are compared with these.
  std::vector<double> entries_;
  std::vector<double> meant_;  // missing ones are NaN
  std::size_t num_undeclared_ = 0;
  std::size_t num_longer_ = 0;
  std::uint64_t first_longer_ = 0;
};

// Throws BadValue if a variable of a mesh has time as its first dimension, along which it changes.
void require_no_change(const io::VariableInFile& variable) {
  if (!variable.changes_with_time) return;
  throw BadValue("variable " + io::in_quotes(variable.name) +
                 " changes with time: meshes that move are not read");
}

}  // namespace

bool is_meant(const io::NetcdfReader& file, const std::string& name,
              const io::VariableInFile& cells) {
  const io::VariableInFile* const variable = file.find(name);
  return name.empty() ||
         (variable != nullptr && std::ranges::any_of(variable->dimensions, [&](std::size_t d) {
            return std::ranges::count(cells.dimensions, d) != 0;
          }));
}

std::optional<io::NetcdfReader> without_times_of_mesh(const io::NetcdfReader& file) {
  const std::vector<VariableHeader> headers = headers_of(file);
  if (!has_mesh(headers)) return std::nullopt;
  const std::vector<bool> are_parts = parts_of_grids(headers);
  std::map<std::size_t, io::VariableInFile> changed;
  for (std::size_t v = 0; v < headers.size(); ++v) {
    const std::vector<std::string>& dimensions = headers[v].dimensions;
    if (!are_parts[v] || !headers[v].is_number || dimensions.size() < 2) continue;
    if (!is_name_of_time(dimensions[0]) || headers[v].shape[0] == 0) continue;
    io::VariableInFile once = without_times(file, file.variables()[v]);
    once.changes_with_time = once.shape[0] > 1;
    if (!once.changes_with_time) {
      once.dimensions.erase(once.dimensions.begin());
      once.shape.erase(once.shape.begin());
      ++once.num_fixed;
    }
    changed.emplace(v, std::move(once));
  }
  return changed.empty() ? std::nullopt : std::optional(file.with(std::move(changed)));
}
void require_values(const io::VariableInFile& variable, std::uint64_t wanted) {
  if (variable.num_values == wanted) return;
  require_no_change(variable);
  throw BadValue("variable " + io::in_quotes(variable.name) + " has " +
                 std::to_string(variable.num_values) + " values instead of " +
                 std::to_string(wanted));
}

// A variable that nobody keeps has no place to be referred to.
void require_rank(io::VariableInFile&& variable, std::size_t rank) = delete;

const io::VariableInFile& require_rank(const io::VariableInFile& variable, std::size_t rank) {
  if (variable.shape.size() == rank) return variable;
  require_no_change(variable);
  throw BadValue("variable " + io::in_quotes(variable.name) + " has " +
                 std::to_string(variable.shape.size()) + " dimensions instead of " +
                 std::to_string(rank));
}

bool is_nearly_place(const LonLat& place) {
  return std::isfinite(place.lon_deg) && std::abs(place.lat_deg) <= 90 + max_beyond_pole_deg;
}

bool is_missing_place(const LonLat& place) {
  return std::isnan(place.lon_deg) || std::isnan(place.lat_deg);
}

std::array<std::vector<double>, 2> degrees_of_both(const io::NetcdfReader& file,
                                                   const MeshCoordinates& wanted,
                                                   const MeshCoordinates& related,
                                                   UsualUnits usual) {
  return {degrees_of(file, *wanted.lon, usual, {related.lon, wanted.lat, related.lat}),
          degrees_of(file, *wanted.lat, usual, {related.lat, wanted.lon, related.lon})};
}

std::vector<LonLat> positions_of(const io::NetcdfReader& file, const MeshCoordinates& wanted,
                                 const MeshCoordinates& related, UsualUnits usual) {
  const io::VariableInFile& lon = *wanted.lon;
  const io::VariableInFile& lat = *wanted.lat;
  require_no_change(lon);
  require_values(lat, lon.num_values);
  auto [lons, lats] = degrees_of_both(file, wanted, related, usual);
  if (lon.dimensions != lat.dimensions &&
      std::ranges::is_permutation(lon.dimensions, lat.dimensions)) {
    lats = in_order(lat, lon.dimensions, std::move(lats));
  }
  std::vector<LonLat> positions(lons.size());
  for (std::size_t i = 0; i < lons.size(); ++i) positions[i] = {lons[i], lats[i]};
  return positions;
}

LonLat require_position(const std::string& names, std::size_t i, const LonLat& place) {
  if (!is_nearly_place(place)) {
    throw BadValue("value " + std::to_string(i) + " of " + names + ", " +
                   system::shortest_text(place.lon_deg) + " and " +
                   system::shortest_text(place.lat_deg) + " degrees, is no place");
  }
  return {place.lon_deg, std::clamp(place.lat_deg, -90.0, 90.0)};
}

void take_nodes(const io::NetcdfReader& file, const MeshCoordinates& nodes,
                const MeshCoordinates& centers, UsualUnits usual, MeshContent& mesh) {
  mesh.nodes = positions_of(file, nodes, centers, usual);
  mesh.names = io::in_quotes(nodes.lon->name) + " and " + io::in_quotes(nodes.lat->name);
  mesh.is_single = nodes.lon->type == io::NetcdfType::float32;
}

bool has_rows(std::span<const std::uint64_t> shape) {
  return std::ranges::count_if(shape, [](std::uint64_t length) { return length > 1; }) > 1;
}

void end_cells_of_nodes(std::size_t corners_per_cell, bool may_be_fewer, MeshContent& mesh) {
  const std::size_t num_cells = mesh.nodes.size() / corners_per_cell;
  CellRings& cells = mesh.cells;
  system::reserve_large(cells.corners, mesh.nodes.size());
  cells.rings.reserve(num_cells + 1);
  cells.cells.reserve(num_cells + 1);
  for (std::size_t i = 0; i < num_cells; ++i) {
    std::size_t count = corners_per_cell;
    // Files fill up the rows of cells with fewer corners by missing values.
    while (may_be_fewer && count > 3 &&
           is_missing_place(mesh.nodes[i * corners_per_cell + count - 1])) {
      --count;
    }
    for (std::size_t k = 0; k < count; ++k) {
      cells.corners.push_back(static_cast<Index>(i * corners_per_cell + k));
    }
    cells.end_ring();
    cells.end_cell();
  }
}

void take_connectivity(const io::NetcdfReader& file, const Connectivity& connectivity,
                       const std::vector<double>& counts, MeshContent& mesh) {
  ConnectivityReader(file, connectivity, counts, mesh).read();
}

void take_mask(const io::NetcdfReader& file, std::string_view name, std::uint64_t num_cells,
               MaskedBy masked_by, MeshContent& mesh) {
  const io::VariableInFile* const variable = file.find(name);
  if (variable == nullptr) return;
  require_values(*variable, num_cells);
  for (const double value : meant_numbers(file, *variable)) {
    const bool is_masked = std::isnan(value) || (value == 0) == (masked_by == MaskedBy::zero);
    mesh.mask.push_back(is_masked ? 0 : 1);
  }
  const auto num_masked = static_cast<std::size_t>(std::ranges::count(mesh.mask, 0));
  if (num_masked == 0) {
    mesh.mask.clear();
  } else {
    mesh.remarks.push_back(cells_in_words(num_masked, mesh.mask.size()) + " are masked by " +
                           io::in_quotes(name));
  }
}

void take_centers(const io::NetcdfReader& file, const MeshCoordinates& centers,
                  const MeshCoordinates& nodes, UsualUnits usual, MeshContent& mesh) {
  if (centers.lon == nullptr || centers.lat == nullptr) return;
  require_values(*centers.lon, mesh.cells.num_cells());
  mesh.centers = positions_of(file, centers, nodes, usual);
  mesh.center_names = io::in_quotes(centers.lon->name) + " and " + io::in_quotes(centers.lat->name);
}

void leave_out_cells_without_corners(MeshContent& mesh) {
  const CellRings& cells = mesh.cells;
  const std::size_t num_cells = cells.num_cells();
  std::vector<std::int32_t> mask = mesh.mask;
  if (mask.empty()) mask.assign(num_cells, 1);
  std::size_t num_left_out = 0;
  std::size_t num_whole = 0;
  std::vector<bool> are_whole(num_cells);
  for (std::size_t i = 0; i < num_cells; ++i) {
    bool is_whole = true;
    for (std::uint64_t k = cells.rings[cells.cells[i]]; k < cells.rings[cells.cells[i + 1]]; ++k) {
      const Index node = cells.corners[k];
      // The corners of a masked cell may be anything; elsewhere a number that is no place is an
      // error, and only a missing one leaves out the cell.
      const bool may_be_no_place = mask[i] == 0 || is_missing_place(mesh.nodes[node]);
      if (!may_be_no_place) {
        (void)require_position(mesh.names, node, mesh.nodes[node]);
      }
      is_whole = is_whole && is_nearly_place(mesh.nodes[node]);
    }
    are_whole[i] = is_whole;
    if (is_whole) {
      ++num_whole;
    } else {
      if (mask[i] != 0) ++num_left_out;
      mask[i] = 0;
    }
  }
  if (num_left_out > 0 && std::ranges::count(mask, 0) == std::ssize(mask)) {
    throw BadValue("no cell has corners: values of " + mesh.names + " are missing");
  }
  // Nodes that no cell has any more get a place, so that all nodes can become unit vectors.
  for (LonLat& node : mesh.nodes) {
    node = is_nearly_place(node) ? LonLat{node.lon_deg, std::clamp(node.lat_deg, -90.0, 90.0)}
                                 : LonLat{0, 0};
  }
  if (num_whole < num_cells) {
    CellRings kept;
    for (std::size_t i = 0; i < num_cells; ++i) {
      if (are_whole[i]) kept.append_rings(cells, i);
      kept.end_cell();
    }
    mesh.cells = std::move(kept);
  }
  if (num_left_out == 0) return;
  mesh.mask = std::move(mask);
  mesh.remarks.push_back(cells_in_words(num_left_out, num_cells) +
                         " have corners that are missing and are left out");
}

double number_or(const io::VariableInFile& variable, std::string_view name, double otherwise) {
  const io::NetcdfAttribute* const attribute = io::find_attribute(variable.attributes, name);
  return attribute == nullptr || attribute->numbers.empty() ? otherwise : attribute->numbers[0];
}

}  // namespace rondel::formats
