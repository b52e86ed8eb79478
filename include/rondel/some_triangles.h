// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Files of some faces of a triangulation, such as those in polygons (target rondel::geo).
#pragma once

#include <span>

#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel {

/// Writes some faces, in this order, as write_triangles() writes all of them.
/// \param faces  indices of faces
/// \throws InvalidInput as write_triangles(); (the position in `faces`) if there is no such face.
RONDEL_API void write_some_triangles(const FileName& file, const SiteTable& table,
                                     const Triangulation& triangulation,
                                     std::span<const Index> faces, const Execution& execution = {});

}  // namespace rondel
