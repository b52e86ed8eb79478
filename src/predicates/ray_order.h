// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// An order of rays from the center, for finding those that are equal.
#pragma once

#include "rondel/types.h"

namespace rondel::predicates {

// Compares the rays of two points exactly, by the slopes of their coordinates against the longest
// one. Zero when both points are on one ray.
// Precondition: the same coordinate is the longest of both (the first one of equals), with the same
// sign.
Sign compare_rays(const Point& a, const Point& b, const Point& center);

// Whether two points are on one ray, exactly, without a precondition.
bool are_on_one_ray(const Point& a, const Point& b, const Point& center);

}  // namespace rondel::predicates
