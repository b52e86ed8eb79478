// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The core of the library in one include: triangulations, hulls, diagrams, queries, predicates
/// (target rondel::rondel). Files, polygons, interpolation, remapping, meshes, graphs and the globe
/// have headers of their own, which their targets install beside this one.
#pragma once

#include "rondel/check.h"          // IWYU pragma: export
#include "rondel/delaunay.h"       // IWYU pragma: export
#include "rondel/diagram.h"        // IWYU pragma: export
#include "rondel/dynamic.h"        // IWYU pragma: export
#include "rondel/error.h"          // IWYU pragma: export
#include "rondel/export.h"         // IWYU pragma: export
#include "rondel/hull.h"           // IWYU pragma: export
#include "rondel/predicates.h"     // IWYU pragma: export
#include "rondel/query.h"          // IWYU pragma: export
#include "rondel/sites.h"          // IWYU pragma: export
#include "rondel/triangulation.h"  // IWYU pragma: export
#include "rondel/types.h"          // IWYU pragma: export
#include "rondel/version.h"        // IWYU pragma: export
