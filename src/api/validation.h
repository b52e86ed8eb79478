// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The checks of arguments, made once where the public functions enter.
//
// in    options, sites, query points
// out   nothing, or InvalidInput with the index of the first that is not valid
// index sites or queries in the order of the argument
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel::api {

// Throws InvalidInput if the center is not finite, the squared radius is not positive and finite,
// or there are more than max_sites sites.
RONDEL_API void validate(const Options& options, std::size_t num_sites);

// True if all sites are finite and, in the projected model, none is the center. Faster than a check
// of each, as nothing branches.
bool are_valid(std::span<const Point> sites, const Options& options);

// Throws InvalidInput because of the options, of too many sites, or of the first that is not valid.
void validate(std::span<const Point> sites, const Options& options);

// Does the same for some of the sites, without testing the options. `first` is the number of sites
// before these.
RONDEL_API void validate_some(std::span<const Point> sites, const Options& options,
                              std::uint64_t first);

// Throws InvalidInput if a query point is not finite or, where it stands for a ray, the center.
// `word` begins the message: "query 3: ...".
RONDEL_API void validate_queries(std::span<const Point> queries, const Point& center,
                                 bool are_rays = true, const char* word = "query");

}  // namespace rondel::api
