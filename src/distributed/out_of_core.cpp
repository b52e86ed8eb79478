// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "distributed/out_of_core.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>
#include <utility>

#include "api/validation.h"
#include "distributed/bucket_sites.h"
#include "distributed/file_results.h"
#include "distributed/result_names.h"
#include "distributed/run_state.h"
#include "distributed/scratch_file.h"
#include "distributed/site_spool.h"
#include "rondel/error.h"
#include "system/on_failure.h"

namespace rondel {
namespace distributed {
namespace {

// Returns the path of a scratch file.
std::string path_in(const std::string& scratch, const char* name) {
  return (std::filesystem::path(scratch) / name).string();
}

constexpr std::array<const char*, 5> scratch_names = {"sites", "faces", "borders", "areas",
                                                      "journal"};

// Removes the scratch files and the directory, if it is empty then.
void remove_scratch(const std::string& scratch) {
  std::error_code ignored;
  for (const char* name : scratch_names) std::filesystem::remove(path_in(scratch, name), ignored);
  std::filesystem::remove(scratch, ignored);  // only if it is empty
}

// Refuses to overwrite files that have the names of scratch files but no journal, as they are not
// from a run.
void require_own_scratch(const std::string& scratch) {
  std::error_code ignored;
  if (std::filesystem::exists(path_in(scratch, "journal"), ignored)) return;
  for (const char* name : scratch_names) {
    if (std::filesystem::exists(path_in(scratch, name), ignored)) {
      throw FileError(path_in(scratch, name) +
                      ": not of a run; the scratch directory must be one of its own");
    }
  }
}

// Throws FileError if an input or result is one of the scratch files.
void require_outside_scratch(const std::string& scratch, const std::vector<std::string>& files) {
  for (const char* name : scratch_names) {
    for (const std::string& file : files) {
      if (!file.empty() && are_same_file(file, path_in(scratch, name)))
        throw FileError(file + ": a file of the scratch directory, too");
    }
  }
}

// One run, step by step.
class OutOfCoreRun {
 public:
  OutOfCoreRun(const io::NpyRows& rows, const OutOfCoreFiles& files,
               const OutOfCoreOptions& out_of_core, const RunLimits& limits,
               const system::Job& options)
      : rows_(rows),
        scratch_(out_of_core.scratch),
        limits_(limits),
        options_(options),
        results_(files, scratch_path("areas")),
        parts_{!files.neighbors.empty() || !files.areas.empty(), !files.areas.empty()},
        about_(about()),
        state_(scratch_path("journal"), about_, out_of_core.resume) {}

  // True if something has been done that is worth keeping.
  [[nodiscard]] bool has_begun() const { return state_.has_counts(); }

  // Runs all steps; sets `has_begun` as soon as something is worth keeping.
  OutOfCoreReport run(bool& has_begun) {
    reserve();
    if (!state_.has_counts()) {
      state_.set_counts(
          count_sites(rows_, options_, limits_.max_bucket_sites, limits_.piece_sites));
    }
    has_begun = true;
    check_buckets();
    const auto& cuts = state_.counts().cuts;
    SiteSpool spool(scratch_path("sites"), cuts);
    ResultStore store(scratch_path("faces"), scratch_path("borders"), cuts, parts_);
    OutOfCoreReport report;
    report.num_sites = rows_.num_rows();
    report.num_buckets = state_.num_buckets();
    report.num_resumed = find_done(store);
    do_buckets(spool, store);
    check_open_sites(store);
    write_results(state_, store, limits_.first_number, options_, results_, report);
    if (!is_still_the_same()) throw FileError(rows_.name() + ": changed while it was read");
    results_.commit();
    return report;
  }

 private:
  // Reserves the disk space that the number of sites determines: all but what buckets leave open.
  void reserve() {
    results_.reserve(rows_.num_rows(), limits_.first_number);
    ScratchFile(scratch_path("sites")).reserve(slot_bytes * rows_.num_rows());
    ScratchFile(scratch_path("faces")).reserve(bytes_of_stored_site(parts_) * rows_.num_rows());
  }

  [[nodiscard]] std::string scratch_path(const char* name) const { return path_in(scratch_, name); }

  // Returns what must be the same if a run is to be resumed.
  [[nodiscard]] std::vector<RunPart> about() const {
    constexpr std::uint64_t version = 2;
    std::error_code ignored;
    const auto time = std::filesystem::last_write_time(rows_.name(), ignored);
    const Sphere& sphere = options_.sphere;
    const std::vector<double> numbers = {sphere.center.x, sphere.center.y, sphere.center.z,
                                         sphere.squared_radius};
    WordWriter sphere_words;
    sphere_words.add(numbers);
    return {{"another version of Rondel", {version}},
            {"other sites: the file has another size", {rows_.num_rows(), rows_.num_bytes()}},
            {"other sites: the file was changed at another time",
             {static_cast<std::uint64_t>(time.time_since_epoch().count())}},
            {"other options: the model", {static_cast<std::uint64_t>(options_.model)}},
            {"other options: degrees or radians", {std::uint64_t{rows_.are_radians()}}},
            {"other options: the results that are wanted",
             {std::uint64_t{parts_.has_neighbors}, std::uint64_t{parts_.has_points}}},
            {"other options: the sphere", sphere_words.words()}};
  }

  // True if input and options have not changed since the beginning of the run.
  [[nodiscard]] bool is_still_the_same() const {
    return std::ranges::equal(about(), about_, {}, &RunPart::words, &RunPart::words);
  }

  // Throws if the buckets are too large, since an earlier run may have had more memory.
  void check_buckets() const {
    for (const BucketCut& cut : state_.counts().cuts) {
      if (cut.num_sites <= limits_.max_bucket_sites || cut.square.bits == order::low_levels)
        continue;
      throw FileError(scratch_ + ": a run with buckets of " + std::to_string(cut.num_sites) +
                      " sites, for which " + memory_of_bucket(cut.num_sites) +
                      " of memory are needed");
    }
  }

  // Forgets finished buckets that the files do not contain, and returns the number of the others.
  std::uint64_t find_done(const ResultStore& store) {
    std::uint64_t num_done = 0;
    for (std::size_t i = 0; i < state_.num_buckets(); ++i) {
      if (!state_.is_done(i)) continue;
      if (store.has(i, state_.done(i))) {
        ++num_done;
      } else {
        state_.lose_done(i);
      }
    }
    return num_done;
  }

  // Scatters and triangulates all buckets that are not done; tries again once if the spool was
  // damaged.
  void do_buckets(SiteSpool& spool, ResultStore& store) {
    scatter(spool);
    if (!triangulate(spool, store)) {
      scatter(spool);
      if (!triangulate(spool, store))
        throw FileError(scratch_path("sites") + ": what is read is not what was written");
    }
  }

  // Scatters the sites of all buckets that are neither done nor scattered.
  void scatter(SiteSpool& spool) {
    std::vector<bool> wanted(state_.num_buckets());
    for (std::size_t i = 0; i < wanted.size(); ++i)
      wanted[i] = !state_.is_done(i) && !state_.is_scattered(i);
    if (std::ranges::find(wanted, true) == wanted.end()) return;
    state_.set_scattered(
        spool.scatter(rows_, options_, wanted, limits_.piece_sites, limits_.first_number), wanted);
  }

  // Triangulates the buckets. Returns false if some slots of the spool do not contain what was
  // scattered.
  bool triangulate(const SiteSpool& spool, ResultStore& store) {
    bool are_all_done = true;
    for (std::size_t i = 0; i < state_.num_buckets(); ++i) {
      if (state_.is_done(i)) continue;
      system::obey_stop();
      system::announce(options_, "triangulate", i, state_.num_buckets());
      if (triangulate(i, spool, store)) continue;
      state_.lose_scattered(i);
      are_all_done = false;
    }
    return are_all_done;
  }

  // Triangulates and stores bucket i; returns false if its slot is damaged.
  bool triangulate(std::size_t i, const SiteSpool& spool, ResultStore& store) {
    const BucketCut& cut = state_.counts().cuts[i];
    const BucketFiles files = {spool, store, i, cut.num_sites, state_.scattered(i)};
    StoredBucket stored;
    const bool is_crowd = cut.square.bits == order::low_levels;
    const std::uint64_t max_num_sites = is_crowd ? limits_.max_num_sites : cut.num_sites;
    auto sites = read_bucket_sites(files, max_num_sites, options_, stored);
    if (!sites) return false;
    system::Job job = options_;
    job.progress = {};  // the progress over all buckets is shown instead
    bulk::Bucket bucket =
        bulk::triangulate_bucket(sites->points, cut.square, state_.counts().all, job);
    StoredBorder border;
    border.border = std::move(bucket.border);
    for (const bulk::SeamSite& site : border.border.open_sites)
      border.points.push_back(sites->points[bucket.order.order[site.rank]]);
    LargeVector<Point> points;
    if (parts_.has_points) {
      points = vertex_points(bucket.order, *sites);
      for (const bulk::SeamSite& site : border.border.open_sites)
        border.named_points.push_back(points[site.rank]);
    }
    sites->points = {};
    sites->named_points = {};
    if (sites->rows.empty()) {
      auto rows = read_bucket_rows(files);
      if (!rows) return false;
      sites->rows = *std::move(rows);
    }
    store.add_duplicates(i, stored, duplicate_rows(bucket.order.duplicates, sites->rows));
    const auto rows = vertex_rows(bucket.order, sites->rows);
    for (const bulk::SeamSite& site : border.border.open_sites)
      border.rows.push_back(rows[site.rank]);
    store.write(i, bucket, rows, points, border, stored);
    state_.set_done(i, stored);
    return true;
  }

  // Throws FileError if the open sites of all buckets are too many for the memory.
  void check_open_sites(const ResultStore& store) const {
    std::uint64_t num_open = 0;
    for (std::size_t i = 0; i < state_.num_buckets(); ++i)
      num_open += store.num_open_sites(state_.done(i));
    if (num_open <= limits_.max_open_sites) return;
    throw FileError(
        scratch_ + ": the faces of " + std::to_string(num_open) + " of " +
        std::to_string(rows_.num_rows()) + " sites reach beyond every bucket; to join them " +
        memory_of_open_sites(num_open) + " of memory are needed, then the run can be resumed");
  }

  const io::NpyRows& rows_;
  std::string scratch_;
  const RunLimits& limits_;
  const system::Job& options_;
  FileResults results_;
  StoreParts parts_;
  std::vector<RunPart> about_;
  RunState state_;
};

}  // namespace

OutOfCoreReport run(const io::NpyRows& rows, const OutOfCoreFiles& files,
                    const OutOfCoreOptions& out_of_core, const RunLimits& limits,
                    const system::Job& options) {
  std::error_code error;
  require_own_scratch(out_of_core.scratch);
  std::filesystem::create_directories(out_of_core.scratch, error);
  if (error) throw FileError(out_of_core.scratch + ": " + error.message());
  bool is_ours = false;  // false if it belongs to another run
  bool has_begun = false;
  system::OnFailure remove([&] {
    std::error_code ignored;
    if (!is_ours) std::filesystem::remove(out_of_core.scratch, ignored);  // only if it is empty
    if (is_ours && !has_begun) remove_scratch(out_of_core.scratch);
  });
  OutOfCoreReport report;
  {
    OutOfCoreRun run(rows, files, out_of_core, limits, options);
    is_ours = true;
    has_begun = run.has_begun();
    report = run.run(has_begun);
  }
  remove.succeed();
  remove_scratch(out_of_core.scratch);
  return report;
}

}  // namespace distributed

OutOfCoreReport delaunay_file(const std::string& sites, const OutOfCoreFiles& files,
                              const OutOfCoreOptions& out_of_core, const Options& options,
                              const Execution& execution) {
  const system::Call call(execution);
  api::validate(options, 0);
  distributed::require_different(
      sites, {files.faces, files.neighbors, files.areas, files.duplicates, files.ghost_faces});
  distributed::require_outside_scratch(
      out_of_core.scratch,
      {sites, files.faces, files.neighbors, files.areas, files.duplicates, files.ghost_faces});
  const io::NpyRows rows(sites, out_of_core.radians);
  const auto limits = distributed::limits_of(out_of_core.memory);
  return distributed::run(rows, files, out_of_core, limits, {options, execution});
}

}  // namespace rondel
