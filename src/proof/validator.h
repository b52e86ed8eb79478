// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The validator behind rondel::check(), for sites that have been validated.
#pragma once

#include <span>

#include "rondel/check.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"
#include "system/job.h"

namespace rondel::proof {

CheckReport check_triangles(std::span<const Point> sites, std::span<const Triple> triangles,
                            const system::Job& options);

}  // namespace rondel::proof
