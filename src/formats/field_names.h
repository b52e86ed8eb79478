// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Names for the fields of an array in a table, where each field is a column.
//
// in    the coordinates along an axis, with its attributes
// out   texts, such as dates
// index places along the axis
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "rondel/fields.h"

namespace rondel::formats {

// Returns the coordinates along an axis as texts that differ from each other, or nothing if they do
// not differ. Times with units of CF ("hours since 2000-01-01") become dates of ISO 8601, with the
// time of the day if one of them is not midnight; other axes, and times in unknown units or
// calendars, become numbers.
std::vector<std::string> places_on_axis(const FieldArray& axis);

}  // namespace rondel::formats
