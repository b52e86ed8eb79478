// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "distributed/site_counts.h"

#include <algorithm>

#include "api/validation.h"
#include "order/place_keys.h"
#include "rondel/error.h"

namespace rondel::distributed {
namespace {

constexpr std::size_t grain = std::size_t{1} << 14;

}  // namespace

void validate_rows(const io::NpyRows& rows, std::span<const Point> sites, const Options& options,
                   std::uint64_t first) {
  try {
    api::validate_some(sites, options, first);
  } catch (const InvalidInput& error) {
    throw FileError(rows.name() + ": row " + std::to_string(error.index()) + ": " + error.what());
  }
}

void find_keys(std::span<const Point> sites, const system::Job& options,
               std::span<std::uint64_t> keys) {
  system::parallel_for(options.threads, sites.size(), grain,
                       [&](std::size_t begin, std::size_t end) {
                         order::place_keys(sites.subspan(begin, end - begin), options.model,
                                           options.sphere.center, keys.subspan(begin, end - begin));
                       });
}

SiteCounts count_sites(const io::NpyRows& rows, const system::Job& options,
                       std::uint64_t max_bucket_sites, std::size_t piece_sites) {
  SiteCounts result{bulk::AllSites(options), {}};
  BucketCounts counts(max_bucket_sites);
  std::vector<Point> sites(std::min<std::uint64_t>(piece_sites, rows.num_rows()));
  std::vector<std::uint64_t> keys(sites.size());
  double round = 1;
  do {
    for (std::uint64_t first = 0; first < rows.num_rows(); first += piece_sites) {
      system::obey_stop();
      const std::size_t size = std::min<std::uint64_t>(piece_sites, rows.num_rows() - first);
      const std::span piece = std::span(sites).first(size);
      rows.read(first, piece, options.threads);
      if (round == 1) {
        validate_rows(rows, piece, options, first);
        result.all.add(piece);
      }
      find_keys(piece, options, keys);
      counts.add(std::span(keys).first(size));
      // Assumes that this round is the last one, as for most inputs there is only one.
      const double done = static_cast<double>(first) / static_cast<double>(rows.num_rows());
      system::announce(options, "count", (round - 1 + done) / round);
    }
    round += 1;
  } while (counts.end_round());
  result.cuts = counts.cuts();
  return result;
}

}  // namespace rondel::distributed
