// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Interpolation of one field after another.
///
/// in    values at sites; NaN where there is none
/// out   values at targets
/// index sites and targets in the order of their files
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "edge_table.h"
#include "job.h"
#include "rondel/constrained_interpolate.h"
#include "rondel/extrapolate.h"
#include "rondel/interpolate.h"
#include "targets.h"

namespace rondel::cli {

/// The numbers of the report.
struct InterpolateCounts {
  std::size_t sites = 0;
  std::size_t targets = 0;
  std::size_t duplicates = 0;    ///< sites in the place of another one
  std::size_t left_out = 0;      ///< values of sites that are not there
  std::size_t missing = 0;       ///< values of targets, or rows, that are not there
  std::size_t extrapolated = 0;  ///< values of targets, or rows, that were extrapolated
};

/// What a command interpolates with, and the edges that it keeps to.
struct InterpolateMethod {
  const InterpolationOptions& options;
  const EdgeTable* edges;  ///< of --constraints; null: faces are Delaunay
};

/// Triangulates the sites and counts their duplicates. \throws FileError for two sites in one
/// place, if the options say so
Triangulation triangulated(Job& job, const InterpolationOptions& options, const SiteTable& table,
                           InterpolateCounts& counts);

/// Returns the edges between the sites that are kept, under their new indices.
/// \throws FileError for an edge with an end that is not kept
EdgeTable kept_edges(const EdgeTable& edges, const SiteTable& table,
                     const std::vector<bool>& is_kept);

/// Interpolates on the Delaunay triangulation of the sites of a table, or on one with given edges.
class TableInterpolator {
 public:
  /// Triangulates, and counts duplicates. \throws FileError for sites and edges that are refused
  TableInterpolator(Job& job, const InterpolateMethod& method, const SiteTable& table,
                    InterpolateCounts& counts);

  [[nodiscard]] std::vector<double> values(std::span<const double> field,
                                           std::span<const Point> targets,
                                           const Execution& execution) const;
  [[nodiscard]] Weights weights(std::span<const Point> targets, const Execution& execution) const;
  /// Precondition: no edges are given.
  [[nodiscard]] const Triangulation& delaunay() const { return delaunay_; }

 private:
  using Either = std::variant<Interpolator, ConstrainedInterpolator>;
  Either made(Job& job, const InterpolateMethod& method, const SiteTable& table,
              InterpolateCounts& counts);

  InterpolationOptions options_;
  LinearOptions linear_;
  Triangulation delaunay_;
  Either either_;
};

/// Interpolates fields at the targets. Methods of regridding have weights. All fields without gaps
/// share one triangulation; successive fields with the same gaps share another one.
class FieldCarrier {
 public:
  /// \param weights  those of a method of regridding
  /// \param extrapolator  gives values to targets that have none; null: they stay so
  FieldCarrier(Job& job, const InterpolateMethod& method, const SiteTable& table,
               const Targets& targets, const std::optional<Weights>& weights,
               Extrapolator* extrapolator, InterpolateCounts& counts)
      : job_(job),
        method_(method),
        table_(table),
        targets_(targets),
        weights_(weights),
        extrapolator_(extrapolator),
        counts_(counts) {}

  /// Returns the values at the targets.
  std::vector<double> carry(const std::vector<double>& values);

 private:
  std::vector<double> interpolated(std::vector<double> values);

  Job& job_;
  InterpolateMethod method_;
  const SiteTable& table_;
  const Targets& targets_;
  const std::optional<Weights>& weights_;  // of a method of regridding
  Extrapolator* extrapolator_;
  InterpolateCounts& counts_;
  std::optional<TableInterpolator> whole_;
  std::optional<TableInterpolator> partial_;
  SiteTable kept_;  // the sites of `partial_`
  std::vector<bool> is_known_;
};

}  // namespace rondel::cli
