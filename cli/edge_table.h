// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The edges between sites that --constraints names, and what the library says of them.
///
/// in    a .csv file, two columns of indices of sites from 0
/// out   constraints, or FileError with the line
/// index sites in the order of their file; constraints in that of theirs
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "command.h"
#include "report.h"
#include "rondel/constrained.h"
#include "rondel/error.h"
#include "rondel/io.h"

namespace rondel::cli {

/// Constraints, and where they are, for messages.
struct EdgeTable {
  std::vector<std::array<Index, 2>> constraints;
  std::vector<std::string> places;  ///< of each constraint: "faults.csv:3"
};

/// Reads pairs of sites, a line each; the first line may have names.
/// \throws FileError for what is no pair of sites, and if rows of their file were left out, since
///         numbers of rows are then not those of sites
EdgeTable read_edge_table(const std::string& path, const SiteTable& sites);

/// \throws UsageError unless the file of --constraints is .csv
void require_edge_table(const std::string& path);

/// \throws FileError for what the library says of constraints
/// \param hint  what to do about those that cross
[[noreturn]] void refuse_edges(const CrossingConstraints& error, const EdgeTable& edges,
                               const std::string& hint);
/// \param sites  the name of their file, where no constraint is to blame
[[noreturn]] void refuse_edges(const InvalidInput& error, const EdgeTable& edges,
                               const std::string& sites);

/// Calls the library; what it says of a constraint becomes a FileError with its place.
template <class Work>
auto with_edges(const EdgeTable& edges, const std::string& sites, const std::string& hint,
                const Work& work) {
  try {
    return work();
  } catch (const CrossingConstraints& error) {
    refuse_edges(error, edges, hint);
  } catch (const InvalidInput& error) {
    refuse_edges(error, edges, sites);
  }
}

}  // namespace rondel::cli
