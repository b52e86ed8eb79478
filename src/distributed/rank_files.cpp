// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// From a file to files, of which each rank reads and writes its share.

#include <optional>
#include <span>

#include "distributed/rank_counts.h"
#include "distributed/shared_rows.h"
#include "distributed/supersteps.h"
#include "io/npy_rows.h"
#include "system/job.h"
#include "system/large_vector.h"

namespace rondel {
namespace distributed {
namespace {

LargeVector<Point> read_share(Supersteps& steps, const std::string& path, bool are_radians,
                              const system::Job& options) {
  steps.begin("read");
  const io::NpyRows rows(path, are_radians);
  const auto begin_of = [&](std::size_t rank) {
    const std::uint64_t num_rows = rows.num_rows();
    return num_rows / steps.size() * rank + num_rows % steps.size() * rank / steps.size();
  };
  const std::uint64_t begin = begin_of(steps.rank());
  LargeVector<Point> sites(begin_of(steps.rank() + 1) - begin);
  rows.read(begin, sites, options.threads);
  return sites;
}

void add_rows(SharedRows& file, std::span<const GlobalTriple> rows) {
  for (const GlobalTriple& row : rows) {
    for (const std::uint64_t number : row) file.add(number);
  }
}

// Of all ranks before this one.
std::uint64_t sum_before(Supersteps& steps, std::uint64_t value) {
  MessageWriter writer;
  writer.add_value(value);
  const auto received = steps.all_gather(writer.take());
  std::uint64_t sum = 0;
  for (std::size_t rank = 0; rank < steps.rank(); ++rank)
    sum += MessageReader(received[rank]).value<std::uint64_t>();
  return sum;
}

bool write_files(Supersteps& steps, const DistributedTriangulation& part,
                 const DistributedFiles& files) {
  steps.begin("write");
  SharedRows faces(steps, files.faces, {part.num_faces(), 3, part.num_sites(), part.first_face()});
  std::optional<SharedRows> neighbors;
  std::optional<SharedRows> duplicates;
  part.visit_faces([&](std::span<const GlobalTriple> rows) { add_rows(faces, rows); });
  faces.finish();
  if (!files.neighbors.empty()) {
    neighbors.emplace(steps, files.neighbors,
                      SharedShape{part.num_faces(), 3, part.num_faces(), part.first_face()});
    part.visit_neighbors([&](std::span<const GlobalTriple> rows) { add_rows(*neighbors, rows); });
    neighbors->finish();
  }
  if (!files.duplicates.empty()) {
    const std::uint64_t first = sum_before(steps, part.duplicates().size());
    duplicates.emplace(steps, files.duplicates,
                       SharedShape{part.num_duplicates(), 2, part.num_sites(), first});
    for (const GlobalDuplicate& d : part.duplicates()) {
      duplicates->add(d.site);
      duplicates->add(d.representative);
    }
    duplicates->finish();
  }
  steps.all_gather({});
  if (steps.rank() != 0) return true;
  if (duplicates) duplicates->commit();
  if (neighbors) neighbors->commit();
  faces.commit();
  return true;
}

}  // namespace
}  // namespace distributed

DistributedTriangulation delaunay_file(Communicator& ranks, const std::string& sites,
                                       const DistributedFiles& files,
                                       const DistributedOptions& distributed,
                                       const Options& options, const Execution& execution) {
  LargeVector<Point> mine;
  const system::Job job{options, execution};
  {
    const system::Call call(job);
    distributed::Supersteps steps(ranks);
    mine = steps.run([&] { return distributed::read_share(steps, sites, files.radians, job); });
  }
  DistributedTriangulation part = delaunay(ranks, mine, distributed, options, execution);
  mine = {};
  const system::Call call(job);
  distributed::Supersteps steps(ranks);
  steps.run([&] { return distributed::write_files(steps, part, files); });
  return part;
}

}  // namespace rondel
