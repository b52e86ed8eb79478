// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Diagrams of triangulations. The circumcenters of faces that constraints have changed bound no cells.

#include "rondel/diagram.h"

#include "api/triangulation_impl.h"
#include "dual/parts.h"
#include "system/job.h"

namespace rondel {

Cells cells(const Triangulation& triangulation, const Execution& execution) {
  const system::Call call(execution);
  api::require_unchanged_faces(triangulation, execution);
  return dual::cells(triangulation, dual::SplitSites(triangulation, execution.threads), nullptr);
}

Diagram diagram(const Triangulation& triangulation, const Execution& execution) {
  const system::Call call(execution);
  api::require_unchanged_faces(triangulation, execution);
  Diagram result;
  result.cells =
      dual::cells(triangulation, dual::SplitSites(triangulation, execution.threads), &result.areas);
  return result;
}

std::vector<double> areas(const Triangulation& triangulation, const Execution& execution) {
  return diagram(triangulation, execution).areas;
}

std::vector<Point> centroids(const Triangulation& triangulation, const Execution& execution) {
  const system::Call call(execution);
  api::require_unchanged_faces(triangulation, execution);
  return dual::centroids(triangulation, dual::SplitSites(triangulation, execution.threads));
}

}  // namespace rondel
