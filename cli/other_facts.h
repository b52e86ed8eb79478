// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// What `rondel info` says of files that hold no sites: features with lines and polygons, weights.
///
/// in    a file
/// out   text for people and a JSON object; nothing if the file holds something else
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "job.h"
#include "options.h"

namespace rondel::cli {

/// Both forms of a report.
struct OtherFacts {
  std::string json;
  std::string text;
};

/// Returns the array "columns" of a report: names, and whether column_values() can read them.
nlohmann::ordered_json json_of_columns(const std::vector<Column>& columns);

/// Returns the line of a report that lists columns; an empty text if there are none.
std::string line_of_columns(const std::vector<Column>& columns);

/// Returns what the file of INPUT holds beside sites, or nothing if it is neither features nor
/// weights, or comes from standard input, which was read before.
std::optional<OtherFacts> other_facts_of(const CommonOptions& common, Job& job);

}  // namespace rondel::cli
