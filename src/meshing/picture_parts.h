// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The parts that pictures of the quality of meshes share: SVG with three histograms above a map.
// Positions are in pixels from the corner at the top left; y grows downward.
#pragma once

#include <string>

#include "rondel/mesh_quality.h"

namespace rondel::meshing {

inline constexpr double picture_width = 960;
inline constexpr double margin = 20;
inline constexpr double map_top = 280;

// Counts a value in its step; values beyond the ends are counted in the first or last step.
void count_in(mesh::Histogram& histogram, double value);

// Returns the number with two decimals.
std::string fixed(double value);

// Returns the beginning of a picture, up to a group that is open.
std::string begin_picture(double height);

std::string text_at(double x, double y, const std::string& text);

// Returns the bars of a histogram with its title, in one of three columns from 0.
std::string bars(const mesh::Histogram& histogram, int column, const std::string& title);

}  // namespace rondel::meshing
