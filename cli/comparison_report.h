// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The report of a comparison of weights with exact areas.
///
/// in    a comparison
/// out   lines for people, or an object for programs
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "rondel/weight_comparison.h"

namespace rondel::cli {

/// Returns a number in three digits.
std::string short_number(double value);

/// Returns some lines: how many weights are wrong and by how much, sums, and the worst rows. `said`
/// is the normalization that the file names.
std::string comparison_summary(const WeightComparison& comparison, const std::string& said);

/// Returns the object; its keys are a contract. Numbers that are not known, or not finite, are null.
nlohmann::ordered_json comparison_json(const WeightComparison& comparison);

}  // namespace rondel::cli
