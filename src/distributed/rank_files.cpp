// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Triangulates from a file to files; each rank reads and writes its share.
// Steps: read the rows of this rank, triangulate, compute areas where they are wanted, write the
// rows of this rank to each result, and name all results when every rank has written.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "distributed/bsp_session.h"
#include "distributed/rank_duals.h"
#include "distributed/result_names.h"
#include "distributed/shared_rows.h"
#include "distributed/site_counts.h"
#include "io/npy_rows.h"
#include "system/job.h"
#include "system/large_arrays.h"

namespace rondel {
namespace distributed {
namespace {

// Returns the sites of this rank: successive rows, as many as for other ranks or one more. Throws
// FileError for names of files that do not fit, and with the row of a site that is not valid.
LargeVector<Point> read_share(BspSession& session, const std::string& path,
                              const DistributedFiles& files, const system::Job& options) {
  session.begin("read");
  const std::vector<std::string> results = {files.faces, files.neighbors, files.duplicates,
                                            files.areas, files.circumcenters};
  require_different(path, results);
  require_npy(files.faces);
  const io::NpyRows rows(path, files.radians);
  const auto begin_of = [&](std::size_t rank) {
    const std::uint64_t num_rows = rows.num_rows();
    return num_rows / session.size() * rank + num_rows % session.size() * rank / session.size();
  };
  const std::uint64_t begin = begin_of(session.rank());
  LargeVector<Point> sites(begin_of(session.rank() + 1) - begin);
  rows.read(begin, sites, options.threads);
  validate_rows(rows, sites, options, begin);  // here the error names the file
  return sites;
}

void add_rows(SharedRows& file, std::span<const GlobalTriple> rows) {
  for (const GlobalTriple& row : rows) {
    for (const std::uint64_t number : row) file.add(number);
  }
}

void add_rows(SharedRows& file, std::span<const Point> rows) {
  for (const Point& row : rows) {
    file.add(row.x);
    file.add(row.y);
    file.add(row.z);
  }
}

// Returns the sum of the values of all ranks before this one.
std::uint64_t sum_before(BspSession& session, std::uint64_t value) {
  MessageWriter writer;
  writer.add_value(value);
  const auto received = session.all_gather(writer.take());
  std::uint64_t sum = 0;
  for (std::size_t rank = 0; rank < session.rank(); ++rank)
    sum += MessageReader(received[rank]).value<std::uint64_t>();
  return sum;
}

// The written results, which all get their names at the end.
class SharedResults {
 public:
  SharedResults(BspSession& session, const DistributedTriangulation& part,
                const DistributedFiles& files)
      : session_(session), part_(part), files_(files) {}

  void write(std::span<const double> areas, const Execution& execution) {
    const std::uint64_t num_faces = part_.num_faces();
    const std::uint64_t first_face = part_.first_face();
    write(files_.faces, {num_faces, 3, part_.num_sites(), first_face}, [&](SharedRows& file) {
      part_.visit_faces([&](std::span<const GlobalTriple> rows) { add_rows(file, rows); });
    });
    write(files_.neighbors, {num_faces, 3, num_faces, first_face}, [&](SharedRows& file) {
      part_.visit_neighbors([&](std::span<const GlobalTriple> rows) { add_rows(file, rows); });
    });
    write(files_.circumcenters, {num_faces, 3, 0, first_face, true}, [&](SharedRows& file) {
      part_.visit_circumcenters([&](std::span<const Point> rows) { add_rows(file, rows); },
                                execution);
    });
    const std::uint64_t first_area = sum_before(session_, areas.size());
    write(files_.areas, {part_.num_sites(), 1, 0, first_area, true}, [&](SharedRows& file) {
      for (const double area : areas) file.add(area);
    });
    const std::uint64_t first_duplicate = sum_before(session_, part_.duplicates().size());
    write(files_.duplicates, {part_.num_duplicates(), 2, part_.num_sites(), first_duplicate},
          [&](SharedRows& file) {
            for (const GlobalDuplicate& d : part_.duplicates()) {
              file.add(d.site);
              file.add(d.representative);
            }
          });
  }

  // Call this when all ranks have written their rows. The faces, which every run has, get their
  // name last.
  void commit() {
    while (!written_.empty()) {
      written_.back()->commit();
      written_.pop_back();
    }
  }

 private:
  template <class Add>
  void write(const std::string& path, const SharedShape& shape, Add add) {
    if (path.empty()) return;
    written_.push_back(std::make_unique<SharedRows>(session_, path, shape));
    add(*written_.back());
    written_.back()->finish();
  }

  BspSession& session_;
  const DistributedTriangulation& part_;
  const DistributedFiles& files_;
  std::vector<std::unique_ptr<SharedRows>> written_;
};

// Writes all results together with the other ranks; the value returned has no meaning.
bool write_files(BspSession& session, const DistributedTriangulation& part,
                 const DistributedFiles& files, const Execution& execution) {
  std::vector<double> areas;
  if (!files.areas.empty())
    areas = areas_on_ranks(session, DistributedTriangulation::Impl::of(part), execution);
  session.begin("write");
  SharedResults results(session, part, files);
  results.write(areas, execution);
  session.all_gather({});
  if (session.rank() == 0) results.commit();
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
    distributed::BspSession session(ranks);
    mine = session.run([&] { return distributed::read_share(session, sites, files, job); });
  }
  DistributedOptions with_points = distributed;
  with_points.keep_points |= !files.areas.empty() || !files.circumcenters.empty();
  DistributedTriangulation part = delaunay(ranks, mine, with_points, options, execution);
  mine = {};
  const system::Call call(job);
  distributed::BspSession session(ranks);
  session.run([&] { return distributed::write_files(session, part, files, execution); });
  return part;
}

}  // namespace rondel
