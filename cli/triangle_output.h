// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Meshes of triangles in the formats of ocean models, which `mesh convert`, `triangulate` and `info`
/// share.
///
/// in    a file of triangles, or a triangulation
/// out   a file of triangles, and what is said of it
/// index nodes and triangles from 0; from 1 where a message names them as files do
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "job.h"
#include "rondel/triangle_files.h"

namespace rondel::cli {

/// The help of INPUT goes on with this where it may be triangles, too.
inline constexpr const char* triangle_input_help =
    "\nOr triangles: .msh (Gmsh), .14 (ADCIRC's fort.14), .gr3 .ll (SCHISM), .2dm (SMS),\n"
    ".nc (UGRID without centers of faces), a folder of FESOM";

/// The endings of files of triangles, for messages and help.
inline constexpr const char* triangle_mesh_endings = ".msh .14 .gr3 .ll .2dm fesom";

/// True if INPUT is a mesh of triangles in a format of its own, which netCDF is not.
bool is_triangle_input(const CommonOptions& common);
/// True for netCDF, too, that has triangles and not the centers of cells.
bool has_triangles_alone(const CommonOptions& common);

/// Reads a mesh of triangles, and tells what was left out of it. \throws FileError
mesh::TriangleMesh read_triangles_of(const CommonOptions& common, Job& job);

/// Adds --least-depth.
CLI::Option* add_least_depth_option(CLI::App& parser, std::optional<double>& least_depth);
/// Makes nodes as deep as --least-depth wants them, if it is given, and tells how many were not.
/// \throws FileError with the name of the file if the mesh has no depths
/// \param source  the file that the depths are from
void require_least_depth(const std::optional<double>& least_depth, const std::string& source,
                         mesh::TriangleMesh& mesh);

/// Leaves out triangles on the border that OUTPUT cannot have, as they have no area in its degrees, and
/// tells how many. \throws FileError with the name of the file if none is left
/// \param positions  the sites in degrees, or empty: those of `sites`
/// \param constraints  edges that stay
/// \param source  the file of the sites
void leave_out_flat_triangles(const CommonOptions& common, std::span<const Point> sites,
                              std::span<const LonLat> positions,
                              std::span<const std::array<Index, 2>> constraints,
                              const std::string& source, std::vector<Triple>& triangles);

/// Writes OUTPUT, and tells what its format does not hold, and of nodes that models refuse. \throws FileError with the name of the file
/// that the triangles are from
/// \param source  that file
void write_triangles_of(const CommonOptions& common, const NetcdfOptions& netcdf,
                        const mesh::TriangleMesh& mesh, const std::string& source, Job& job);

/// Returns the depths of sites: the column `depth` (Depth, DEPTH) of their table, if files of the
/// format of OUTPUT have depths. Names in a remark the columns that are left out, unless OUTPUT is
/// indices of sites.
/// \throws FileError for a cell of that column that is no number
std::vector<double> depths_of_sites(const CommonOptions& common, const SiteTable& table);

/// Tells the names of the properties of features, which OUTPUT does not have, unless it is indices of
/// sites; of many, the first 12.
void tell_of_properties(const CommonOptions& common, const CellFacts& facts);

/// Writes the file of --report, unless there is none, in the format of its ending: .svg is a picture,
/// .txt is the text, and others are JSON.
void write_triangle_report(const std::string& path, const mesh::TriangleMesh& mesh);

/// Returns the numbers of nodes, triangles and segments.
nlohmann::ordered_json json_of_triangles(const mesh::TriangleMesh& mesh);
/// Returns the same for people: "5 nodes, 4 triangles; border: 1 open, 1 land, 0 island".
std::string text_of_triangles(const mesh::TriangleMesh& mesh);

}  // namespace rondel::cli
