// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The checks of arguments, made once where the public functions enter.
#pragma once

#include <span>

#include "rondel/types.h"

namespace rondel::api {

// Throws InvalidInput as rondel/delaunay.h promises.
void validate(std::span<const Point> sites, const Options& options);

}  // namespace rondel::api
