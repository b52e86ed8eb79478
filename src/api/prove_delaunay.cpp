// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Arrays that are a triangulation of some kind (from_arrays.cpp) are proved to be the one that
// delaunay() makes of their sites, but for the order of the faces.
// Steps: the validator of check() proves that the faces are Delaunay; what it does not look at is
// proved here: that all duplicates are listed, the order of the ring, ghost faces and hidden sites.
#include <algorithm>
#include <string>

#include "api/triangulation_impl.h"
#include "predicates/orientation.h"
#include "proof/validator.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "system/job.h"

namespace rondel::api {
namespace {

// The first flaw of the arrays, and its position in the array that the reason names.
struct Flaw {
  std::string reason;  // empty: there is none
  std::size_t index = 0;
};

// Returns a face that is listed as ghost but solid, or the other way round. A face is solid if the
// center is strictly below its plane: the orientation of its corners is positive.
Flaw find_wrong_ghost(const Triangulation& t) {
  const auto sites = t.sites().points();
  auto ghost = t.ghost_faces().begin();
  for (Index f = 0; f < t.num_faces(); ++f) {
    const bool is_listed = ghost != t.ghost_faces().end() && *ghost == f;
    if (is_listed) ++ghost;
    const auto& [a, b, c] = t.faces()[f];
    const bool is_solid =
        predicates::orientation(sites[a], sites[b], sites[c], t.sphere().center).sign ==
        Sign::positive;
    if (is_solid != is_listed) continue;
    return {"face " + std::to_string(f) + (is_solid ? " is no ghost" : " is a ghost face"), f};
  }
  return {};
}

// Returns a hidden site that is outside of the cone, seen from the center, of the face that it
// names. No site may name a ghost face.
Flaw find_wrong_hidden(const Triangulation& t) {
  const auto sites = t.sites().points();
  const auto hidden = t.hidden();
  for (std::size_t i = 0; i < hidden.size(); ++i) {
    const Point& p = sites[hidden[i].site];
    const auto is_beyond = [&](Index from, Index to) {
      return predicates::orientation(sites[from], sites[to], p, t.sphere().center).sign ==
             Sign::negative;
    };
    const auto& [a, b, c] = t.faces()[hidden[i].face];
    if (!t.is_ghost(hidden[i].face) && !is_beyond(a, b) && !is_beyond(b, c) && !is_beyond(c, a)) {
      continue;
    }
    return {"site " + std::to_string(hidden[i].site) + " does not lie below face " +
                std::to_string(hidden[i].face),
            i};
  }
  return {};
}

// Returns the first flaw, with an empty reason if there is none.
Flaw find_flaw(const Triangulation& t, const Options& options, const Execution& execution) {
  const CheckReport report =
      proof::check_triangles(t.sites().points(), t.faces(), {options, execution});
  if (!report.is_valid) return {report.reason};
  // The listed sites are duplicates, but there may be others.
  if (t.duplicates().size() != report.num_duplicates) {
    return {std::to_string(t.duplicates().size()) + " duplicates are listed, but there are " +
            std::to_string(report.num_duplicates)};
  }
  if (t.dimension() < 2) {
    const bool is_same = std::ranges::equal(t.ring(), delaunay(t.sites(), options).ring());
    return {is_same ? "" : "the ring is in another order"};
  }
  Flaw flaw = find_wrong_ghost(t);
  return flaw.reason.empty() ? find_wrong_hidden(t) : flaw;
}

}  // namespace

void prove_delaunay(const Triangulation& triangulation, const Execution& execution) {
  const Options options = {triangulation.model(), triangulation.sphere()};
  const Flaw flaw = find_flaw(triangulation, options, execution);
  if (flaw.reason.empty()) return;
  throw InvalidInput("the arrays are not those of the triangulation of their sites: " + flaw.reason,
                     flaw.index);
}

}  // namespace rondel::api
