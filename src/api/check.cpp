// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// check(): validates the sites, and hands over to the proof (proof/validator.h).

#include "rondel/check.h"

#include "api/validation.h"
#include "proof/validator.h"
#include "system/job.h"

namespace rondel {

CheckReport check(std::span<const Point> sites, std::span<const Triple> triangles,
                  const Options& options, const Execution& execution) {
  const system::Call call(execution);
  api::validate(sites, options);
  return proof::check_triangles(sites, triangles, {options, execution});
}

}  // namespace rondel
