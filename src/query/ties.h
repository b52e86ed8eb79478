// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Ranks that depend on places alone: for who promises that the order of the sites changes no bit.
#pragma once

#include "order/radix_sort.h"
#include "rondel/export.h"
#include "rondel/triangulation.h"

namespace rondel::query {

// Orders the vertices of equal keys, which are in the order of the input, by what else there is to their
// places. A Built::OrderTies; apart from it, so that programs without need of it have nothing of it.
RONDEL_API void order_ties_by_place(const Triangulation& triangulation,
                                    order::KeyedIndices& sorted);

}  // namespace rondel::query
