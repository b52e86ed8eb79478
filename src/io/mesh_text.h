// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Meshes as lines of text, for .off and .obj.
#pragma once

#include <string_view>

#include "io/triangle_formats.h"

namespace rondel::io {

// A line "<prefix>x y z" for every site.
void write_vertex_lines(AtomicFile& file, const MeshToWrite& mesh, std::string_view prefix);

// A line "<prefix>a b c" for every face; the first site has the number `base`.
void write_face_lines(AtomicFile& file, const MeshToWrite& mesh, std::string_view prefix,
                      Index base);

}  // namespace rondel::io
