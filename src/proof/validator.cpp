// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "proof/validator.h"

#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "proof/convexity.h"
#include "proof/perturbed_sites.h"
#include "proof/sites_by_place.h"
#include "proof/surface.h"

namespace rondel::proof {
namespace {

class Validator {
 public:
  Validator(std::span<const Point> sites, std::span<const Triple> triangles,
            const system::Job& options)
      : sites_(sites), triangles_(triangles), options_(options) {}

  CheckReport run() {
    report_.reason = find_flaw();
    report_.is_valid = report_.reason.empty();
    return std::move(report_);
  }

 private:
  std::string find_flaw();
  std::string find_flaw_below_dimension_2(const PerturbedSites& perturbed);
  std::string find_unaccounted(const Surface& surface);
  [[nodiscard]] std::string find_wrong_pair() const;
  [[nodiscard]] Index find_pole() const;

  void tell(double fraction) const { system::announce(options_, "check", fraction); }

  std::span<const Point> sites_;
  std::span<const Triple> triangles_;
  const system::Job& options_;
  SitesByPlace places_;
  std::vector<Index> unlisted_;  // lowest indices of the places that are no vertices
  CheckReport report_;
};

std::string Validator::find_flaw() {
  tell(0);
  const Surface surface(sites_.size(), triangles_);
  if (!surface.flaw().empty()) return surface.flaw();
  report_.num_vertices = surface.num_vertices();
  report_.num_edges = surface.num_edges();
  tell(0.2);
  places_ = group_by_place(sites_, options_.model, options_.sphere);
  tell(0.4);
  const PerturbedSites perturbed(sites_, places_, options_.model, options_.sphere);
  if (perturbed.dimension() < 2) return find_flaw_below_dimension_2(perturbed);
  if (triangles_.empty()) {
    const auto [a, b, c] = perturbed.independent();
    return "there are no faces, but sites " + text(a) + ", " + text(b) + " and " + text(c) +
           " do not lie on one great circle";
  }
  std::string flaw = find_unaccounted(surface);
  if (!flaw.empty()) return flaw;
  if (surface.num_vertices() == 3) return find_wrong_pair();
  const Index pole = find_pole();
  if (!surface.is_vertex(pole)) {
    return "site " + text(pole) + " is no vertex, but an extreme point of the hull";
  }
  flaw = find_concavity(surface, perturbed, pole, options_.model);
  tell(0.9);
  if (flaw.empty()) flaw = find_uncovered(surface, perturbed, pole, unlisted_);
  tell(1);
  return flaw;
}

std::string Validator::find_flaw_below_dimension_2(const PerturbedSites& perturbed) {
  if (!triangles_.empty()) {
    return "all sites lie on one great circle, so there are no faces; here are " +
           text(triangles_.size());
  }
  for (Index i = 0; i < sites_.size(); ++i) {
    ++(places_.first[i] == i ? report_.num_vertices : report_.num_duplicates);
  }
  if (perturbed.dimension() == 1) {
    report_.num_edges = report_.num_vertices == 2 ? 1 : report_.num_vertices;
  }
  return {};
}

// Every site is a vertex, a duplicate, or (below the hull, as will be proved) hidden.
std::string Validator::find_unaccounted(const Surface& surface) {
  for (Index i = 0; i < sites_.size(); ++i) {
    const Index first = places_.first[i];
    if (first != i) {
      ++report_.num_duplicates;
      if (!surface.is_vertex(i)) continue;
      return "site " + text(i) + " is a vertex, but a duplicate of site " + text(first) +
             ", which names their place";
    }
    if (!surface.is_vertex(i)) unlisted_.push_back(i);
  }
  report_.num_hidden = unlisted_.size();
  if (options_.model == Model::weighted || unlisted_.empty()) return {};
  return "site " + text(unlisted_[0]) + " is neither a vertex nor the duplicate of one";
}

// The hull of three perturbed sites is a triangle, and that of more has more vertices. Two faces
// with the same corners have no edge that could be wrong.
std::string Validator::find_wrong_pair() const {
  if (unlisted_.empty()) return {};
  return "site " + text(unlisted_[0]) +
         " is no vertex, but the hull of more than three sites has " + "more than three vertices";
}

// A vertex of the hull in any case: on a sphere every site, otherwise the lexicographically
// smallest.
Index Validator::find_pole() const {
  if (options_.model == Model::projected) return triangles_[0][0];
  const auto coordinates = [&](Index i) { return std::tie(sites_[i].x, sites_[i].y, sites_[i].z); };
  Index lowest = 0;
  for (Index i = 1; i < sites_.size(); ++i) {
    if (coordinates(i) < coordinates(lowest)) lowest = i;
  }
  return lowest;
}

}  // namespace

CheckReport check_triangles(std::span<const Point> sites, std::span<const Triple> triangles,
                            const system::Job& options) {
  return Validator(sites, triangles, options).run();
}

}  // namespace rondel::proof
