// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Minimizes the energy of a tessellation: L-BFGS in the coordinates of the tangent planes, whose first guess of
// the inverse Hessian is that of springs along the edges (edge_springs.h). Lloyd's step, to the centroids, in this place
// (Yang, Gunzburger and Ju, J. Comput. Phys. 367, 2018) takes three times as many steps from random sites.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "meshing/edge_springs.h"
#include "meshing/scvt_energy.h"
#include "meshing/scvt_surface.h"
#include "meshing/step_memory.h"
#include "meshing/tangent.h"
#include "rondel/types.h"

namespace rondel::mesh {

struct MinimizerLimits {
  double mean_offset = 0;  // both must be reached
  double largest_offset = 0;
  double energy_change = 0;  // or this, relative, in one step; 0: never
  int iterations = 0;
  bool lloyd = false;  // steps to the centroids alone
};

enum class MinimizerEnd : std::uint8_t { converged, iterations, stopped, stuck };

// Called after every step; false ends the work.
using StepSeen = std::function<bool(int iteration, const EnergyReport& report)>;

class Minimizer {
 public:
  // Sites whose `is_fixed` is not 0 stay where they are, bit by bit; empty: none.
  Minimizer(std::vector<Point> sites, const CentroidalEnergy& energy, unsigned threads,
            std::vector<std::uint8_t> is_fixed = {});

  MinimizerEnd run(const MinimizerLimits& limits, const StepSeen& seen);

  [[nodiscard]] const std::vector<Point>& sites() const { return sites_; }
  [[nodiscard]] const MovingSurface& surface() const { return surface_; }
  [[nodiscard]] const EnergyReport& report() const { return report_; }
  [[nodiscard]] int iterations() const { return iterations_; }

 private:
  void direct(bool lloyd);
  template <class Change>
  void for_all(const Change& change);  // change(i) for every site
  [[nodiscard]] bool is_fixed(std::size_t site) const {
    return !is_fixed_.empty() && is_fixed_[site] != 0;
  }
  void scale_by_mass();
  [[nodiscard]] double slope() const;
  [[nodiscard]] double most_relative_step() const;
  bool search();
  bool search_anew();

  const CentroidalEnergy& energy_;
  unsigned threads_;
  std::vector<Point> sites_;
  std::vector<std::uint8_t> is_fixed_;
  std::vector<std::uint8_t> axes_;
  std::vector<SiteSums> sums_;
  EnergyReport report_;
  std::vector<Point> tried_sites_;
  std::vector<SiteSums> tried_sums_;
  EnergyReport tried_report_;
  std::vector<TangentVector> direction_;
  StepMemory memory_;
  MovingSurface surface_;
  EdgeSprings springs_;
  int iterations_ = 0;
};

}  // namespace rondel::mesh
