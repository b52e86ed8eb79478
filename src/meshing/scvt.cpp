// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/scvt.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "meshing/fixed_sites.h"
#include "meshing/scvt_energy.h"
#include "meshing/scvt_levels.h"
#include "meshing/scvt_minimizer.h"
#include "meshing/scvt_repair.h"
#include "rondel/error.h"
#include "system/arithmetic.h"
#include "system/job.h"
#include "system/message_text.h"

namespace rondel::mesh {
namespace {

// The fewest sites of a tessellation that is made from nothing: the corners of an icosahedron.
constexpr std::size_t fewest_sites = 12;
// The size of the coarsest level: few enough sites for several starts, and enough of them to follow
// the density. Disorder of that level stays: among 40,962 sites with fourfold density, 1,000 had 5
// or 7 neighbors after a start with 2,562 sites, and 100 after one with 642.
constexpr std::size_t coarsest_uniform = 100;
constexpr std::size_t coarsest_of_density = 400;
constexpr int num_starts = 8;
constexpr int num_starts_of_density = 3;
constexpr double tolerance_of_starts = 1e-3;

// Returns the public name of how the minimizer ended.
constexpr ScvtEnd end_of(MinimizerEnd end) {
  switch (end) {
    case MinimizerEnd::converged:
      return ScvtEnd::converged;
    case MinimizerEnd::iterations:
      return ScvtEnd::iterations;
    case MinimizerEnd::stopped:
      return ScvtEnd::stopped;
    case MinimizerEnd::stuck:
      break;
  }
  return ScvtEnd::stuck;
}

// Solves the levels one after the other and reports the progress.
class Levels {
 public:
  Levels(const ScvtOptions& options, const Execution& execution)
      : options_(options),
        execution_(execution),
        size_(options.size ? &*options.size : nullptr),
        energy_(size_, execution.threads) {}

  Scvt solve(std::size_t count) {
    const std::vector<std::size_t> counts = counts_of_levels(count, fewest(count));
    for (const std::size_t of_level : counts) all_work_ += static_cast<double>(of_level);
    Scvt result;
    result.sites = start(counts.front());
    for (std::size_t k = 0; k < counts.size(); ++k) {
      if (k > 0) result.sites = refined_sites(result.sites, counts[k], size_, execution_.threads);
      if (k + 1 == counts.size()) {
        fix(result);
        finish(result);
      } else {
        relax(result, false);
        if (result.end == ScvtEnd::stopped) break;
      }
    }
    return result;
  }

  // Completes the result for sites that the caller has given.
  void finish_given(Scvt& result) {
    is_given_ = true;
    fix(result);
    finish(result);
  }

 private:
  // Moves sites to the fixed places.
  void fix(Scvt& result) {
    result.fixed = take_nearest(result.sites, options_.fixed, execution_.threads);
    if (result.fixed.empty()) return;
    is_fixed_.assign(result.sites.size(), 0);
    for (const Index site : result.fixed) is_fixed_[site] = 1;
  }

  void finish(Scvt& result) {
    relax(result, true);
    const bool is_solved = result.end == ScvtEnd::converged || result.end == ScvtEnd::stuck;
    if (options_.repair && is_solved) {
      result.repair = repair(result.sites, is_fixed_, execution_.threads);
    }
  }

  void relax(Scvt& result, bool is_last) {
    Minimizer minimizer = minimizer_of(std::move(result.sites), execution_.threads, is_fixed_);
    MinimizerLimits limits{.mean_offset = options_.mean_tolerance,
                           .largest_offset = options_.largest_tolerance,
                           .energy_change = options_.energy_tolerance,
                           .iterations = options_.max_iterations,
                           .lloyd = options_.method == ScvtMethod::lloyd};
    if (!is_last) limits.largest_offset = std::numeric_limits<double>::infinity();
    const EnergyReport first = minimizer.report();
    const auto work = static_cast<double>(minimizer.sites().size());
    const auto see = [&](int iteration, const EnergyReport& report) {
      const double part = part_of_level(limits, first, report, iteration);
      done_ = std::max(done_, is_last ? 1 - (1 - part) * work / std::max(work, all_work_)
                                      : (past_work_ + part * work) / all_work_);
      result.last = {minimizer.sites().size(), iteration, report.energy, report.mean_offset,
                     report.largest_offset,    done_};
      if (options_.on_step) options_.on_step(result.last);
      return execution_.stop == nullptr || !execution_.stop->load();
    };
    const bool goes_on = see(0, minimizer.report());
    result.end = goes_on ? end_of(minimizer.run(limits, see)) : ScvtEnd::stopped;
    past_work_ += work;
    result.sites = minimizer.sites();
    result.builds += minimizer.surface().num_builds();
    result.flips += minimizer.surface().num_flips();
  }

  // Offsets fall by about the same factor in each step, so the work done is measured by their
  // logarithm.
  static double part_of_level(const MinimizerLimits& limits, const EnergyReport& first,
                              const EnergyReport& now, int iteration) {
    // This logarithm is exact at powers of two and linear between them, and so the same on every
    // machine.
    const auto digits = [](double x) {
      int exponent = 0;
      const double mantissa = std::frexp(x, &exponent);
      return exponent + 2 * mantissa;
    };
    const auto part = [&](double at_first, double at_last, double present) {
      if (present <= at_last) return 1.0;
      if (!(present < at_first)) return 0.0;
      return (digits(at_first) - digits(present)) / (digits(at_first) - digits(at_last));
    };
    const double of_steps =
        limits.iterations == 0 ? 1 : static_cast<double>(iteration) / limits.iterations;
    return std::max(
        of_steps, std::min(part(first.mean_offset, limits.mean_offset, now.mean_offset),
                           part(first.largest_offset, limits.largest_offset, now.largest_offset)));
  }

  // True for 12, 42, 162 ...: the numbers of sites of an icosahedron whose edges are halved again
  // and again.
  static bool is_of_icosahedron(std::size_t count) {
    std::size_t edges = count - 2;
    while (edges % 4 == 0 && edges > 10) edges /= 4;
    return edges == 10;
  }

  [[nodiscard]] std::size_t fewest(std::size_t count) const {
    if (size_ == nullptr) return is_of_icosahedron(count) ? fewest_sites : coarsest_uniform;
    return coarsest_of_density;
  }

  // Throws InvalidInput if the spacings have put all sites into a part of the sphere, where there
  // is no tessellation.
  [[nodiscard]] Minimizer minimizer_of(std::vector<Point> sites, unsigned threads,
                                       std::vector<std::uint8_t> is_fixed = {}) const {
    const std::size_t count = sites.size();
    try {
      return {std::move(sites), energy_, threads, std::move(is_fixed)};
    } catch (const InvalidInput&) {
      if (size_ == nullptr || is_given_) throw;
      throw InvalidInput("the spacings change too fast: from " + std::to_string(size_->smallest()) +
                             " to " + std::to_string(size_->largest()) +
                             " radians, they leave the " + std::to_string(count) +
                             " sites of a level on one side of the sphere; let them grow more "
                             "slowly (--gradient, gradient=, SizeFunction::limited())",
                         0);
    }
  }

  // Returns the sites with the least energy of several starts.
  [[nodiscard]] std::vector<Point> start(std::size_t count) const {
    if (size_ == nullptr && count == fewest_sites) return icosahedron();
    const MinimizerLimits limits{.mean_offset = tolerance_of_starts,
                                 .largest_offset = std::numeric_limits<double>::infinity(),
                                 .energy_change = 0,
                                 .iterations = options_.max_iterations};
    std::vector<Point> best;
    double least = std::numeric_limits<double>::infinity();
    for (int seed = 1; seed <= (size_ == nullptr ? num_starts : num_starts_of_density); ++seed) {
      Minimizer minimizer = minimizer_of(
          in_spatial_order(sampled_sites(count, size_, static_cast<std::uint64_t>(seed)), 1), 1);
      (void)minimizer.run(limits, [](int, const EnergyReport&) { return true; });
      if (minimizer.report().energy >= least) continue;
      least = minimizer.report().energy;
      best = minimizer.sites();
    }
    return best;
  }

  const ScvtOptions& options_;
  const Execution& execution_;
  const SizeFunction* size_;
  CentroidalEnergy energy_;
  std::vector<std::uint8_t> is_fixed_;  // for the last level; empty if no site is fixed
  // The numbers of sites of all levels and of those that are finished, and the last ScvtStep::done.
  double all_work_ = 0;
  double past_work_ = 0;
  double done_ = 0;
  bool is_given_ = false;
};

// Throws InvalidInput if a fixed place is not valid, or there are more of them than sites.
void require_fixed(std::span<const Point> fixed, std::size_t count) {
  require_places(fixed, "a fixed place");
  if (fixed.size() <= count) return;
  throw InvalidInput("there are " + std::to_string(fixed.size()) + " fixed places for " +
                         std::to_string(count) + " sites",
                     count);
}

// Throws InvalidInput for a number of steps that is negative, or spacings that are not known on the
// whole sphere.
void require_valid(const ScvtOptions& options) {
  if (options.size && options.size->raster().region) {
    throw InvalidInput("a tessellation covers the sphere, and its spacings are those of a region");
  }
  if (options.max_iterations >= 0) return;
  throw InvalidInput("the largest number of steps is negative: " +
                     std::to_string(options.max_iterations));
}

}  // namespace

std::string_view name_of(ScvtMethod method) noexcept {
  return system::name_in({"lbfgs", "lloyd"}, method);
}

std::string_view name_of(ScvtEnd end) noexcept {
  return system::name_in({"converged", "iterations", "stopped", "stuck"}, end);
}

Scvt scvt(const ScvtOptions& options, const Execution& execution) {
  const system::ArithmeticScope arithmetic;
  require_valid(options);
  std::size_t count = options.count;
  if (count == 0 && options.size) {
    count = static_cast<std::size_t>(
        std::min(options.size->count() + 0.5, static_cast<double>(max_sites) + 1));
  }
  if (count < fewest_sites || count > max_sites) {
    throw InvalidInput("a tessellation has from 12 to " + std::to_string(max_sites) +
                           " sites, not " + std::to_string(count),
                       0);
  }
  require_fixed(options.fixed, count);
  return Levels(options, execution).solve(count);
}

Scvt relax(std::span<const Point> sites, const ScvtOptions& options, const Execution& execution) {
  const system::ArithmeticScope arithmetic;
  require_valid(options);
  Scvt result;
  require_places(sites, "a site");
  result.sites = unit_places(sites);
  if (sites.size() < 4) throw InvalidInput("a tessellation that is relaxed has 4 sites or more");
  require_fixed(options.fixed, sites.size());
  Levels levels(options, execution);
  levels.finish_given(result);
  return result;
}

double energy_over_hexagons(double energy, std::size_t num_sites) noexcept {
  const double hexagons = 5 / (18 * std::numbers::sqrt3) * 16 * std::numbers::pi * std::numbers::pi;
  return energy * static_cast<double>(num_sites) / hexagons;
}

}  // namespace rondel::mesh
