// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "distributed/file_results.h"

#include <algorithm>
#include <utility>

#include "api/triangulation_impl.h"
#include "distributed/bucket_areas.h"
#include "distributed/bucket_surface.h"
#include "distributed/merge_by_row.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "system/parallel.h"

namespace rondel::distributed {
namespace {

// The data of all buckets that is joined in memory.
struct Joined {
  std::vector<std::uint64_t> open_rows;  // by open site
  std::vector<Point> open_points;        // by open site, if areas are wanted
  std::vector<double> flat_areas;        // by open site, if the dimension is less than 2
  bulk::JoinedFaces faces;
  int dimension = 2;  // less than 2: all sites are open and lie on one great circle
  std::uint64_t num_hidden = 0;
};

// Returns the number of open sites that no face has.
std::uint64_t num_hidden(const Joined& joined) {
  std::vector<bool> is_vertex(joined.open_rows.size(), false);
  for (const Triple& face : joined.faces.faces) {
    for (const Index s : face) is_vertex[s] = true;
  }
  return static_cast<std::uint64_t>(std::ranges::count(is_vertex, false));
}

// Joins sites on one great circle, where there are no faces.
void join_flat(std::span<const bulk::OpenBucket> open, const system::Job& options, Joined& joined) {
  std::vector<Point> points;
  for (const bulk::OpenBucket& bucket : open)
    points.insert(points.end(), bucket.points.begin(), bucket.points.end());
  const Triangulation ring = delaunay(Sites::view(points), options, options);
  joined.dimension = ring.dimension();
  joined.num_hidden = ring.hidden().size();
  if (joined.open_points.empty()) return;
  joined.flat_areas =
      areas(api::make_triangulation(Sites::view(joined.open_points),
                                    Triangulation::Impl::of(ring).arrays, options, {}),
            options);
}

// Computes the faces between all buckets from their outlines.
Joined join(const RunState& state, const ResultStore& store, const system::Job& options,
            bool has_areas) {
  Joined joined;
  std::vector<bulk::OpenBucket> open;
  for (std::size_t i = 0; i < state.num_buckets(); ++i) {
    StoredBorder stored = store.outline(state.done(i));
    joined.open_rows.insert(joined.open_rows.end(), stored.rows.begin(), stored.rows.end());
    if (has_areas)
      joined.open_points.insert(joined.open_points.end(), stored.named_points.begin(),
                                stored.named_points.end());
    open.push_back({state.counts().cuts[i].square, static_cast<double>(state.done(i).num_vertices),
                    std::move(stored.points), std::move(stored.border.open_edges),
                    std::move(stored.border.hidden)});
  }
  auto faces = bulk::join_buckets(open, state.counts().all, options);
  if (faces) {
    joined.faces = *std::move(faces);
    joined.num_hidden = num_hidden(joined);
  } else {
    join_flat(open, options, joined);
  }
  return joined;
}

// A bucket with the numbers of its faces.
struct NumberedBucket {
  std::size_t i;
  const StoredBucket& stored;
  const bulk::BucketBorder& border;
  const BucketFaces& faces;
  Index first_site;
  Index first_edge;
};

// Writes the results from what was joined.
class ResultWriter {
 public:
  ResultWriter(const RunState& state, const ResultStore& store, const Joined& joined,
               GlobalIndex first_face, const system::Job& options, FileResults& results)
      : state_(state),
        store_(store),
        joined_(joined),
        first_face_(first_face),
        options_(options),
        results_(results),
        numbers_(joined.faces) {}

  // Goes through all buckets twice, since the numbers of all faces between buckets must be known
  // before any face is written.
  void run() {
    for_each_bucket([](const NumberedBucket&) {});
    for_each_bucket([this](const NumberedBucket& bucket) {
      system::announce(options_, "write", bucket.i, state_.num_buckets());
      write_faces(bucket);
      if (results_.neighbors) write_neighbors(bucket);
      if (results_.areas) write_areas(bucket);
    });
    if (results_.ghost_faces) write_ghost_faces();
  }

 private:
  template <class Visit>
  // Calls visit(bucket) for each bucket with its faces numbered, one bucket in memory at a time.
  void for_each_bucket(Visit visit) {
    Index first_site = 0;
    Index first_edge = 0;
    GlobalIndex first_face = first_face_;
    for (std::size_t i = 0; i < state_.num_buckets(); ++i) {
      system::obey_stop();
      const StoredBorder stored = store_.border(state_.done(i));
      BucketFaces faces(stored.border, joined_.faces, first_site, first_edge);
      faces.number(first_face, numbers_);
      visit({i, state_.done(i), stored.border, faces, first_site, first_edge});
      first_site += static_cast<Index>(stored.border.open_sites.size());
      first_edge += static_cast<Index>(stored.border.open_edges.size());
      first_face += faces.size();
    }
  }

  // Writes the corners of the faces that a bucket owns.
  void write_faces(const NumberedBucket& bucket) {
    const std::vector<std::uint64_t> rows = store_.vertex_rows(bucket.i, bucket.stored);
    bucket.faces.for_each_face(store_.faces(bucket.i, bucket.stored), [&](const auto& corners) {
      for (const BucketCorner& v : corners)
        results_.faces.add(v.is_own ? rows[v.index] : joined_.open_rows[v.index]);
    });
  }

  // Writes the neighbors of the faces that a bucket owns.
  void write_neighbors(const NumberedBucket& bucket) {
    const LargeVector<Triple> neighbors = store_.neighbors(bucket.i, bucket.stored);
    bucket.faces.for_each_neighbors(neighbors, [&](const auto& across) {
      for (const BucketNeighbor& neighbor : across) results_.neighbors->add(numbers_[neighbor]);
    });
  }

  // Writes the numbers of the ghost faces in increasing order.
  void write_ghost_faces() {
    std::vector<std::uint64_t> numbers;
    numbers.reserve(joined_.faces.ghost_faces.size());
    for (const Index face : joined_.faces.ghost_faces) numbers.push_back(numbers_.faces[face]);
    std::ranges::sort(numbers);
    for (const std::uint64_t number : numbers) results_.ghost_faces->add(number);
  }

  // Adds the areas of the cells of a bucket's vertices.
  void write_areas(const NumberedBucket& bucket) {
    const std::vector<double> areas = areas_of(bucket);
    results_.areas->add(store_.vertex_rows(bucket.i, bucket.stored), areas);
  }

  std::vector<double> areas_of(const NumberedBucket& bucket) {
    const LargeVector<Triple> faces = store_.faces(bucket.i, bucket.stored);
    const LargeVector<Triple> neighbors = store_.neighbors(bucket.i, bucket.stored);
    const LargeVector<Point> points = store_.points(bucket.i, bucket.stored);
    const LargeVector<Index> places = bucket.faces.places_of_own();
    const BucketSurface surface(faces, neighbors, bucket.border, joined_.faces, bucket.first_site,
                                bucket.first_edge);
    const auto number = [&](Index code) {
      return surface.is_own(code) ? bucket.faces.first() + places[code]
                                  : numbers_.faces[surface.joined_of(code)];
    };
    return bucket_areas(
        {surface, points, joined_.open_points, state_.counts().all.landmarks(), number}, options_);
  }

  const RunState& state_;
  const ResultStore& store_;
  const Joined& joined_;
  GlobalIndex first_face_;
  const system::Job& options_;
  FileResults& results_;
  JoinedNumbers numbers_;
};

// Writes the duplicates of all buckets, in increasing order of site.
void write_duplicates(const RunState& state, const ResultStore& store, RowFile& file) {
  std::vector<std::uint64_t> sizes;
  for (std::size_t i = 0; i < state.num_buckets(); ++i)
    sizes.push_back(state.done(i).num_duplicates);
  const auto read = [&](std::size_t bucket, std::uint64_t first,
                        std::span<DuplicateRow> duplicates) {
    store.read_duplicates(bucket, first, duplicates);
  };
  merge_by_row<DuplicateRow>(sizes, read, [&](const DuplicateRow& duplicate) {
    file.add(duplicate.row);
    file.add(duplicate.representative);
  });
}

// Adds up the counts of all buckets and of the faces between them.
void count_results(const RunState& state, const Joined& joined, OutOfCoreReport& report) {
  for (std::size_t i = 0; i < state.num_buckets(); ++i) {
    report.num_vertices += state.done(i).num_vertices;
    report.num_duplicates += state.done(i).num_duplicates;
    report.num_hidden += state.done(i).num_hidden;
    report.num_faces += state.done(i).num_faces;
  }
  report.dimension = joined.dimension;
  report.num_hidden += joined.num_hidden;
  report.num_vertices -= report.num_hidden;
  report.num_faces += joined.faces.faces.size();
  report.num_ghost_faces = joined.faces.ghost_faces.size();
  report.num_open_sites = joined.open_rows.size();
}

}  // namespace

FileResults::FileResults(const OutOfCoreFiles& files, const std::string& area_scratch)
    : faces(files.faces) {
  if (!files.ghost_faces.empty()) ghost_faces.emplace(files.ghost_faces);
  if (!files.neighbors.empty()) neighbors.emplace(files.neighbors);
  if (!files.duplicates.empty()) duplicates.emplace(files.duplicates);
  if (!files.areas.empty()) areas.emplace(files.areas, area_scratch);
}

// Reserves space: a triangulation of n vertices has at most 2n - 4 faces.
void FileResults::reserve(std::uint64_t num_sites, std::uint64_t first_number) {
  faces.reserve(2 * num_sites, 3, first_number + num_sites);
  if (neighbors) neighbors->reserve(2 * num_sites, 3, first_number + 2 * num_sites);
  if (areas) areas->reserve(num_sites);
}

void FileResults::commit() {
  if (areas) areas->commit();
  if (duplicates) duplicates->commit();
  if (neighbors) neighbors->commit();
  if (ghost_faces) ghost_faces->commit();
  faces.commit();
}

void write_results(const RunState& state, const ResultStore& store, std::uint64_t first_number,
                   const system::Job& options, FileResults& results, OutOfCoreReport& report) {
  system::announce(options, "join", 0);
  const Joined joined = join(state, store, options, results.areas.has_value());
  count_results(state, joined, report);
  const std::uint64_t sites_end = first_number + report.num_sites;
  const std::uint64_t faces_end = first_number + report.num_faces;
  results.faces.begin(report.num_faces, 3, sites_end);
  if (results.neighbors) results.neighbors->begin(report.num_faces, 3, faces_end);
  if (results.ghost_faces) results.ghost_faces->begin(report.num_ghost_faces, 1, faces_end);
  if (results.duplicates) results.duplicates->begin(report.num_duplicates, 2, sites_end);
  if (joined.dimension == 2) {
    ResultWriter(state, store, joined, first_number, options, results).run();
  } else if (results.areas) {
    results.areas->add(joined.open_rows, joined.flat_areas);
  }
  if (results.areas) results.areas->write(report.num_sites, first_number);
  if (results.duplicates) write_duplicates(state, store, *results.duplicates);
}

}  // namespace rondel::distributed
