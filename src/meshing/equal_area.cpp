// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The cell of site i is {x : x.p_i >= x.p_j for all j} with p_i = w_i q_i: the directions in which
// p_i is the farthest corner of the hull. With t the angle between the ends v, v' of the wall of i
// and j,
//
//     d area_i / d log w_j = - tan(t/2) p_i.(v + v') / |p_i - p_j|,
//
// which is negative and the same for i and j, as p_i.v = p_j.v on the wall: the derivatives form a
// graph Laplacian. A step x of log w becomes the factor (2 + x) / (2 - x). Weights have twice
// double precision, and the lengths of the p_i that represent them nearly so (weighted_site.h); the
// least weight is 1.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "exact/angles.h"
#include "exact/eft.h"
#include "exact/vector.h"
#include "meshing/equal_lunes.h"
#include "meshing/graph_laplacian.h"
#include "meshing/weighted_site.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/error.h"
#include "rondel/mesh_equal_area.h"
#include "system/arithmetic.h"
#include "system/message_text.h"
#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel::mesh {
namespace {

using exact::DoubleDouble;
using exact::to_point;
using exact::to_vector;
using FineWeights = std::vector<DoubleDouble>;

// A step is halved, at most so often, until it lowers the errors and leaves no cell too small.
// Newton's equations are solved until the residual is `inner_tolerance` times the right-hand side.
constexpr int max_halvings = 20;
constexpr double inner_tolerance = 1e-4;
constexpr int max_inner_steps = 500;
constexpr std::size_t poles_at_a_time = 1024;

// Weighted sites with the areas of their cells, and how far these are from the wanted ones.
struct Weighted {
  std::vector<Point> poles;
  Triangulation triangulation;
  std::vector<double> areas;
  double smallest_area = 0;
  double square_error = 0;
  double largest_error = 0;  // largest relative error of an area
  Index worst = no_index;
};

// Sets the sum of squared errors, the largest relative error and the smallest area.
void measure_errors(Weighted& now, const std::vector<double>& targets) {
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const double error = now.areas[i] - targets[i];
    now.square_error += error * error;
    if (std::abs(error) / targets[i] <= now.largest_error) continue;
    now.largest_error = std::abs(error) / targets[i];
    now.worst = static_cast<Index>(i);
  }
}

// Computes Newton's steps for the logarithms of the weights.
class Newton {
 public:
  Newton(std::vector<Point> sites, std::vector<double> targets, const Execution& execution)
      : sites_(std::move(sites)), targets_(std::move(targets)), execution_(execution) {
    min_target_ = *std::ranges::min_element(targets_);
  }

  // Returns the cells of weighted sites near those given, or nothing if a cell is empty or the hull
  // does not surround the center.
  [[nodiscard]] std::optional<Weighted> measure(const FineWeights& weights,
                                                const std::vector<Point>& near) const {
    Weighted now;
    now.poles.resize(sites_.size());
    system::parallel_for(execution_.threads, sites_.size(), poles_at_a_time,
                         [&](std::size_t begin, std::size_t end) {
                           for (std::size_t i = begin; i < end; ++i) {
                             now.poles[i] =
                                 weighted_site(near[i], weights[i], std::sqrt(targets_[i]));
                           }
                         });
    const Execution quiet{.threads = execution_.threads};
    now.triangulation = delaunay(Sites::view(now.poles), {.model = Model::weighted}, quiet);
    if (now.triangulation.dimension() != 2 || now.triangulation.num_ghost_faces() != 0 ||
        now.triangulation.num_vertices() != sites_.size()) {
      return std::nullopt;
    }
    now.areas = areas(now.triangulation, quiet);
    now.smallest_area = *std::ranges::min_element(now.areas);
    if (!(now.smallest_area > 0)) return std::nullopt;
    measure_errors(now, targets_);
    return now;
  }

  // A step of Newton's method for all weights at once.
  struct NewtonStep {
    std::vector<double> of_log;  // change of log w
    double rounding;  // relative error of areas that comes from rounding weights to doubles
  };
  // Returns Newton's step. The rounding errors are 2^-53 of the weights of a cell and of its
  // neighbors.
  [[nodiscard]] NewtonStep step_from(const Weighted& now) const {
    std::vector<double> right(sites_.size());
    for (std::size_t i = 0; i < sites_.size(); ++i) right[i] = targets_[i] - now.areas[i];
    WeightedGraph graph = graph_of(now);
    NewtonStep step{{}, 0};
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      step.rounding = std::max(step.rounding, 0x1p-51 * graph.diagonal[i] / targets_[i]);
    }
    LaplacianSolver solver(std::move(graph), execution_.threads);
    solver.solve(right, inner_tolerance, max_inner_steps, step.of_log);
    return step;
  }

  [[nodiscard]] double min_target() const { return min_target_; }

 private:
  // Returns the graph whose Laplacian has the derivatives of the areas by the logarithms of the
  // weights; an edge is a wall.
  [[nodiscard]] WeightedGraph graph_of(const Weighted& now) const {
    const Execution quiet{.threads = execution_.threads};
    const std::vector<Point> centers = circumcenters(now.triangulation, quiet);
    const auto faces = now.triangulation.faces();
    const auto neighbors = now.triangulation.neighbors();
    WeightedGraph graph;
    system::RowPlaces places(sites_.size());
    for (const Triple& face : faces) {
      for (const Index v : face) places.count(v);
    }
    graph.neighbors.resize(places.sum());
    graph.weights.resize(graph.neighbors.size());
    graph.diagonal.assign(sites_.size(), 0);
    for (Index f = 0; f < faces.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Index i = faces[f][(k + 1) % 3];
        const Index j = faces[f][(k + 2) % 3];
        const double weight = wall(now, i, j, centers[f], centers[neighbors[f][k]]);
        const std::uint64_t at = places.place(i);
        graph.neighbors[at] = j;
        graph.weights[at] = weight;
        graph.diagonal[i] += weight;
      }
    }
    graph.offsets = std::move(places).offsets();
    return graph;
  }

  // Each edge comes from both of its faces, with its ends exchanged; sums of two numbers do not
  // depend on their order.
  [[nodiscard]] static double wall(const Weighted& now, Index i, Index j, const Point& v,
                                   const Point& w) {
    const Index low = std::min(i, j);
    const Index high = std::max(i, j);
    const auto p = to_vector(now.poles[low]);
    const auto difference = p - to_vector(now.poles[high]);
    const auto a = to_vector(v);
    const auto b = to_vector(w);
    const double half_tangent = norm(a - b) / norm(a + b);
    // A wall of length 0 would leave a row of the graph empty.
    return std::max(half_tangent * dot(p, a + b) / norm(difference), 0x1p-60);
  }

  std::vector<Point> sites_;
  std::vector<double> targets_;
  const Execution& execution_;
  double min_target_ = 0;
};

// Scales the weights such that the least one is 1.
void scale_to_one(FineWeights& weights) {
  const double least = std::ranges::min_element(weights, {}, &DoubleDouble::hi)->hi;
  for (DoubleDouble& w : weights) {
    const double quotient = w.hi / least;
    const DoubleDouble product = exact::two_product(quotient, least);
    w = exact::fast_two_sum(quotient, ((w.hi - product.hi) - product.lo + w.lo) / least);
  }
}

// Returns the weights after `length` times a step, in twice double precision.
FineWeights stepped(const FineWeights& weights, const std::vector<double>& step, double length) {
  FineWeights result(weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double x = std::clamp(length * step[i], -1.0, 1.0);
    const double growth = 2 * x / (2 - x);
    const DoubleDouble& w = weights[i];
    const DoubleDouble sum = exact::two_sum(w.hi, w.hi * growth);
    result[i] = exact::fast_two_sum(sum.hi, sum.lo + w.lo * (1 + growth));
  }
  scale_to_one(result);
  return result;
}

// Returns the sites as unit vectors. Throws InvalidInput for a site that is not finite or is the
// center.
std::vector<Point> unit_sites(std::span<const Point> sites) {
  std::vector<Point> result;
  result.reserve(sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const Point& p = sites[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z) || p == Point{}) {
      throw InvalidInput("a site is not finite or the center", i);
    }
    result.push_back(to_point(normalized(scaled(to_vector(p)))));
  }
  return result;
}

// Returns the wanted areas in steradians with the sum 4 pi; equal ones if none are given. Throws
// InvalidInput unless there is one positive area a site and their sum is 4 pi up to a relative
// 1e-6.
std::vector<double> scaled_targets(std::span<const double> targets, std::size_t num_sites) {
  constexpr double whole = 4 * std::numbers::pi;
  if (targets.empty()) {
    std::vector<double> equal(num_sites, whole / static_cast<double>(num_sites));
    return equal;
  }
  if (targets.size() != num_sites) {
    throw InvalidInput("there is not one area for each site", std::min(targets.size(), num_sites));
  }
  double sum = 0;
  for (std::size_t i = 0; i < num_sites; ++i) {
    if (!(targets[i] > 0) || !std::isfinite(targets[i])) {
      throw InvalidInput("the area of site " + std::to_string(i) + " is not positive", i);
    }
    sum += targets[i];
  }
  if (!(std::abs(sum - whole) <= 1e-6 * whole)) {
    throw InvalidInput("the areas add up to " + std::to_string(sum) + ", not 4 pi");
  }
  std::vector<double> result(targets.begin(), targets.end());
  for (double& target : result) target *= whole / sum;
  return result;
}

// Throws InvalidInput if two sites are in one place.
void require_distinct(std::span<const Point> sites, const Execution& execution) {
  const Triangulation projected =
      delaunay(Sites::view(sites), {}, Execution{.threads = execution.threads});
  if (!projected.duplicates().empty()) {
    const Duplicate& first = projected.duplicates().front();
    throw InvalidInput("site " + std::to_string(first.site) + " is in the place of site " +
                           std::to_string(first.representative),
                       first.site);
  }
}

// Moves weights, poles and areas into the result, and computes the radii of the circles.
void finish(EqualArea& result, const FineWeights& weights, Weighted&& now) {
  for (const DoubleDouble& weight : weights) {
    result.weights.push_back(weight.hi);
    // The cosine of the radius is 1 / weight.
    const double tangent = std::sqrt(std::max(0.0, (weight.hi - 1) + weight.lo) * (weight.hi + 1));
    // A radius below 90 degrees is that of a circle, which polar_point() takes.
    result.radii_deg.push_back(
        std::min(180 / std::numbers::pi * exact::argument(tangent, 1), std::nextafter(90.0, 0.0)));
  }
  result.poles = std::move(now.poles);
  result.areas = std::move(now.areas);
  result.largest_error = now.largest_error;
  result.worst = now.worst;
}

// The reasons for areas that are not reached; they go to the report.
constexpr const char* two_hemispheres =
    "the cells of two sites are hemispheres, whatever their weights";
constexpr const char* no_lunes =
    "the cells of sites on a great circle are lunes, and no weights give them these areas";
constexpr const char* no_far_lunes =
    "no weights are found for sites on less than half of a great circle, where not all are tried";
constexpr const char* too_far_apart =
    "the weights that give these areas differ by more than coordinates that are doubles can hold";
constexpr const char* one_hemisphere =
    "weights are looked for only where sites surround the center of the sphere or lie on a great "
    "circle";
constexpr const char* no_step =
    "no step brings the areas nearer to those that are wanted and leaves each cell its place";

// Returns the cells of given weights, without steps. `reason` says why the areas are not those that
// are wanted; it is null if they are, up to rounding.
EqualArea without_steps(const std::vector<Point>& units, const std::vector<double>& targets,
                        const std::vector<double>& weights, const char* reason,
                        const EqualAreaOptions& options, const Execution& execution) {
  Weighted now;
  FineWeights fine;
  for (std::size_t i = 0; i < units.size(); ++i) {
    now.poles.push_back(to_point(weights[i] * to_vector(units[i])));
    fine.push_back({weights[i], 0});
  }
  const bool are_equal = std::ranges::all_of(weights, [](double one) { return one == 1; });
  const Model model = are_equal ? Model::projected : Model::weighted;
  const Execution quiet{.threads = execution.threads};
  now.areas = units.size() == 1 ? std::vector<double>{4 * std::numbers::pi}
                                : areas(delaunay(Sites::view(now.poles), {.model = model}, quiet));
  measure_errors(now, targets);
  EqualArea result;
  finish(result, fine, std::move(now));
  // A larger error does not come from rounding weights that differ little.
  constexpr double max_rounding = 1e-6;
  const bool is_rounding = reason == nullptr && result.largest_error <= max_rounding;
  if (result.largest_error > options.tolerance) {
    result.end = is_rounding ? EqualAreaEnd::rounded : EqualAreaEnd::infeasible;
    if (!is_rounding) result.reason = reason == nullptr ? too_far_apart : reason;
  }
  if (options.on_step) options.on_step({0, result.largest_error, 1});
  return result;
}

// Handles sites on a great circle, whose cells are lunes, and fewer than three sites.
EqualArea equal_lunes(const std::vector<Point>& units, const std::vector<double>& targets,
                      const EqualAreaOptions& options, const Execution& execution) {
  const std::vector<double> equal(units.size(), 1);
  if (units.size() < 3) {
    return without_steps(units, targets, equal, two_hemispheres, options, execution);
  }
  const LuneWeights found = lune_weights(units, targets);
  if (!found.lengths.empty()) {
    return without_steps(units, targets, found.lengths, nullptr, options, execution);
  }
  return without_steps(units, targets, equal, found.are_all_tried ? no_lunes : no_far_lunes,
                       options, execution);
}

// The weights and cells to which a step of Newton's method leads.
struct Trial {
  std::optional<Weighted> now;  // nothing if no length of the step brings the areas nearer
  FineWeights weights;
  double length = 1;    // as a multiple of Newton's step
  double rounding = 0;  // the error of areas that rounding may leave
};

// Tries Newton's step from the weights, and half of it again and again, until the areas are nearer
// to the targets and none is below `min_area`. Throws Interrupted if Execution::stop is set.
Trial shorter_steps(const Newton& newton, const FineWeights& weights, const Weighted& now,
                    double min_area) {
  const Newton::NewtonStep step = newton.step_from(now);
  Trial trial;
  trial.rounding = step.rounding;
  for (int halving = 0; halving < max_halvings; ++halving, trial.length /= 2) {
    trial.weights = stepped(weights, step.of_log, trial.length);
    trial.now = newton.measure(trial.weights, now.poles);
    const double fall = 1 - trial.length / 2;
    // Near the end, rounding is most of the sum of squares, and few cells have larger errors.
    if (trial.now && trial.now->smallest_area >= min_area &&
        (trial.now->square_error <= fall * fall * now.square_error ||
         trial.now->largest_error <= fall * now.largest_error)) {
      break;
    }
    trial.now.reset();
    // A shorter step does not help if only rounding is left.
    if (now.largest_error <= step.rounding) break;
  }
  return trial;
}

}  // namespace

std::string_view name_of(EqualAreaEnd end) noexcept {
  return system::name_in({"converged", "rounded", "iterations", "infeasible", "stopped"}, end);
}

EqualArea equal_area(std::span<const Point> sites, std::span<const double> targets,
                     const EqualAreaOptions& options, const Execution& execution) {
  const system::ArithmeticScope arithmetic;
  const std::vector<Point> units = unit_sites(sites);
  if (units.empty()) throw InvalidInput("there are no sites");
  require_distinct(units, execution);
  const std::vector<double> wanted = scaled_targets(targets, sites.size());
  if (lie_on_great_circle(units)) return equal_lunes(units, wanted, options, execution);
  const Newton newton(units, wanted, execution);
  EqualArea result;
  FineWeights weights(sites.size(), DoubleDouble{1, 0});
  std::optional<Weighted> now = newton.measure(weights, units);
  if (!now) {
    const std::vector<double> equal(units.size(), 1);
    return without_steps(units, wanted, equal, one_hemisphere, options, execution);
  }
  const double min_area = 0.5 * std::min(now->smallest_area, newton.min_target());
  for (double length = 1;;) {
    if (options.on_step) options.on_step({result.steps, now->largest_error, length});
    result.end = EqualAreaEnd::converged;
    if (now->largest_error <= options.tolerance) break;
    result.end = EqualAreaEnd::iterations;
    if (result.steps == options.max_steps) break;
    result.end = EqualAreaEnd::stopped;  // also if the step does not come to its end
    if (execution.stop != nullptr && execution.stop->load()) break;

    Trial trial;
    try {
      trial = shorter_steps(newton, weights, *now, min_area);
    } catch (const Interrupted&) {
      break;
    }
    length = trial.length;
    if (!trial.now) {
      const bool is_rounding = now->largest_error <= trial.rounding;
      result.end = is_rounding ? EqualAreaEnd::rounded : EqualAreaEnd::infeasible;
      if (!is_rounding) result.reason = no_step;
      break;
    }
    weights = std::move(trial.weights);
    now = std::move(trial.now);
    ++result.steps;
  }
  finish(result, weights, std::move(*now));
  return result;
}

}  // namespace rondel::mesh
