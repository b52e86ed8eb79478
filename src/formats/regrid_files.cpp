// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Regrids the fields of a file: reads them slice by slice, applies weights, and writes them. Weights
// are computed once for each method and kept; where they would not fit into memory, conservative
// ones are computed tile by tile.
#include "rondel/regrid_files.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <utility>

#include "formats/regrid_side.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/fields.h"
#include "rondel/interpolate.h"
#include "rondel/names.h"
#include "rondel/regrid.h"
#include "rondel/tiled_remap.h"
#include "system/job.h"
#include "system/message_text.h"
#include "system/parallel.h"

namespace rondel {
namespace {

using formats::RegridSide;

// A slice of fields has 32 MiB; larger ones are not faster.
constexpr std::size_t values_per_slice = std::size_t{1} << 22U;
// What remap() needs for each cell of both sides, about.
constexpr std::uint64_t bytes_per_cell = 250;
// Places that are compared with those of the fields' file; more are known by their number alone.
constexpr std::size_t max_compared = std::size_t{1} << 24U;
constexpr double missing = std::numeric_limits<double>::quiet_NaN();

bool is_conservative(FieldMethod method) {
  return method == FieldMethod::conservative || method == FieldMethod::conservative_2nd ||
         method == FieldMethod::largest_share;
}

class RegridJob {
 public:
  RegridJob(const FileName& in, const FileName& target, FileName out,
            const RegridFileOptions& options, const Execution& execution)
      : options_(options),
        execution_(execution),
        needs_cells_(!options.method || is_conservative(*options.method)),
        source_(options.source.value_or(file_and_variable(in).first), options.cells, needs_cells_,
                execution),
        target_(target, options.cells, needs_cells_, execution),
        out_(std::move(out)) {
    open(in);
  }

  RegridFileReport run() {
    report_.sources = source_.num_places();
    report_.targets = target_.num_places();
    const FieldSet& in = fields_->fields();
    FieldSet written;
    written.num_points = report_.targets;
    written.arrays = in.arrays;
    written.axes = in.axes;
    written.others = in.others;
    written.attributes = in.attributes;
    written.dimension = "cell";
    target_.add_mapping(written);
    add_history(written);
    const bool is_netcdf = is_netcdf_file(out_);
    const WeightSide side = target_.description(is_netcdf);
    FieldWriter writer(out_, written, side, options_.netcdf);
    const bool has_tiles = must_be_tiled();
    for (std::size_t a = 0; a < in.arrays.size(); ++a) {
      const FieldMethod method = method_of(in.arrays[a]);
      if (has_tiles && method == FieldMethod::conservative) {
        carry_by_tiles(a, writer);
      } else {
        carry(a, method, writer);
      }
      report_.fields += in.arrays[a].num_fields();
    }
    writer.finish();
    return std::move(report_);
  }

 private:
  void open(const FileName& in) {
    auto [file, variable] = file_and_variable(in);
    std::vector<std::string> names = options_.names;
    if (names.empty() && !variable.empty()) names.push_back(variable);
    const bool is_compared = source_.num_places() <= max_compared;
    if (is_compared) places_ = source_.places();
    fields_ = std::make_unique<FieldFile>(file, names, source_.num_places(), ReadOptions{},
                                          source_.shape(), WantedPlaces{places_},
                                          FieldExtras{.has_others = true, .has_positions = false});
    for (const auto& remarks : {source_.remarks(), target_.remarks(), fields_->fields().remarks}) {
      for (const std::string& remark : remarks) {
        if (std::ranges::count(report_.remarks, remark) == 0) report_.remarks.push_back(remark);
      }
    }
  }

  void add_history(FieldSet& written) const {
    if (options_.history.empty()) return;
    for (auto& [name, text] : written.attributes) {
      if (name != "history") continue;
      text.insert(0, options_.history + "\n");
      return;
    }
    written.attributes.emplace_back("history", options_.history);
  }

  [[nodiscard]] FieldMethod method_of(const FieldArray& array) const {
    if (options_.method) return *options_.method;
    const bool has_meanings = std::ranges::any_of(
        array.attributes, [](const auto& attribute) { return attribute.first == "flag_meanings"; });
    return has_meanings || !array.numbers.empty() ? FieldMethod::largest_share
                                                  : FieldMethod::conservative;
  }

  // True if the weights of all cells would take more memory than there is.
  [[nodiscard]] bool must_be_tiled() {
    if (!needs_cells_) return false;
    const std::uint64_t needed = bytes_per_cell * (source_.num_places() + target_.num_places());
    if (options_.cells_per_tile == 0 && needed <= options_.memory) return false;
    tiled_source_ = source_.tiled(execution_);
    tiled_target_ = target_.tiled(execution_);
    return tiled_source_ && tiled_target_;
  }

  // Returns the weights of a method; those of targets with too small a part that is covered are
  // removed.
  const Weights& weights_of(FieldMethod method) {
    if (method == FieldMethod::largest_share) method = FieldMethod::conservative;
    const auto known = weights_.find(method);
    if (known != weights_.end()) return known->second;
    Weights made = is_conservative(method) ? conservative_weights(method) : place_weights(method);
    return weights_.emplace(method, std::move(made)).first->second;
  }

  Weights conservative_weights(FieldMethod method) {
    RemapOptions options;
    options.order = method == FieldMethod::conservative_2nd ? 2 : 1;
    options.norm = options_.norm;
    options.overlap = options_.overlap;
    Remap made = remap(source_.cells(execution_), target_.cells(execution_), options, execution_);
    std::vector<std::int32_t> is_covered;
    for (const double fraction : made.target_fractions) {
      is_covered.push_back(is_enough(fraction) ? 1 : 0);
    }
    made.weights = with_rows(made.weights, is_covered);
    if (options.order != 2 || !options_.is_limited) return std::move(made.weights);
    second_ = std::move(made);
    return second_->weights;
  }
  [[nodiscard]] bool is_enough(double fraction) const {
    constexpr double rounding = 1e-9;
    return fraction > 0 && fraction >= 1 - options_.max_missing - rounding;
  }

  Weights place_weights(FieldMethod method) {
    const std::vector<LonLat> targets = target_.places();
    if (method == FieldMethod::bilinear) {
      if (source_.axes() == nullptr) {
        throw FileError(source_.name() +
                        ": the method bilinear needs a grid along axes of longitude and latitude; "
                        "linear takes any places");
      }
      const Weights weights =
          bilinear_weights(*source_.axes(), targets, rounding_of(*source_.axes()));
      return source_.mask().empty() ? weights : without_columns(weights, source_.mask());
    }
    std::vector<Index> numbers;
    std::vector<Point> sites;
    const std::vector<LonLat> places = source_.places();
    for (std::size_t i = 0; i < places.size(); ++i) {
      const bool is_masked = !source_.mask().empty() && source_.mask()[i] == 0;
      if (is_masked || std::isnan(places[i].lon_deg) || std::isnan(places[i].lat_deg)) continue;
      numbers.push_back(static_cast<Index>(i));
      sites.push_back(unit_vector(places[i]));
    }
    const Triangulation triangulation = delaunay(sites, {}, execution_);
    InterpolationOptions interpolation;
    interpolation.method = *from_name<Method>(name_of(method));
    interpolation.hashes = false;
    Weights weights =
        Interpolator(triangulation).weights(unit_vectors(targets), interpolation, execution_);
    for (Index& column : weights.columns) column = numbers[column];
    weights.num_columns = places.size();
    return weights;
  }

  // Carries the fields of an array, as many at a time as a slice has room for.
  void carry(std::size_t array, FieldMethod method, FieldWriter& writer) {
    const Weights& weights = weights_of(method);
    const std::size_t num_fields = fields_->fields().arrays[array].num_fields();
    const std::size_t largest = std::max({report_.sources, report_.targets, std::size_t{1}});
    const std::size_t of_slice = std::max<std::size_t>(values_per_slice / largest, 1);
    std::vector<double> values;
    std::vector<double> carried;
    for (std::size_t first = 0; first < num_fields; first += of_slice) {
      const std::size_t count = std::min(of_slice, num_fields - first);
      values.resize(count * report_.sources);
      carried.resize(count * report_.targets);
      fields_->read(array, first, values);
      const ApplyOptions rules{.fill = missing, .max_missing = options_.max_missing};
      if (method == FieldMethod::largest_share) {
        apply_largest_share(weights, values, carried, count, rules, execution_);
      } else if (second_ && method == FieldMethod::conservative_2nd) {
        apply_limited(*second_, values, carried, count, rules, execution_);
      } else {
        apply(weights, values, carried, count, rules, execution_);
      }
      write(carried, writer);
      system::announce(execution_, "regrid", first + count, num_fields);
    }
  }

  void write(std::span<const double> values, FieldWriter& writer) {
    report_.missing += static_cast<std::size_t>(
        std::ranges::count_if(values, [](double value) { return std::isnan(value); }));
    writer.write(values);
  }

  const TiledRemap& tiles() {
    if (tiles_) return *tiles_;
    TiledRemapOptions options;
    options.norm = options_.norm;
    options.source_mask = source_.mask();
    options.target_mask = target_.mask();
    if (options_.cells_per_tile > 0) options.cells_per_tile = options_.cells_per_tile;
    tiles_.emplace(*tiled_source_, *tiled_target_, std::move(options), execution_);
    report_.tiles = tiles_->num_tiles();
    return *tiles_;
  }

  // The values of one or several fields at the sources, as far as a tile needs them: read when they
  // are asked for if sources are between parallels, and otherwise once.
  class SourceValues {
   public:
    SourceValues(const FieldFile& fields, std::size_t array, std::size_t first, std::size_t count,
                 std::size_t num_sources, bool has_windows)
        : fields_(fields), array_(array), first_(first), num_sources_(num_sources) {
      if (has_windows) return;
      whole_.resize(count * num_sources);
      fields.read(array, first, whole_);
    }
    // Returns the values of a field at the sources from `begin` on.
    std::span<const double> of(std::size_t field, std::size_t begin, std::size_t count) {
      if (!whole_.empty()) {
        return std::span(whole_).subspan(field * num_sources_ + begin, count);
      }
      window_.resize(count);
      fields_.read_points(array_, first_ + field, begin, window_);
      return window_;
    }

   private:
    const FieldFile& fields_;
    std::size_t array_;
    std::size_t first_;
    std::size_t num_sources_;
    std::vector<double> whole_;
    std::vector<double> window_;
  };

  // Carries the fields of an array in groups: the weights of each tile are applied to all fields of
  // a group. Targets between parallels are written tile by tile if a field is too large.
  void carry_by_tiles(std::size_t array, FieldWriter& writer) {
    const TiledRemap& remap = tiles();
    const bool has_windows = tiled_source_->has_parallels();
    const std::size_t num_fields = fields_->fields().arrays[array].num_fields();
    const std::uint64_t of_field =
        sizeof(double) * (report_.targets + (has_windows ? 0 : report_.sources));
    const std::uint64_t room = options_.memory / 2;
    const bool is_streamed = tiled_target_->has_parallels() && of_field > room;
    const std::size_t of_group =
        is_streamed
            ? 1
            : std::clamp<std::uint64_t>(room / of_field, 1, std::max<std::size_t>(num_fields, 1));
    for (std::size_t first = 0; first < num_fields; first += of_group) {
      const std::size_t count = std::min(of_group, num_fields - first);
      SourceValues values(*fields_, array, first, count, report_.sources, has_windows);
      std::vector<double> carried(is_streamed ? 0 : count * report_.targets, missing);
      for_each_tile(remap, [&](const RemapTile& tile, std::size_t number) {
        for (std::size_t f = 0; f < count; ++f) {
          const std::vector<double> applied = applied_to(tile, values, f);
          if (is_streamed) {
            write(applied, writer);
          } else {
            for (std::size_t r = 0; r < applied.size(); ++r) {
              carried[f * report_.targets + tile.targets[r]] = applied[r];
            }
          }
        }
        system::announce(execution_, "regrid", first * remap.num_tiles() + count * (number + 1),
                         num_fields * remap.num_tiles());
      });
      if (!is_streamed) write(carried, writer);
    }
  }

  // Returns the values of one field at the targets of a tile.
  std::vector<double> applied_to(const RemapTile& tile, SourceValues& values, std::size_t field) {
    std::vector<double> applied(tile.targets.size());
    apply(tile.weights, values.of(field, tile.first_source, tile.weights.num_columns), applied, 1,
          {.fill = missing, .max_missing = options_.max_missing}, execution_);
    for (std::size_t r = 0; r < applied.size(); ++r) {
      if (!is_enough(tile.fractions[r])) applied[r] = missing;
    }
    return applied;
  }

  // Calls take(tile, number) for all tiles in turn; the threads compute several at a time.
  template <class Take>
  void for_each_tile(const TiledRemap& remap, const Take& take) {
    const std::size_t at_once = 2 * std::size_t{system::num_threads(execution_.threads)};
    std::vector<RemapTile> tiles(at_once);
    for (std::size_t first = 0; first < remap.num_tiles(); first += at_once) {
      const std::size_t count = std::min(at_once, remap.num_tiles() - first);
      system::parallel_for(execution_.threads, count, 1, [&](std::size_t k, std::size_t /*end*/) {
        tiles[k] = remap.tile(first + k, {.threads = 1});
      });
      for (std::size_t k = 0; k < count; ++k) {
        take(tiles[k], first + k);
        tiles[k] = {};
      }
    }
  }

  const RegridFileOptions& options_;
  const Execution& execution_;
  bool needs_cells_;
  RegridSide source_;
  RegridSide target_;
  FileName out_;
  std::vector<LonLat> places_;
  std::unique_ptr<FieldFile> fields_;
  std::map<FieldMethod, Weights> weights_;
  std::optional<Remap> second_;  // of order 2, if its values are limited
  std::optional<TiledCells> tiled_source_;
  std::optional<TiledCells> tiled_target_;
  std::optional<TiledRemap> tiles_;
  RegridFileReport report_;
};

}  // namespace

std::string_view name_of(FieldMethod method) noexcept {
  return system::name_in({"conservative", "conservative_2nd", "largest_share", "nearest", "linear",
                          "laplace", "sibson", "hermite", "cubic", "bilinear"},
                         method);
}

RegridFileReport regrid_file(const FileName& in, const FileName& target, const FileName& out,
                             const RegridFileOptions& options, const Execution& execution) {
  const system::Call call(execution);
  if (!(options.max_missing >= 0 && options.max_missing <= 1)) {
    throw InvalidInput("max_missing is " + system::shortest_text(options.max_missing) +
                       ", not in [0, 1]");
  }
  return RegridJob(in, target, out, options, execution).run();
}

}  // namespace rondel
