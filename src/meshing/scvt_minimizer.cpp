// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/scvt_minimizer.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "rondel/delaunay.h"
#include "rondel/error.h"

namespace rondel::mesh {
namespace {

// The energy has to fall by at least this part of the slope times the step.
constexpr double sufficient_fall = 1e-4;
// No site moves by more than this part of its spacing in one step.
constexpr double longest_move = 0.5;
constexpr int max_trials = 12;

}  // namespace

Minimizer::Minimizer(std::vector<Point> sites, const CentroidalEnergy& energy, unsigned threads,
                     std::vector<std::uint8_t> is_fixed)
    : energy_(energy),
      threads_(threads),
      sites_(std::move(sites)),
      is_fixed_(std::move(is_fixed)),
      axes_(sites_.size()),
      sums_(sites_.size()),
      tried_sites_(sites_.size()),
      tried_sums_(sites_.size()),
      direction_(sites_.size()),
      memory_(threads),
      surface_(threads),
      springs_(threads) {
  std::ranges::transform(sites_, axes_.begin(), far_axis);
  if (!surface_.update(sites_)) {
    const Triangulation projected =
        delaunay(Sites::view(sites_), {}, Execution{.threads = threads});
    if (projected.duplicates().empty()) {
      throw InvalidInput("the sites do not surround the center of the sphere");
    }
    const auto [site, first] = projected.duplicates().front();
    throw InvalidInput(
        "site " + std::to_string(site) + " is in the place of site " + std::to_string(first), site);
  }
  report_ = energy_(surface_, sites_, axes_, sums_, is_fixed_);
}

template <class Change>
void Minimizer::for_all(const Change& change) {
  system::parallel_for(threads_, sites_.size(), terms_at_a_time,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) change(i);
                       });
}

// Turns the gradient into a step to the centroids.
void Minimizer::scale_by_mass() {
  for_all([&](std::size_t i) {
    const double scale = 1 / (2 * sums_[i].mass);
    direction_[i] = {scale * direction_[i].u, scale * direction_[i].v};
  });
}

void Minimizer::direct(bool lloyd) {
  for_all([&](std::size_t i) { direction_[i] = {-sums_[i].gradient.u, -sums_[i].gradient.v}; });
  if (lloyd) memory_.forget();
  memory_.begin_product(direction_);
  if (lloyd) {
    scale_by_mass();
  } else {
    springs_.measure(surface_, sites_, sums_);
    springs_.yield(sites_, axes_, direction_);
    for_all([&](std::size_t i) {
      if (is_fixed(i)) direction_[i] = {0, 0};
    });
  }
  memory_.end_product(direction_);
}

double Minimizer::slope() const {
  return sum_in_order(threads_, sites_.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum += dot(sums_[i].gradient, direction_[i]);
    return sum;
  });
}

// Returns the longest step of a site in units of the spacing of its cell.
double Minimizer::max_relative_step() const {
  std::vector<double> most(system::num_pieces(sites_.size(), terms_at_a_time));
  system::parallel_for(
      threads_, sites_.size(), terms_at_a_time, [&](std::size_t begin, std::size_t end) {
        double of_piece = 0;
        for (std::size_t i = begin; i < end; ++i) {
          const double square = dot(direction_[i], direction_[i]);
          of_piece = std::max(of_piece, square / (sums_[i].spacing * sums_[i].spacing));
        }
        most[begin / terms_at_a_time] = of_piece;
      });
  return std::sqrt(*std::ranges::max_element(most));
}

// Tries lengths along the direction until the energy falls enough, and moves the sites there.
bool Minimizer::search() {
  const double along = slope();
  if (!(along < 0)) return false;
  double length = std::min(1.0, longest_move / max_relative_step());
  for (int trial = 0; trial < max_trials; ++trial) {
    for_all([&](std::size_t i) {
      tried_sites_[i] = is_fixed(i) ? sites_[i]
                                    : moved(sites_[i], axes_[i],
                                            {length * direction_[i].u, length * direction_[i].v});
    });
    double shorter = 0.5;
    if (surface_.update(tried_sites_)) {
      tried_report_ = energy_(surface_, tried_sites_, axes_, tried_sums_, is_fixed_);
      const double rise = tried_report_.energy - report_.energy;
      if (rise <= sufficient_fall * length * along + energy_.noise(report_.energy)) {
        memory_.remember(length, direction_, sums_, tried_sums_);
        sites_.swap(tried_sites_);
        sums_.swap(tried_sums_);
        report_ = tried_report_;
        return true;
      }
      // This is the lowest point of the parabola through both energies and the slope.
      const double curvature = rise - length * along;
      if (curvature > 0) shorter = std::clamp(-0.5 * length * along / curvature, 0.1, 0.5);
    }
    length *= shorter;
  }
  return false;
}

// Takes the step to the centroids, which lowers the energy whatever the pairs are.
bool Minimizer::search_anew() {
  direct(true);
  return search();
}

MinimizerEnd Minimizer::run(const MinimizerLimits& limits, const StepCallback& on_step) {
  for (int i = 0;; ++i) {
    if (report_.mean_offset <= limits.mean_offset &&
        report_.largest_offset <= limits.largest_offset) {
      return MinimizerEnd::converged;
    }
    if (i == limits.iterations) return MinimizerEnd::iterations;
    const double before = report_.energy;
    direct(limits.lloyd);
    if (!search() && (memory_.size() == 0 || !search_anew())) {
      if (!surface_.update(sites_)) throw std::logic_error("sites lost their triangulation");
      return MinimizerEnd::stuck;
    }
    ++iterations_;
    if (!on_step(iterations_, report_)) return MinimizerEnd::stopped;
    if (before - report_.energy <= limits.energy_change * report_.energy &&
        limits.energy_change > 0) {
      return MinimizerEnd::converged;
    }
  }
}

}  // namespace rondel::mesh
