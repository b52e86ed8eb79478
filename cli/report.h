// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The report of a finished job: a summary for people or one JSON object for programs.
///
/// in    results, and seconds of wall time
/// out   texts that end with a newline
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "job.h"
#include "rondel/hull.h"
#include "rondel/out_of_core.h"

namespace rondel::cli {

/// Returns "1 site" or "2 sites".
std::string count(std::size_t number, const std::string& one, const std::string& many);

/// Returns a time in seconds with three decimals: "0.125 s".
std::string text_of_seconds(double seconds);

/// The remark on a file, or the error where something has to be in it.
inline constexpr const char* no_points = "there are no points";

/// Writes a reader's remarks on a file to standard error, one a line: "rondel: mesh.nc: 3 of 162
/// cells are ...".
void tell(const std::string& file, const std::vector<std::string>& remarks);
/// Writes remarks that begin with the names of their files: "rondel: mesh.nc: 3 of 162 ...".
void tell(const std::vector<std::string>& remarks);

/// Returns the JSON object of a triangulation, with a newline. Its keys are a contract. `unlocated`
/// is the number of features of the input that have no geometry, `without_value` that of vertices
/// without a value, which only commands that draw values report.
std::string json_report(const Triangulation& triangulation, const Seconds& seconds,
                        std::uint64_t unlocated, std::optional<std::size_t> without_value);

/// Returns the same, and what only a hull has: flat, volume, area.
std::string hull_json_report(const Triangulation& hull, const HullSize& size,
                             const Seconds& seconds);

/// Returns a few lines: what was read, what resulted, what was written and how long it took.
/// \param what  what was written: "the triangulation"
/// \param output  the file to which it was written
std::string summary(const Triangulation& triangulation, const Seconds& seconds,
                    const std::string& what, const std::string& output);

/// Return the same for a run out of core.
std::string out_of_core_json_report(const OutOfCoreReport& report, Model model,
                                    const Seconds& seconds);
std::string out_of_core_summary(const OutOfCoreReport& report, Model model, const Seconds& seconds,
                                const std::string& output);

/// Returns the lines of a hull, with its volume and area in units of the points.
std::string hull_summary(const Triangulation& hull, const HullSize& size, const Seconds& seconds,
                         const std::string& output);

}  // namespace rondel::cli
