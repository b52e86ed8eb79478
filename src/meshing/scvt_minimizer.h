// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Minimizes the energy of a tessellation by L-BFGS in the coordinates of the tangent planes. The
// first approximation of the inverse Hessian comes from springs along the edges (edge_springs.h).
// With Lloyd's step to the centroids instead (Yang, Gunzburger and Ju, J. Comput. Phys. 367, 2018)
// it takes three times as many steps from random sites.
//
// in    sites as unit vectors, which of them are fixed, limits
// out   sites of a local minimum, and how the work ended
// index sites
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "meshing/edge_springs.h"
#include "meshing/kinetic_delaunay.h"
#include "meshing/scvt_energy.h"
#include "meshing/step_memory.h"
#include "meshing/tangent.h"
#include "rondel/types.h"

namespace rondel::mesh {

// When the work ends: converged if both offsets are reached or the energy changes by less than a
// part.
struct MinimizerLimits {
  double mean_offset = 0;  // upper bound of EnergyReport::mean_offset
  // upper bound of EnergyReport::largest_offset
  double largest_offset = 0;
  double energy_change = 0;  // relative change in one step; 0: this never ends the work
  int iterations = 0;
  bool lloyd = false;  // take steps to the centroids only
};

enum class MinimizerEnd : std::uint8_t { converged, iterations, stopped, stuck };

// A function that is called after every step; it returns false to end the work.
using StepCallback = std::function<bool(int iteration, const EnergyReport& report)>;

// The state of a minimization: the sites with their triangulation, energy and gradient.
class Minimizer {
 public:
  // Sites whose `is_fixed` is not 0 stay bit by bit; it is empty if no site is fixed.
  Minimizer(std::vector<Point> sites, const CentroidalEnergy& energy, unsigned threads,
            std::vector<std::uint8_t> is_fixed = {});

  // Takes steps until a limit is reached, `on_step` returns false, or no step lowers the energy
  // further.
  MinimizerEnd run(const MinimizerLimits& limits, const StepCallback& on_step);

  [[nodiscard]] const std::vector<Point>& sites() const { return sites_; }
  [[nodiscard]] const KineticDelaunay& surface() const { return surface_; }
  [[nodiscard]] const EnergyReport& report() const { return report_; }
  [[nodiscard]] int iterations() const { return iterations_; }

 private:
  // Sets the direction of the next step.
  void direct(bool lloyd);
  template <class Change>
  void for_all(const Change& change);  // calls change(i) for every site
  [[nodiscard]] bool is_fixed(std::size_t site) const {
    return !is_fixed_.empty() && is_fixed_[site] != 0;
  }
  // Turns direction_, which holds the gradient, into the step to the centroids.
  void scale_by_mass();
  // Returns the derivative of the energy along direction_.
  [[nodiscard]] double slope() const;
  // Returns the longest step of a site in units of its spacing.
  [[nodiscard]] double max_relative_step() const;
  // Moves the sites along direction_ such that the energy falls enough; returns false if no length
  // is found.
  bool search();
  // Does the same along the step to the centroids.
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
  KineticDelaunay surface_;
  EdgeSprings springs_;
  int iterations_ = 0;
};

}  // namespace rondel::mesh
