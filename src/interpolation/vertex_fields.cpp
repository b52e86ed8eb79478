// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/vertex_fields.h"

#include <map>
#include <utility>

#include "system/parallel.h"
#include "system/prefetch.h"

namespace rondel::interpolation {
namespace {

// Copying values into vertex order pays if there is a target for at least this many vertices, and
// if at most this many fields fit the caches beside it.
constexpr std::size_t vertices_a_target = 8;
constexpr std::size_t max_gathered_fields = 8;
constexpr std::size_t vertices_per_piece = 8192;

}  // namespace

std::vector<SharedSites> shared_places(const PreparedTriangulation& prepared) {
  std::map<Index, std::vector<Index>> places;
  for (const auto& [site, representative] : prepared.triangulation().duplicates()) {
    auto& sites = places[prepared.vertex_of(representative)];
    if (sites.empty()) sites.push_back(representative);
    sites.push_back(site);
  }
  places.erase(no_index);
  std::vector<SharedSites> result;
  result.reserve(places.size());
  for (auto& [vertex, sites] : places) result.push_back({vertex, std::move(sites)});
  return result;
}

FieldLayout scalar_fields(std::span<const double> field, std::size_t num_sites) {
  FieldLayout layout{field.data(), {}, 1};
  for (std::size_t at = 0; at < field.size(); at += num_sites) layout.starts.push_back(at);
  return layout;
}

FieldLayout vector_fields(std::span<const Point> field, std::size_t num_sites) {
  FieldLayout layout{reinterpret_cast<const double*>(field.data()), {}, 3};
  for (std::size_t at = 0; at < field.size(); at += num_sites) {
    for (std::size_t c = 0; c < 3; ++c) layout.starts.push_back(3 * at + c);
  }
  return layout;
}

VertexFields::VertexFields(const PreparedTriangulation& prepared, FieldLayout fields,
                           SharedPlace shared, std::size_t num_targets, unsigned threads)
    : layout_(std::move(fields)), names_(prepared.names().data()) {
  const bool has_means =
      shared == SharedPlace::mean && !prepared.triangulation().duplicates().empty();
  const bool pays = num_fields() <= max_gathered_fields &&
                    num_targets >= prepared.num_vertices() / vertices_a_target;
  if (!has_means && !pays) return;
  gather(prepared, threads);
  if (has_means) take_means(prepared);
  const std::size_t num_all = num_fields();
  layout_ = {by_vertex_.data(), {}, num_all};
  for (std::size_t f = 0; f < num_all; ++f) layout_.starts.push_back(f);
  names_ = nullptr;
}

void VertexFields::gather(const PreparedTriangulation& prepared, unsigned threads) {
  const std::size_t num_fields = layout_.starts.size();
  by_vertex_.resize(num_fields * prepared.num_vertices());
  system::parallel_for(
      threads, prepared.num_vertices(), vertices_per_piece,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = 0; f < num_fields; ++f) {
          const double* const values = layout_.data + layout_.starts[f];
          for (std::size_t v = begin; v < end; ++v) {
            if (v + system::prefetch_distance < end)
              system::prefetch(&values[names_[v + system::prefetch_distance] * layout_.step]);
            by_vertex_[v * num_fields + f] = values[names_[v] * layout_.step];
          }
        }
      });
}

void VertexFields::take_means(const PreparedTriangulation& prepared) {
  const std::size_t num_fields = layout_.starts.size();
  for (const auto& sites : shared_places(prepared)) {
    double* const means = &by_vertex_[sites.vertex * num_fields];
    for (std::size_t f = 0; f < num_fields; ++f) {
      means[f] = mean_of(
          sites.sites, [&](Index i) { return layout_.data[layout_.starts[f] + i * layout_.step]; });
    }
  }
}

}  // namespace rondel::interpolation
