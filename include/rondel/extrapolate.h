// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Values for targets that interpolation or remapping leaves without one (target rondel::geo).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "rondel/compressed_rows.h"
#include "rondel/export.h"
#include "rondel/types.h"
#include "rondel/weights.h"

namespace rondel {

/// Where a target without a value gets one from: the methods of ESMF.
enum class Extrapolation : std::uint8_t {
  nearest,  ///< the nearest source with a value; of several the one with the lowest index
  idw,      ///< the nearest sources with values, weighted by a power of the inverse distance
  /// The mean of the neighboring targets that have a value, level by level: those of level 1 have
  /// neighbors with values, those of level 2 neighbors of level 1 ... (creeping fill).
  creep,
};

/// Returns the name of a value: "nearest", "idw", "creep"; empty for other numbers.
RONDEL_API std::string_view name_of(Extrapolation method) noexcept;
/// Returns the method of a name, also of those that ESMF and xESMF have: "nearest_s2d",
/// "inverse_dist", "creep_fill"; nothing for other names.
RONDEL_API std::optional<Extrapolation> extrapolation_named(std::string_view name);

struct ExtrapolationOptions {
  Extrapolation method = Extrapolation::nearest;
  /// How far the sources may be that give values; with creep, how far the nearest source with a
  /// value may be from a target. In kilometers along the sphere (kilometers_per_radian); without it,
  /// any distance.
  std::optional<double> max_distance_km = std::nullopt;
  unsigned neighbors = 8;  ///< idw: the number of sources
  unsigned exponent = 2;   ///< idw: the power of the distance, a chord of the sphere; at most 100
  unsigned levels = 0;     ///< creep: how many levels are filled; 0: all that can be
};

/// Returns the neighbors of the places of a grid of `rows` by `columns`: one before and one behind
/// in each dimension. The last column is beside the first one where it is, in every row, at most
/// 1.5 times as far from it as the farthest neighbors of the row are from each other.
/// \param places  row by row
/// \throws InvalidInput if there are not as many places
RONDEL_API CompressedRows<Index> grid_neighbors(std::span<const Point> places, std::size_t rows,
                                                std::size_t columns);
/// Returns the neighbors of any places: those that share an edge of their Delaunay triangulation.
/// Where several are in one direction, the first one has these neighbors and the others, and each other
/// one has the first. Unknown places, (0, 0, 0), have none.
/// \throws InvalidInput as delaunay() does
RONDEL_API CompressedRows<Index> place_neighbors(std::span<const Point> places,
                                                 const Execution& execution = {});

/// Returns grid_neighbors() if the shape has two dimensions, else place_neighbors().
/// \param shape  the lengths of the dimensions, the last one changing fastest
RONDEL_API CompressedRows<Index> target_neighbors(std::span<const Point> places,
                                                  std::span<const std::uint64_t> shape,
                                                  const Execution& execution = {});
/// Returns unit vectors, or (0, 0, 0) for places whose longitude or latitude is missing (NaN).
/// \throws InvalidInput as unit_vectors() does for others
RONDEL_API std::vector<Point> known_unit_vectors(std::span<const LonLat> places);

/// Fills in values, field by field.
///
/// 1. A target gets a value if it has none (NaN) and takes part. It gets it from the sources that
///    have a value in this field, whatever other fields have: a source is masked by its missing
///    value, at the time of the field.
/// 2. Sources that are masked give no value, targets that are masked get and pass on none.
/// 3. Targets beyond the distance, the levels, or without any source keep their missing value.
/// 4. The bytes are the same on every machine and for any number of threads.
///
/// Successive fields with the same gaps share one search. One object may be used by one thread at a
/// time.
class RONDEL_API Extrapolator {
 public:
  /// \param sources  unit vectors; places that are unknown are (0, 0, 0)
  /// \param targets  unit vectors; the same holds
  /// \param neighbors  of the targets, for creep: grid_neighbors() or place_neighbors(); else empty.
  ///                   Two targets are neighbors if each names the other
  /// \param source_mask  0: takes no part; empty: all do
  /// \throws InvalidInput if lengths do not fit, `neighbors` is 0, `exponent` is not from 1 to 100, or
  ///         the distance is negative or not a number
  Extrapolator(std::vector<Point> sources, std::vector<Point> targets,
               CompressedRows<Index> neighbors, const ExtrapolationOptions& options,
               std::vector<std::int32_t> source_mask = {},
               std::vector<std::int32_t> target_mask = {});
  ~Extrapolator();
  Extrapolator(Extrapolator&& other) noexcept;
  Extrapolator& operator=(Extrapolator&& other) noexcept;

  /// Fills in the values of one field at the targets, and returns how many got one.
  /// \param source_values  one for each source; NaN is missing
  /// \param target_values  one for each target
  /// \throws InvalidInput if there are not as many values
  std::size_t fill(std::span<const double> source_values, std::span<double> target_values,
                   const Execution& execution = {});

  /// Returns weights with rows in place of the empty ones: for fields without missing values they
  /// do what fill() does, up to rounding. The hashes are kept.
  /// \throws InvalidInput if the weights have another shape
  [[nodiscard]] Weights filled(const Weights& weights, const Execution& execution = {});

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rondel
