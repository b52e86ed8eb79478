// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Answers to queries as arrays, for static and dynamic triangulations.
#pragma once

#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.h"
#include "rondel/query.h"

namespace rondel::python {

// The kind of place, the face and the three sites of each query.
using LocationsOut =
    std::tuple<ArrayOut<std::int32_t>, ArrayOut<std::int32_t>, ArrayOut<std::int32_t>>;
using SiteListsOut = std::tuple<ArrayOut<std::int64_t>, ArrayOut<std::int32_t>>;

// Call these two without the lock of the interpreter.
LocationsOut locations_out(const std::vector<Location>& found);
LocationsOut locate_all(const Locator& locator, std::span<const Point> queries,
                        const Execution& execution);

std::vector<double> distances(const Locator& locator, std::span<const Point> queries,
                              std::span<const Index> sites);

inline SiteListsOut site_lists_out(CompressedRows<Index>&& lists) {
  return {offsets_out(std::move(lists.offsets)), indices_out(std::move(lists.values))};
}

}  // namespace rondel::python
