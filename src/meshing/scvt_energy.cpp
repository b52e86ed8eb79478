// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/scvt_energy.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "exact/angles.h"
#include "exact/eft.h"
#include "meshing/density_nodes.h"
#include "system/parallel.h"

namespace rondel::mesh {
namespace {

using exact::DoubleDouble;

constexpr std::size_t cells_at_a_time = 1024;

// This is 8 pi in twice double precision.
constexpr DoubleDouble eight_pi = {8 * std::numbers::pi, 8 * 0x1.1a62633145c07p-53};

// Returns t / sin(t) for the arc t with this squared sine and cosine, 0 <= t < pi.
double arc_over_sine(double square, double cosine) {
  constexpr double series_limit = 0x1p-12;
  if (square > series_limit || cosine < 0) {
    const double sine = std::sqrt(square);
    return exact::argument(sine, cosine) / sine;
  }
  // This is asin(s)/s; the first omitted term is below (2^-12)^5 / 44.
  return 1 +
         square * (1.0 / 6 + square * (3.0 / 40 + square * (15.0 / 336 + square * (105.0 / 3456))));
}

// M = 1/2 sum (t / sin t) n x n'. Computed as (n' + n)/2 x (n' - n), n x n' has small rounding
// errors.
CellSums uniform_cell(const KineticDelaunay& surface, const Vector& z,
                      std::span<const Index> ring) {
  const auto centers = surface.centers();
  Vector moment{0, 0, 0};
  Vector last = exact::to_vector(centers[ring.back()]);
  for (const Index f : ring) {
    const Vector n = exact::to_vector(centers[f]);
    const Vector pole = 0.5 * cross(n + last, n - last);
    moment = moment + (0.5 * arc_over_sine(dot(pole, pole), dot(n, last))) * pole;
    last = n;
  }
  const double mass = dot(z, moment);
  return {moment, mass, mass, mass};
}

// Adds up the cells [begin, begin + cells.size()) with a constant density.
void add_uniform_cells(const KineticDelaunay& surface, std::span<const Point> sites,
                       std::size_t begin, std::span<CellSums> cells) {
  std::vector<Index> ring;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    surface.faces_around(static_cast<Index>(begin + i), ring);
    cells[i] = uniform_cell(surface, exact::to_vector(sites[begin + i]), ring);
  }
}

// Adds up the cells [begin, begin + cells.size()) with a density: their triangles follow each other
// in lanes.
void add_cells(const KineticDelaunay& surface, std::span<const Point> sites, std::size_t begin,
               const SizeFunction& size, std::span<CellSums> cells) {
  DensityNodes nodes(size);
  std::array<std::size_t, DensityNodes::lanes> owners{};
  std::size_t num_lanes = 0;
  const auto add_lanes = [&] {
    nodes.integrate();
    for (std::size_t k = 0; k < num_lanes; ++k) {
      CellSums& cell = cells[owners[k]];
      const CellSums part = nodes[k];
      cell.moment = cell.moment + part.moment;
      cell.mass += part.mass;
      cell.area += part.area;
      cell.energy += part.energy;
    }
    num_lanes = 0;
  };
  std::vector<Index> ring;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    surface.faces_around(static_cast<Index>(begin + i), ring);
    const Vector z = exact::to_vector(sites[begin + i]);
    Vector last = exact::to_vector(surface.centers()[ring.back()]) - z;
    for (const Index f : ring) {
      const Vector d = exact::to_vector(surface.centers()[f]) - z;
      nodes.set(num_lanes, z, last, d);
      owners[num_lanes] = i;
      if (++num_lanes == DensityNodes::lanes) add_lanes();
      last = d;
    }
  }
  add_lanes();
}

// The sums over a piece of the sites.
struct PieceSums {
  std::size_t num_fixed = 0;
  DoubleDouble energy{0, 0};
  double offsets = 0;
  double largest = 0;
};

}  // namespace

double CentroidalEnergy::noise(double energy) const {
  // The terms of 8 pi have rounding errors of 2^-52 of their size, a few of which may add up; the
  // others sum up to 2^-50 of theirs.
  return size_ == nullptr ? 0x1p-49 : 0x1p-44 * energy;
}

EnergyReport CentroidalEnergy::operator()(const KineticDelaunay& surface,
                                          std::span<const Point> sites,
                                          std::span<const std::uint8_t> axes,
                                          std::span<SiteSums> sums,
                                          std::span<const std::uint8_t> is_fixed) const {
  std::vector<PieceSums> pieces(system::num_pieces(sites.size(), cells_at_a_time));
  system::parallel_for(
      threads_, sites.size(), cells_at_a_time, [&](std::size_t begin, std::size_t end) {
        PieceSums piece;
        std::vector<CellSums> cells(end - begin, CellSums{});
        if (size_ == nullptr) {
          add_uniform_cells(surface, sites, begin, cells);
        } else {
          add_cells(surface, sites, begin, *size_, cells);
        }
        for (std::size_t i = begin; i < end; ++i) {
          const CellSums& cell = cells[i - begin];
          const TangentFrame frame = frame_at(sites[i], axes[i]);
          const TangentVector pull = {dot(cell.moment, frame.u), dot(cell.moment, frame.v)};

          const DoubleDouble total = exact::two_sum(piece.energy.hi, cell.energy);
          piece.energy = {total.hi, piece.energy.lo + total.lo};
          const double spacing = std::sqrt(cell.area * (2 / std::numbers::sqrt3));
          sums[i] = {{-2 * pull.u, -2 * pull.v}, cell.mass, spacing};
          if (!is_fixed.empty() && is_fixed[i] != 0) {
            sums[i].gradient = {0, 0};
            ++piece.num_fixed;
            continue;
          }
          const double offset = std::sqrt(dot(pull, pull)) / (cell.mass * spacing);
          piece.offsets += offset;
          piece.largest = std::max(piece.largest, offset);
        }
        pieces[begin / cells_at_a_time] = piece;
      });
  PieceSums all;
  for (const PieceSums& piece : pieces) {
    all.energy = all.energy + piece.energy;
    all.offsets += piece.offsets;
    all.largest = std::max(all.largest, piece.largest);
    all.num_fixed += piece.num_fixed;
  }
  const DoubleDouble energy = size_ == nullptr ? eight_pi - (all.energy + all.energy) : all.energy;
  const std::size_t num_free = std::max<std::size_t>(sites.size() - all.num_fixed, 1);
  return {energy.hi + energy.lo, all.offsets / static_cast<double>(num_free), all.largest};
}

}  // namespace rondel::mesh
