// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Set operations, relations and buffers of polygons.
#include "rondel/set_operations.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "handles.h"
#include "polygons.h"
#include "rondel.h"
#include "rondel/buffer.h"
#include "rondel/relate.h"

namespace rondel::c {

SetOperation operation_of(std::int32_t operation) {
  switch (operation) {
    case RONDEL_UNION:
      return SetOperation::unite;
    case RONDEL_INTERSECTION:
      return SetOperation::intersection;
    case RONDEL_DIFFERENCE:
      return SetOperation::difference;
    case RONDEL_SYMMETRIC_DIFFERENCE:
      return SetOperation::symmetric_difference;
    case RONDEL_IDENTITY:
      return SetOperation::identity;
    default:
      throw InvalidInput("the set operation " + std::to_string(operation) + " is unknown");
  }
}

std::vector<std::array<Index, 2>> copied_pairs(const std::uint32_t* pairs, std::size_t n) {
  if (n > max_sites) throw InvalidInput("pairs: more than can be", max_sites);
  const std::span<const Index> given = indices_at(pairs, 2 * n, "pairs");
  std::vector<std::array<Index, 2>> copied(n);
  for (std::size_t k = 0; k < n; ++k) copied[k] = {given[2 * k], given[2 * k + 1]};
  return copied;
}

namespace {

// Makes polygons of polygons.
template <class Make>
rondel_status make_polygons(rondel_polygons** made, const Make& make) {
  return make_handle(made, [&] { return std::make_unique<rondel_polygons>(make()); });
}

// Throws InvalidInput unless both arguments are there.
void require_both(const rondel_polygons* a, const rondel_polygons* b) {
  require(a, "a");
  require(b, "b");
}

void write_relations(std::span<const Relation> found, char* relations) {
  if (!found.empty()) require(relations, "relations");
  for (const Relation& relation : found) {
    relations = std::ranges::copy(relation.text(), relations).out;
    *relations++ = '\0';
  }
}

Relation relation_at(const char* text) {
  require(text, "relation");
  const std::string_view given(text);
  Relation relation;
  if (given.size() != relation.matrix.size() ||
      given.find_first_not_of("F012") != std::string_view::npos) {
    throw InvalidInput("a relation has nine characters of F 0 1 2, and is not '" +
                       std::string(given) + "'");
  }
  std::ranges::copy(given, relation.matrix.begin());
  return relation;
}

// Returns for each polygon of A those of B to which it is so related.
CompressedRows<Index> related_rows(const CellRings& a, const CellRings& b, std::string_view pattern,
                                   const Execution& execution) {
  (void)Relation().matches(pattern);  // refuses what is no pattern, also where there are no pairs
  CompressedRows<Index> rows;
  for (const RelatedPair& pair : related_pairs(a, b, SpatialPredicate::intersects, execution)) {
    while (rows.size() < pair.first) rows.end_row();
    if (pair.relation.matches(pattern)) rows.values.push_back(pair.second);
  }
  while (rows.size() < a.num_cells()) rows.end_row();
  return rows;
}

}  // namespace
}  // namespace rondel::c

extern "C" {

namespace rc = rondel::c;

rondel_status rondel_combine(const rondel_polygons* a, const rondel_polygons* b, int32_t operation,
                             const rondel_execution* execution, rondel_polygons** made) {
  return rc::make_polygons(made, [&] {
    rc::require_both(a, b);
    return rondel::combine(a->rings, b->rings, rc::operation_of(operation),
                           rc::execution_of(execution));
  });
}

rondel_status rondel_unite(const rondel_polygons* polygons, const rondel_execution* execution,
                           rondel_polygons** made) {
  return rc::make_polygons(made, [&] {
    rc::require(polygons, "polygons");
    return rondel::unite(polygons->rings, rc::execution_of(execution));
  });
}

rondel_status rondel_combine_pairs(const rondel_polygons* a, const rondel_polygons* b,
                                   const uint32_t* pairs, size_t n, int32_t operation,
                                   const rondel_execution* execution, rondel_polygons** made) {
  return rc::make_polygons(made, [&] {
    rc::require_both(a, b);
    return rondel::combine_pairs(a->rings, b->rings, rc::copied_pairs(pairs, n),
                                 rc::operation_of(operation), rc::execution_of(execution));
  });
}

rondel_status rondel_repair(const rondel_polygons* polygons, const rondel_execution* execution,
                            rondel_polygons** made) {
  return rc::make_polygons(made, [&] {
    rc::require(polygons, "polygons");
    return rondel::repaired(polygons->rings, rc::execution_of(execution));
  });
}

rondel_status rondel_relate(const rondel_polygons* a, const rondel_polygons* b,
                            const rondel_execution* execution, char* relations) {
  return rc::guarded([&] {
    rc::require_both(a, b);
    rc::write_relations(rondel::relate(a->rings, b->rings, rc::execution_of(execution)), relations);
  });
}

rondel_status rondel_relate_pairs(const rondel_polygons* a, const rondel_polygons* b,
                                  const uint32_t* pairs, size_t n,
                                  const rondel_execution* execution, char* relations) {
  return rc::guarded([&] {
    rc::require_both(a, b);
    rc::write_relations(rondel::relate_pairs(a->rings, b->rings, rc::copied_pairs(pairs, n),
                                             rc::execution_of(execution)),
                        relations);
  });
}

rondel_status rondel_relation_matches(const char* relation, const char* pattern, int32_t* matches) {
  return rc::guarded([&] {
    rc::require(pattern, "pattern");
    rc::require(matches, "matches");
    *matches = rc::relation_at(relation).matches(pattern) ? 1 : 0;
  });
}

rondel_status rondel_related(const rondel_polygons* a, const rondel_polygons* b,
                             const char* pattern, const rondel_execution* execution,
                             rondel_lists** related) {
  return rc::make_handle(related, [&] {
    rc::require_both(a, b);
    return std::make_unique<rondel_lists>(rondel_lists{
        rc::related_rows(a->rings, b->rings, pattern == nullptr ? "*********" : pattern,
                         rc::execution_of(execution))});
  });
}

rondel_status rondel_buffer(const rondel_polygons* polygons, double distance, double tolerance,
                            const rondel_execution* execution, rondel_polygons** made) {
  return rc::make_polygons(made, [&] {
    rc::require(polygons, "polygons");
    return rondel::buffered(polygons->rings, {distance, tolerance}, rc::execution_of(execution));
  });
}

rondel_status rondel_buffer_points(const double* points, size_t n, double distance,
                                   double tolerance, const rondel_execution* execution,
                                   rondel_polygons** made) {
  return rc::make_polygons(made, [&] {
    return rondel::buffered(rc::copied_points(points, n, "points"), {distance, tolerance},
                            rc::execution_of(execution));
  });
}

}  // extern "C"
