// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes sites and faces as lines of text, for .csv .tsv .xyz .off and .obj.
//
// in    sites, or the faces of a triangulation
// out   a line of text for each
// index sites, from 0 or as a format counts them
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include "io/triangle_formats.h"

namespace rondel::io {

// Appends a line such as "1.5 2 3\n", where the delimiter is a blank.
void append_row(std::string& text, std::initializer_list<double> values, char delimiter);

// Writes a line "<prefix>x y z" for every site, where the delimiter is a blank.
void write_site_lines(AtomicFile& file, std::span<const Point> sites, unsigned threads,
                      std::string_view prefix, char delimiter);

// Writes a line "<prefix>a b c" for every face, where the first site has the number `base`.
void write_face_lines(AtomicFile& file, const MeshToWrite& mesh, std::string_view prefix,
                      Index base);

}  // namespace rondel::io
