// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The names of the fields of an array in a table, where each is a column.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "rondel/fields.h"

namespace rondel::interpolation {

// The places of an axis as texts that differ; none if they do not. Times by their CF units ("hours since
// 2000-01-01") are dates of ISO 8601, with the time of the day where one is not midnight; other axes are
// numbers, and so are times in units or calendars that are not known.
std::vector<std::string> places_on_axis(const FieldArray& axis);

}  // namespace rondel::interpolation
