// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Areas: each rank computes those of the sites in its buckets and sends them to the ranks that gave
// the sites. Circumcenters: each rank computes those of its faces, in pieces for its threads.

#include "distributed/rank_duals.h"

#include <algorithm>
#include <array>
#include <utility>

#include "api/triangulation_impl.h"
#include "distributed/bucket_areas.h"
#include "distributed/bucket_surface.h"
#include "distributed/rank_counts.h"
#include "dual/parts.h"
#include "rondel/error.h"
#include "system/parallel.h"

namespace rondel::distributed {
namespace {

using Impl = DistributedTriangulation::Impl;
using FaceCorners = std::array<BucketCorner, 3>;

void require_points(const Impl& t) {
  if (!t.has_points) {
    throw InvalidInput("the points were not kept: see DistributedOptions::keep_points");
  }
}

// Sends the areas of the rank's own sites to the ranks that gave the sites.
class AreasHome {
 public:
  AreasHome(BspSession& session, const Impl& t, const Execution& execution)
      : session_(session), t_(t), job_{t.options, execution}, sent_(session.size()) {}

  std::vector<double> run() {
    session_.begin("areas");
    require_points(t_);
    areas_.resize(t_.first_site[session_.rank() + 1] - t_.first_site[session_.rank()]);
    add_buckets();
    for (const SiteArea& area : t_.flat_areas) add(area);
    std::vector<Bytes> messages;
    for (std::vector<SiteArea>& list : sent_) {
      MessageWriter writer;
      writer.add(std::exchange(list, {}));
      messages.push_back(writer.take());
    }
    const std::vector<Bytes> received = session_.exchange(std::move(messages));
    for (const Bytes& message : received) {
      for (const SiteArea& area : MessageReader(message).values<SiteArea>()) add(area);
    }
    return std::move(areas_);
  }

 private:
  void add(const SiteArea& area) {
    const std::uint64_t site = area.site - t_.first_number;
    const std::size_t home = rank_of_site(site, t_.first_site);
    if (home == session_.rank()) {
      areas_[site - t_.first_site[home]] = area.area;
    } else {
      sent_[home].push_back(area);
    }
  }

  void add_buckets() {
    Index first_site = t_.part.first_site;
    Index first_edge = t_.part.first_edge;
    for (std::size_t b = 0; b < t_.faces.size(); ++b) {
      system::obey_stop();
      const bulk::Bucket& bucket = t_.own.buckets[b];
      const BucketSurface surface(bucket.faces, bucket.neighbors, bucket.border, t_.part.faces,
                                  first_site, first_edge);
      add_areas(b, surface);
      first_site += static_cast<Index>(bucket.border.open_sites.size());
      first_edge += static_cast<Index>(bucket.border.open_edges.size());
    }
  }

  void add_areas(std::size_t b, const BucketSurface& surface) {
    const LargeVector<Index> places = t_.faces[b].places_of_own();
    const auto number = [&](Index code) {
      return surface.is_own(code) ? t_.faces[b].first() + places[code]
                                  : t_.numbers->faces[surface.joined_of(code)];
    };
    const std::vector<double> areas = bucket_areas(
        {surface, t_.own.points_of(b), t_.part.site_points, t_.landmarks, number}, job_);
    const auto sites = t_.own.sites_of(b);
    for (std::size_t i = 0; i < sites.size(); ++i) add({sites[i], areas[i]});
  }

  BspSession& session_;
  const Impl& t_;
  system::Job job_;
  std::vector<double> areas_;
  std::vector<std::vector<SiteArea>> sent_;  // by rank
};

// Some faces and the points of their corners. A corner may be listed more than once, so that a
// small table suffices to find most repetitions.
class FacePiece {
 public:
  FacePiece(const Impl& t, std::size_t bucket)
      : own_points_(t.own.points_of(bucket)),
        open_points_(t.part.site_points),
        options_(t.options),
        points_(t.landmarks) {}

  std::vector<Point> circumcenters(std::span<const FaceCorners> faces) {
    slots_.assign(num_slots, {no_index, 0});
    TriangulationArrays arrays;
    arrays.dimension = 2;
    arrays.faces.reserve(faces.size());
    for (const auto& [a, b, c] : faces) {
      const Index first = place(a);
      const Index second = place(b);
      arrays.faces.push_back({first, second, place(c)});
    }
    arrays.num_sites = points_.size();
    return dual::circumcenters_within(
        api::make_triangulation(Sites(std::move(points_)), std::move(arrays), options_, {}));
  }

 private:
  static constexpr Index num_slots = 1U << 14U;
  struct ListedSite {
    Index rank;
    Index place;
  };

  Index place(const BucketCorner& v) {
    if (!v.is_own) return add(open_points_[v.index]);
    ListedSite& slot = slots_[v.index % num_slots];
    if (slot.rank != v.index) slot = {v.index, add(own_points_[v.index])};
    return slot.place;
  }

  Index add(const Point& p) {
    points_.push_back(p);
    return static_cast<Index>(points_.size() - 1);
  }

  std::span<const Point> own_points_;
  std::span<const Point> open_points_;
  const Options& options_;
  std::vector<Point> points_;
  std::vector<ListedSite> slots_;
};

// The number of faces that one thread takes at a time.
constexpr std::size_t piece_faces = std::size_t{1} << 14;

// Takes the faces of a bucket one by one, and computes their circumcenters many at a time.
class CircumcenterVisits {
 public:
  CircumcenterVisits(const Impl& t, std::size_t bucket, unsigned threads,
                     const std::function<void(std::span<const Point>)>& visit)
      : t_(t),
        bucket_(bucket),
        threads_(threads),
        max_faces_(piece_faces * std::max(system::num_threads(threads), 1U)),
        visit_(visit) {}

  void add(const FaceCorners& face) {
    faces_.push_back(face);
    if (faces_.size() == max_faces_) flush();
  }

  void flush() {
    if (faces_.empty()) return;
    centers_.resize(faces_.size());
    const auto find = [&](std::size_t begin, std::size_t end) {
      const auto found =
          FacePiece(t_, bucket_).circumcenters(std::span(faces_).subspan(begin, end - begin));
      std::ranges::copy(found, centers_.begin() + static_cast<std::ptrdiff_t>(begin));
    };
    system::parallel_for(threads_, faces_.size(), piece_faces, find);
    visit_(centers_);
    faces_.clear();
  }

 private:
  const Impl& t_;
  std::size_t bucket_;
  unsigned threads_;
  std::size_t max_faces_;
  const std::function<void(std::span<const Point>)>& visit_;
  std::vector<FaceCorners> faces_;
  std::vector<Point> centers_;
};

}  // namespace

std::vector<double> areas_on_ranks(BspSession& session, const Impl& triangulation,
                                   const Execution& execution) {
  return AreasHome(session, triangulation, execution).run();
}

void visit_circumcenters(const Impl& triangulation, const Execution& execution,
                         const std::function<void(std::span<const Point>)>& visit) {
  require_points(triangulation);
  for (std::size_t b = 0; b < triangulation.faces.size(); ++b) {
    system::obey_stop();
    CircumcenterVisits visits(triangulation, b, execution.threads, visit);
    triangulation.faces[b].for_each_face(triangulation.own.buckets[b].faces,
                                         [&](const FaceCorners& corners) { visits.add(corners); });
    visits.flush();
  }
}

}  // namespace rondel::distributed
