// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The biased randomized insertion order (Amenta, Choi and Rote, SoCG 2003): rounds that grow by a
// factor, each along the spatial order.
#pragma once

#include <span>
#include <vector>

#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel::kernel {

// The ranks 0 ... n-1 in the order of insertion. A rank is in the last round with probability 7/8,
// in the one before with 7/64, and so on, by a hash of the rank.
RONDEL_API std::vector<Index> insertion_order(Index n);

// The order of insertion of sites whose spatial order is `order`, in which the sites of a crowd
// (order/crowds.h) keep an order of their own.
std::vector<Index> insertion_order(std::span<const Point> sites, std::span<const Index> order,
                                   Model model, const Point& center);

}  // namespace rondel::kernel
