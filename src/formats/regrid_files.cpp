// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Regrids the fields of a file: reads them slice by slice, applies weights, and writes them. Weights
// are computed once for each method and kept; where they would not fit into memory, they are
// computed tile by tile.
#include "rondel/regrid_files.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <system_error>
#include <utility>

#include "formats/places_of_points.h"
#include "formats/regrid_carry.h"
#include "formats/regrid_fields.h"
#include "formats/regrid_inputs.h"
#include "formats/regrid_output.h"
#include "formats/regrid_plan.h"
#include "formats/regrid_processes.h"
#include "formats/regrid_side.h"
#include "formats/regrid_tiles.h"
#include "formats/regrid_vectors.h"
#include "formats/side_areas.h"
#include "formats/zonal_files.h"
#include "rondel/error.h"
#include "rondel/fields.h"
#include "rondel/names.h"
#include "rondel/read_cells.h"
#include "rondel/tiled_remap.h"
#include "system/job.h"
#include "system/message_text.h"
#include "system/parallel.h"

namespace rondel {
namespace {

using formats::RegridOutput;
using formats::RegridRanks;
using formats::RegridSide;

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

bool is_conservative(FieldMethod method) {
  return method == FieldMethod::conservative || method == FieldMethod::conservative_2nd ||
         method == FieldMethod::largest_share;
}

// Returns the files that are read, as they are now.
formats::RegridInputs inputs_of(const FileName& in, const FileName& target,
                                const RegridFileOptions& options) {
  formats::RegridInputs inputs;
  inputs.add("input", in);
  inputs.add("target", target);
  if (options.source) inputs.add("source", *options.source);
  return inputs;
}

std::string text_of(const std::optional<ExtrapolationOptions>& options) {
  if (!options) return "none";
  return std::string(name_of(options->method)) + ' ' +
         (options->max_distance_km ? system::shortest_text(*options->max_distance_km) : "any") +
         ' ' + std::to_string(options->neighbors) + ' ' + std::to_string(options->exponent) + ' ' +
         std::to_string(options->levels);
}

// Throws InvalidInput for a number out of range, and for an option that differs from its default and
// would change nothing.
void require_effects(const RegridFileOptions& options, const FileName& target,
                     const FileName& out) {
  if (!(options.max_missing >= 0 && options.max_missing <= 1)) {
    throw InvalidInput("max_missing is " + system::shortest_text(options.max_missing) +
                       ", not in [0, 1]");
  }
  if (options.netcdf.deflate < 0 || options.netcdf.deflate > 9) {
    throw InvalidInput("deflate is " + std::to_string(options.netcdf.deflate) +
                       ", not from 0 to 9");
  }
  const auto require = [](bool has_effect, const char* what) {
    if (!has_effect) throw InvalidInput(what);
  };
  const bool is_compressed = options.netcdf.kind == NetcdfKind::by_name
                                 ? format_of(out) == "nc4"
                                 : options.netcdf.kind == NetcdfKind::netcdf4;
  require(is_compressed || options.netcdf.deflate == NetcdfOptions().deflate,
          "deflate has no effect on files other than netCDF-4, whose names end in .nc4");
  const bool has_norm = options.norm != RemapNorm::fracarea;
  const bool is_of_cells = !options.method || is_conservative(*options.method);
  require(is_of_cells || !has_norm, "norm has no effect with a method between places");
  require(is_of_cells || options.overlap == CellOverlap::error,
          "overlap has no effect with a method between places");
  require(is_of_cells || options.cells.corners == MissingCorners::error,
          "corners have no effect with a method between places");
  require(is_of_cells || options.cells.sides == GridSides::parallels,
          "sides have no effect with a method between places");
  require(is_of_cells || options.cells.invalid == InvalidPolygons::error,
          "invalid has no effect with a method between places");
  require(options.method != FieldMethod::largest_share || !has_norm,
          "norm has no effect with the method largest_share");
  require(options.method == FieldMethod::conservative_2nd || options.limiter == RemapLimiter::none,
          "the limiter has no effect without the method conservative_2nd");
  // Files of GDAL are opened to look for polygons.
  require(options.cells.edges == PolygonEdges::lonlat || can_read_polygons(target) ||
              (options.source && can_read_polygons(*options.source)),
          "edges have no effect without polygons");
  require(is_of_cells || options.cells.edges == PolygonEdges::lonlat,
          "edges have no effect with a method between places");
  const bool has_statistics = !options.statistics.empty();
  require(options.vectors.empty() || options.method != FieldMethod::largest_share,
          "vectors have no largest share");
  require(options.vectors.empty() || !has_statistics, "vectors have no effect with statistics");
  require(!has_statistics || !has_norm, "norm has no effect with statistics");
  require(!has_statistics || options.cells_per_tile == 0, "tiles have no effect with statistics");
  require(has_statistics || options.statistic_weights == ZonalWeights::area,
          "weigh_by has no effect without statistics");
  if (!options.extrapolation) return;
  const ExtrapolationOptions usual;
  const ExtrapolationOptions& own = *options.extrapolation;
  require(own.method == Extrapolation::idw || own.neighbors == usual.neighbors,
          "the number of sources has no effect without the extrapolation idw");
  require(own.method == Extrapolation::idw || own.exponent == usual.exponent,
          "the exponent has no effect without the extrapolation idw");
  require(own.method == Extrapolation::creep || own.levels == usual.levels,
          "levels have no effect without the extrapolation creep");
}

class RegridJob {
 public:
  RegridJob(const FileName& in, const FileName& target, FileName out,
            const RegridFileOptions& options, const RegridRanks& ranks, const Execution& execution)
      : options_(options),
        ranks_(ranks),
        execution_(execution),
        inputs_(inputs_of(in, target, options)),
        needs_cells_(!options.method || is_conservative(*options.method)),
        names_(formats::wanted_variables(in, options.names)),
        mesh_file_(options.source.value_or(file_and_variable(in).first)),
        source_(mesh_file_, "source", options.cells, needs_cells_, execution,
                options.source ? std::vector<std::string>() : names_),
        target_(target, "target", options.cells, needs_cells_, execution),
        out_(std::move(out)) {
    inputs_.require_other(out_);
    open(in);
  }

  RegridFileReport run() {
    // What is not possible with any memory is said before what needs more.
    if (options_.method == FieldMethod::bilinear) formats::PlaceTiles::require_axes(source_);
    report_.sources = source_.num_places();
    report_.targets = target_.num_places();
    const FieldSet& in = fields_->fields();
    FieldSet written =
        formats::fields_at_targets(in, arrays_at_targets(), source_, target_, options_.history);
    make_plan();
    fields_->keep_chunks(
        static_cast<std::size_t>(std::min<std::uint64_t>(plan_.spare / 2, usual_kept_chunks)));
    const bool is_netcdf = is_netcdf_file(out_);
    WeightSide side = target_.description(is_netcdf, execution_);
    if (target_.has_sites() && is_netcdf) {
      const std::string remark = formats::describe_features(written, side);
      if (!remark.empty()) formats::add_remarks(out_.path, {remark}, report_.remarks);
    }
    std::optional<RegridOutput> output;
    if (ranks_.is_first()) {
      output.emplace(out_, written, side, options_.netcdf, execution_);
      if (options_.resume) output->keep(partial_name(), facts());
    } else {
      output.emplace();
    }
    if (ranks_.size > 1) output->set_num_kept(ranks_.number_of_first(output->num_kept()));
    report_.resumed = output->num_kept();
    for (std::size_t a = 0; a < in.arrays.size(); ++a) {
      carry(a, method_of(in.arrays[a]), *output);
      report_.fields += in.arrays[a].num_fields();
    }
    inputs_.require_unchanged();
    // All ranks have come so far before the file appears.
    if (ranks_.size > 1) gather_extrapolated();
    report_.missing = output->num_missing();
    std::ranges::move(output->remarks(), std::back_inserter(report_.remarks));
    output->finish();
    return std::move(report_);
  }

 private:
  // True if the first variable that is named has values at other places than the source's cells.
  [[nodiscard]] bool is_elsewhere(const FileName& file) const {
    if (names_.empty()) return false;
    try {
      const NetcdfSites sites = read_netcdf_sites(file, std::span(names_).first(1), false);
      return sites.table.sites.size() != source_.num_places();
    } catch (const FileError&) {
      return false;
    }
  }

  void open(const FileName& in) {
    const FileName file = file_and_variable(in).first;
    fields_name_ = file.path;
    try {
      fields_ = formats::open_fields(in, names_, source_);
    } catch (const FileError& error) {
      if (!needs_cells_ || !is_elsewhere(file)) throw;
      throw FileError(std::string(error.what()) +
                      "; means over cells need values of cells, and other methods take any places");
    }
    report_.remarks = formats::remarks_of(source_, target_, fields_name_, fields_->fields());
    vectors_.emplace(*fields_, fields_name_, options_.vectors, source_, target_);
    find_sums();
    tell_of_reading();
  }

  // Adds a remark if what the file stores together does not fit into the memory.
  void tell_of_reading() {
    const std::uint64_t bytes = fields_->bytes_beside();
    if (bytes <= options_.memory) return;
    formats::add_remarks(fields_name_,
                         {"reading takes " + formats::mebibytes_of(bytes) +
                          " beside the memory of " + formats::mebibytes_of(options_.memory) +
                          ", as a chunk is uncompressed as a whole, and times that are stored "
                          "together are read together; nccopy -c makes other chunks"},
                         report_.remarks);
  }

  // Sums what all processes have extrapolated.
  void gather_extrapolated() {
    RegridRanks::Message own(sizeof(std::uint64_t));
    const std::uint64_t number = report_.extrapolated;
    std::memcpy(own.data(), &number, sizeof number);
    report_.extrapolated = 0;
    const std::vector<RegridRanks::Message> of_all = ranks_.gather(std::move(own));
    for (const RegridRanks::Message& message : of_all) {
      std::uint64_t of_rank = 0;
      std::memcpy(&of_rank, message.data(), sizeof of_rank);
      report_.extrapolated += of_rank;
    }
    // Messages come to the first process alone, which tells the others the sum.
    report_.extrapolated = ranks_.number_of_first(report_.extrapolated);
  }

  // Components of vectors are no categories, which RegridVectors refuses.
  [[nodiscard]] FieldMethod method_of(const FieldArray& array) const {
    if (options_.method) return *options_.method;
    return formats::has_flags(array) ? FieldMethod::largest_share : FieldMethod::conservative;
  }

  // Returns what the cost of cells depends on.
  [[nodiscard]] static formats::RegridCells facts_of(const RegridSide& side) {
    return {.cells = side.num_places(),
            .have_parallels = side.has_parallels(),
            .have_axes = side.axes() != nullptr,
            .are_stored = side.num_stored() > 0};
  }

  // True if a tile needs consecutive sources. Extrapolation needs all of them.
  [[nodiscard]] bool has_windows() const {
    return needs_cells_ && source_.has_parallels() && !options_.extrapolation;
  }

  // True if an array has sums over cells, of which each target gets its share. The method keeps them.
  [[nodiscard]] bool keeps_sums_of(std::size_t array) const {
    const FieldMethod method = method_of(fields_->fields().arrays[array]);
    return has_sums_[array] && vectors_->components(array) == 1 &&
           (method == FieldMethod::conservative || method == FieldMethod::conservative_2nd);
  }

  // Returns the arrays as they are written: their attributes say what was done over cells. Flags stay flags
  // where each target has the value of one source.
  [[nodiscard]] std::vector<FieldArray> arrays_at_targets() const {
    std::vector<FieldArray> arrays = fields_->fields().arrays;
    const auto& filling = options_.extrapolation;
    const bool is_mixed = filling && filling->method != Extrapolation::nearest;
    for (std::size_t a = 0; a < arrays.size(); ++a) {
      const FieldMethod method = method_of(arrays[a]);
      const bool is_largest = method == FieldMethod::largest_share;
      if ((!is_largest && method != FieldMethod::nearest) || is_mixed) remove_flags(arrays[a]);
      if (!is_conservative(method)) continue;
      const char* const done = is_largest ? "mode" : keeps_sums_of(a) ? "sum" : "mean";
      formats::add_cell_method(done, arrays[a]);
    }
    return arrays;
  }

  // Finds the arrays with sums over cells, and tells of those that do not stay sums.
  void find_sums() {
    const std::vector<FieldArray>& arrays = fields_->fields().arrays;
    for (const FieldArray& array : arrays) {
      has_sums_.push_back(formats::has_sums_over_cells(array));
    }
    for (std::size_t a = 0; a < arrays.size(); ++a) {
      if (!has_sums_[a]) continue;
      const std::string about = "\"" + arrays[a].name + "\" has sums over cells, by cell_methods";
      if (!keeps_sums_of(a)) {
        formats::add_remarks(fields_name_,
                             {about + ": only the conservative methods keep them, of scalars"},
                             report_.remarks);
      } else if (options_.extrapolation) {
        formats::add_remarks(fields_name_, {about + ", which are not extrapolated"},
                             report_.remarks);
      }
    }
  }

  [[nodiscard]] bool any_sums() const { return std::ranges::count(has_sums_, true) > 0; }

  // Adds what sums over cells, extrapolation and columns beside the places need beside weights.
  void add_costs(formats::RegridTask& task) const {
    const std::uint64_t of_columns =
        2 * target_.bytes_of_columns() / std::max<std::size_t>(report_.targets, 1);
    task.cost.of_target += of_columns;
    task.cost.of_target_beside += of_columns;
    if (any_sums() && needs_cells_) {
      // The area of a source, and of a target the area by which densities become sums.
      const std::size_t of_source = source_.lines_between() == nullptr ? sizeof(double) : 0;
      task.cost.of_source += of_source;
      task.cost.of_source_beside += of_source;
      task.cost.of_target += sizeof(double);
    }
    if (options_.extrapolation) {
      // A place and its neighbors on both sides; these were measured and rounded up.
      const std::uint64_t of_target =
          options_.extrapolation->method == Extrapolation::creep ? 350 : 40;
      constexpr std::uint64_t of_source = 120;
      task.cost.of_source += of_source;
      task.cost.of_source_beside += of_source;
      task.cost.of_target += of_target;
      task.cost.of_target_beside += of_target;
      task.has_whole_fields = true;
    }
  }

  [[nodiscard]] bool is_limited() const { return options_.limiter != RemapLimiter::none; }
  // Returns why weights that are limited have no tiles.
  [[nodiscard]] const char* of_limiter() const {
    return options_.limiter == RemapLimiter::slopes ? "slopes are limited field by field"
                                                    : "the limiter needs the values of all targets";
  }

  // Decides what is in memory at a time. All methods of a file have weights of one kind.
  void make_plan() {
    formats::RegridTask task;
    task.sources = report_.sources;
    task.targets = report_.targets;
    for (const FieldArray& array : fields_->fields().arrays) {
      task.fields = std::max<std::uint64_t>(task.fields, array.num_fields());
    }
    if (!options_.vectors.empty()) {
      // The two components on the sphere and the three in space; at the target three, and one of them.
      task.per_source = 5;
      task.per_target = 4;
    }
    task.memory = options_.memory;
    task.tile = options_.cells_per_tile;
    task.threads = system::num_threads(execution_.threads);
    task.num_processes = ranks_.size;
    const bool is_second = options_.method == FieldMethod::conservative_2nd;
    if (needs_cells_) {
      task.has_tiles = !(is_second && (is_limited() || source_.num_stored() > 0)) &&
                       source_.has_tiles(execution_) && target_.has_tiles(execution_) &&
                       (source_.is_walked() || target_.is_walked());
      task.are_cells = true;
      task.is_in_order = target_.has_parallels();
      task.has_windows = has_windows();
      task.largest_target = target_.largest_share();
      task.rows = target_.has_parallels() ? target_.axes()->lat_deg.size() : 1;
      task.cost = formats::cost_of_cells(facts_of(source_), facts_of(target_), is_second);
    } else {
      task.has_tiles = true;
      task.is_in_order = true;
      task.cost = formats::PlaceTiles::cost_of(*options_.method);
    }
    add_costs(task);
    plan_ = plan_of(task);
    // A run that may be resumed loses the fields of one group of tiles. Weights are computed again
    // for each group, which takes as long as some fields do.
    constexpr std::size_t fields_to_lose = 16;
    if (options_.resume && plan_.has_tiles) {
      plan_.fields_at_once = std::min(plan_.fields_at_once, fields_to_lose);
    }
    if (task.tile > 0 && !plan_.has_tiles) {
      const std::string why = is_second && is_limited() ? of_limiter()
                              : is_second
                                  ? "weights of order 2 need all cells of a source from a file"
                                  : "cells overlap, or neither side covers the sphere or is "
                                    "between parallels";
      formats::add_remarks(fields_name_, {"the number of cells of a tile has no effect: " + why},
                           report_.remarks);
    }
  }

  // Returns the weights of a method; those of targets with too small a part that is covered are removed
  // unless the file has sums, of which any part counts. Of conservative_2nd there are none here, but in
  // second_.
  const Weights& weights_of(FieldMethod method) {
    if (method == FieldMethod::largest_share) method = FieldMethod::conservative;
    if (second_ && is_second_of_sums_ != are_sums_) {
      second_.reset();
      weights_.erase(FieldMethod::conservative_2nd);
    }
    const auto known = weights_.find(method);
    if (known != weights_.end()) return known->second;
    Weights made = is_conservative(method)
                       ? conservative_weights(method)
                       : place_tiles(method, report_.targets)->tile(0, execution_).weights;
    return weights_.emplace(method, std::move(made)).first->second;
  }

  Weights conservative_weights(FieldMethod method) {
    RemapOptions options;
    options.order = method == FieldMethod::conservative_2nd ? 2 : 1;
    options.norm = options_.norm;
    options.overlap = options_.overlap;
    Remap made = remap(source_.cells(execution_), target_.cells(execution_), options, execution_);
    covered_ = covered_enough(made.target_fractions, options_.max_missing);
    if (any_sums()) {
      areas_of_targets_ =
          formats::areas_of_sums(made.target_areas, made.target_fractions, options_.norm);
    }
    if (options.order == 1) {
      return any_sums() ? std::move(made.weights) : with_rows(made.weights, covered_);
    }
    // Any part of a target is enough for a sum.
    second_.emplace(std::move(made), are_sums_ ? std::vector<std::int32_t>() : covered_,
                    options_.limiter);
    is_second_of_sums_ = are_sums_;
    return {};
  }

  // Makes sums of densities. In a file that has sums, weights are those of all targets; so values of means
  // are left out here where too small a part is covered.
  void finish_beside_sums(std::span<double> carried) const {
    for (std::size_t first = 0; first < carried.size(); first += report_.targets) {
      for (std::size_t target = 0; target < report_.targets; ++target) {
        double& value = carried[first + target];
        if (are_sums_) {
          value *= areas_of_targets_[target];
        } else if (covered_[target] == 0) {
          value = missing;
        }
      }
    }
  }

  // True if the area of a missing value counts as 0, so that integrals are kept.
  [[nodiscard]] bool keeps_sums() const {
    return are_sums_ || (needs_cells_ && options_.norm == RemapNorm::destarea);
  }

  // Returns the share of a target that may lack values. Of a sum each part that is there counts, or
  // it would not be kept.
  [[nodiscard]] double max_missing() const { return are_sums_ ? 1 : options_.max_missing; }

  // Returns the areas by which sums of the present array become densities; null for others.
  const formats::SideAreas* areas_of_sources() {
    if (!are_sums_) return nullptr;
    if (!areas_of_sources_) areas_of_sources_.emplace(source_, execution_);
    return &*areas_of_sources_;
  }

  // Extrapolates fields that were carried, if the options ask for it.
  void extrapolate(std::span<const double> values, std::span<double> carried) {
    if (!options_.extrapolation || are_sums_) return;
    if (!filler_) {
      filler_.emplace(
          formats::extrapolator_between(source_, target_, *options_.extrapolation, execution_));
    }
    for (std::size_t f = 0; f * report_.targets < carried.size(); ++f) {
      const std::size_t number =
          filler_->fill(values.subspan(f * report_.sources, report_.sources),
                        carried.subspan(f * report_.targets, report_.targets), execution_);
      // The components of a vector in space get their values together.
      if (f % components_ == 0) report_.extrapolated += number;
    }
  }

  // Returns the weights of a method between places. What they leave out becomes a remark.
  std::unique_ptr<formats::PlaceTiles> place_tiles(FieldMethod method, std::size_t per_tile) {
    FileName mesh = mesh_file_;
    if (!options_.source && !names_.empty()) mesh.path += ":" + names_.front();
    auto made =
        std::make_unique<formats::PlaceTiles>(source_, target_, method, mesh, per_tile, execution_);
    formats::add_remarks(file_and_variable(mesh_file_).first.path, made->remarks(),
                         report_.remarks);
    coincident_ = made->coincident();
    return made;
  }

  // Carries the fields of an array.
  void carry(std::size_t array, FieldMethod method, RegridOutput& output) {
    const std::size_t num_fields = fields_->fields().arrays[array].num_fields();
    components_ = vectors_->components(array);
    are_sums_ = keeps_sums_of(array);
    if (!plan_.has_tiles) {
      carry_slices(array, num_fields, method, output);
      return;
    }
    const formats::RegridTiles& weights = tiles(method);
    const formats::ArrayToCarry job{.file = *vectors_,
                                    .array = array,
                                    .num_fields = num_fields,
                                    .sources = report_.sources,
                                    .targets = report_.targets,
                                    .has_windows = has_windows(),
                                    .is_largest_share = method == FieldMethod::largest_share,
                                    .max_missing = max_missing(),
                                    .keeps_sums = keeps_sums(),
                                    .areas_of_sources = areas_of_sources(),
                                    .norm = options_.norm,
                                    .complete = completing(),
                                    .coincident = coincident_};
    formats::TileCarrier(weights, plan_, job, output, ranks_, execution_).run();
  }

  // Returns what extrapolates whole fields; nothing if that is not asked for.
  formats::ArrayToCarry::Complete completing() {
    if (!options_.extrapolation || are_sums_) return {};
    return [this](std::span<const double> values, std::span<double> carried) {
      extrapolate(values, carried);
    };
  }

  // Returns how many fields are carried at once. Each process gets some; and a run that may be
  // resumed loses those of one slice.
  [[nodiscard]] std::size_t fields_of_slice(std::size_t num_fields) const {
    constexpr std::size_t values_to_lose = std::size_t{1} << 20U;
    std::size_t most = plan_.fields_at_once;
    if (options_.resume)
      most = std::min(most, values_to_lose / std::max<std::size_t>(report_.targets, 1));
    most = std::min(most, (num_fields + ranks_.size - 1) / ranks_.size);
    return std::max<std::size_t>(most, 1);
  }

  // Carries fields with the weights of all targets, as many at a time as a slice has room for.
  void carry_slices(std::size_t array, std::size_t num_fields, FieldMethod method,
                    RegridOutput& output) {
    const std::size_t begin = output.skip_fields(num_fields, report_.targets);
    const std::size_t of_slice = fields_of_slice(num_fields);
    const std::size_t num_slices = (num_fields - begin + of_slice - 1) / of_slice;
    const auto first_of = [&](std::size_t slice) { return begin + slice * of_slice; };
    const auto end_of = [&](std::size_t slice) {
      return std::min(first_of(slice) + of_slice, num_fields);
    };
    const auto read = [&](std::size_t slice, std::vector<double>& values) {
      values.resize((end_of(slice) - first_of(slice)) * components_ * report_.sources);
      vectors_->read(array, first_of(slice), values, execution_);
    };
    std::vector<double> carried;
    if (ranks_.size == 1) {
      // The room of both is used again.
      std::vector<double> values;
      std::vector<double> next;
      bool is_read = false;
      for (std::size_t slice = 0; slice < num_slices; ++slice) {
        if (!is_read) read(slice, next);
        values.swap(next);
        is_read = false;
        const auto carry_on = [&] {
          carried = vectors_->at_targets(array, carried_slice(values, method));
          output.write(carried);
        };
        if (plan_.reads_ahead && slice + 1 < num_slices) {
          weights_of(method);  // before, as they may be read from the same file
          system::parallel_invoke(
              execution_.threads, [&] { read(slice + 1, next); }, carry_on);
          is_read = true;
        } else {
          carry_on();
        }
        system::announce(execution_, "regrid", end_of(slice), num_fields);
      }
      return;
    }
    formats::deal_units(
        ranks_, 0, num_slices,
        [&](std::size_t slice) {
          std::vector<double> values;
          read(slice, values);
          carried = vectors_->at_targets(array, carried_slice(values, method));
          system::announce(execution_, "regrid", end_of(slice), num_fields);
          const auto bytes = std::as_bytes(std::span<const double>(carried));
          return RegridRanks::Message(bytes.begin(), bytes.end());
        },
        [&](std::size_t /*slice*/, std::span<const std::byte> message) {
          std::vector<double> values(message.size() / sizeof(double));
          std::memcpy(values.data(), message.data(), message.size());
          output.write(values);
        });
  }

  // Missing values are replaced by others at the same place.
  std::vector<double> carried_slice(std::vector<double>& values, FieldMethod method) {
    const Weights& weights = weights_of(method);
    if (!coincident_.empty()) {
      formats::take_values_that_are_there(coincident_, report_.sources, values);
    }
    const std::size_t count = report_.sources == 0 ? 0 : values.size() / report_.sources;
    std::vector<double> carried(count * report_.targets);
    for (std::size_t f = 0; are_sums_ && f < count; ++f) {
      areas_of_sources()->divide(0,
                                 std::span(values).subspan(f * report_.sources, report_.sources));
    }
    const ApplyOptions rules{
        .fill = missing, .max_missing = max_missing(), .keeps_sums = keeps_sums()};
    if (method == FieldMethod::largest_share) {
      apply_largest_share(weights, values, carried, count, rules, execution_);
    } else if (second_ && method == FieldMethod::conservative_2nd) {
      second_->apply(values, carried, rules, execution_);
    } else {
      apply(weights, values, carried, count, rules, execution_);
    }
    if (any_sums() && is_conservative(method)) finish_beside_sums(carried);
    extrapolate(values, carried);
    return carried;
  }

  const formats::RegridTiles& tiles(FieldMethod method) {
    if (tiles_) return *tiles_;
    if (needs_cells_) {
      TiledRemapOptions options;
      options.norm = options_.norm;
      options.order = options_.method == FieldMethod::conservative_2nd ? 2 : 1;
      options.source_mask = source_.mask();
      options.target_mask = target_.mask();
      options.cells_per_tile = plan_.cells_per_tile;
      tiles_ = std::make_unique<formats::ConservativeTiles>(source_.tiled(), target_.tiled(),
                                                            std::move(options), execution_);
    } else {
      tiles_ = place_tiles(method, plan_.cells_per_tile);
    }
    report_.tiles = tiles_->num_tiles();
    return *tiles_;
  }

  // Returns the name of the journal. Throws FileError if the work cannot be resumed.
  [[nodiscard]] std::string partial_name() const {
    if (!inputs_.has("input")) {
      throw FileError(fields_name_ + ": a run can be resumed if its input is a file");
    }
    std::error_code error;
    const bool is_other = std::filesystem::exists(out_.path, error) &&
                          !std::filesystem::is_regular_file(out_.path, error);
    if (out_.bytes != nullptr || out_.path == "-" || is_other) {
      throw FileError(out_.path + ": a run can be resumed if its output is a file");
    }
    return out_.path + ".partial";
  }

  // Returns what the values depend on.
  [[nodiscard]] std::vector<formats::JournalFact> facts() const {
    std::vector<formats::JournalFact> facts = inputs_.facts();
    facts.push_back({"target", target_.name()});
    facts.push_back({"source", source_.name()});
    std::string names;
    for (const FieldArray& array : fields_->fields().arrays) names += array.name + ' ';
    facts.push_back({"variables", names});
    facts.push_back(
        {"method", options_.method ? std::string(name_of(*options_.method)) : "by kind"});
    facts.push_back({"norm", std::string(name_of(options_.norm))});
    facts.push_back({"limiter", std::string(name_of(options_.limiter))});
    facts.push_back({"max_missing", system::shortest_text(options_.max_missing)});
    facts.push_back({"overlap", std::string(name_of(options_.overlap))});
    facts.push_back({"sides", std::string(name_of(options_.cells.sides))});
    facts.push_back({"edges", std::string(name_of(options_.cells.edges))});
    facts.push_back({"corners", std::string(name_of(options_.cells.corners))});
    facts.push_back({"extrapolation", text_of(options_.extrapolation)});
    facts.push_back({"invalid", std::string(name_of(options_.cells.invalid))});
    std::string vectors;
    for (const auto& [east, north] : options_.vectors) {
      vectors.append(east).append(",").append(north).append(" ");
    }
    facts.push_back({"vectors", vectors});
    return facts;
  }

  const RegridFileOptions& options_;
  const RegridRanks& ranks_;
  const Execution& execution_;
  formats::RegridInputs inputs_;
  bool needs_cells_;
  std::vector<std::string> names_;  // of the variables that are wanted; none: all
  FileName mesh_file_;              // has the source
  RegridSide source_;
  RegridSide target_;
  FileName out_;
  std::string fields_name_;  // of the file of the fields
  std::unique_ptr<FieldFile> fields_;
  std::optional<formats::RegridVectors> vectors_;
  std::size_t components_ = 1;  // fields that stand for one of the array that is carried
  std::map<FieldMethod, Weights> weights_;
  std::vector<std::int32_t> covered_;       // targets of which enough is covered
  std::optional<SecondOrderRemap> second_;  // what applies weights of order 2
  bool is_second_of_sums_ = false;
  std::vector<bool> has_sums_;  // by array: whether its values are sums over cells
  bool are_sums_ = false;       // whether the array that is carried has sums that are kept
  std::optional<formats::SideAreas> areas_of_sources_;
  std::vector<double> areas_of_targets_;  // by which densities become sums
  formats::RegridPlan plan_;
  std::unique_ptr<formats::RegridTiles> tiles_;
  std::vector<Duplicate> coincident_;  // sources that share a place
  std::optional<Extrapolator> filler_;
  RegridFileReport report_;
};

}  // namespace

std::string_view name_of(FieldMethod method) noexcept {
  return system::name_in({"conservative", "conservative_2nd", "largest_share", "nearest", "linear",
                          "laplace", "sibson", "hermite", "cubic", "bilinear", "native"},
                         method);
}

RegridFileReport regrid_file(const FileName& in, const FileName& target, const FileName& out,
                             const RegridFileOptions& options, const Execution& execution) {
  return formats::regrid_by_ranks(in, target, out, options, {}, execution);
}

namespace formats {

RegridFileReport regrid_by_ranks(const FileName& in, const FileName& target, const FileName& out,
                                 const RegridFileOptions& options, const RegridRanks& ranks,
                                 const Execution& execution) {
  const system::Call call(execution);
  require_effects(options, target, out);
  formats::require_file_of_fields(in, options.source.has_value());
  if (!options.statistics.empty()) {
    if (options.resume || ranks.size > 1) {
      throw InvalidInput("statistics are computed by one process, in one run that is not resumed");
    }
    if (options.extrapolation) {
      throw InvalidInput("statistics are of the values in a target: they are not extrapolated");
    }
    inputs_of(in, target, options).require_other(out);
    return formats::write_zonal_statistics(in, target, out, options, execution);
  }
  return RegridJob(in, target, out, options, ranks, execution).run();
}

}  // namespace formats

}  // namespace rondel
