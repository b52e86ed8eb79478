// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Implements write_weights() and read_weights(), which pick the format (weight_formats.h) and check
// that the sizes of the content agree. A file that is read is recognized by its first bytes; of the
// netCDF formats its variables say which one it is.
#include "rondel/weight_files.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/weight_formats.h"
#include "io/bad_value.h"
#include "io/ending.h"
#include "io/file_bytes.h"
#include "rondel/error.h"
#include "rondel/remap.h"
#include "system/checked_product.h"
#include "system/job.h"

namespace rondel {
namespace {

using WeightWriter = io::Writer<formats::WeightsToWrite>;
constexpr std::array<WeightWriter, 5> weight_writers = {{{".nc", &formats::write_esmf},
                                                         {".nc4", &formats::write_esmf},
                                                         {".npz", &formats::write_weights_npz},
                                                         {".esmf", &formats::write_esmf},
                                                         {".scrip", &formats::write_scrip}}};

// The variables of a netCDF file tell which of the netCDF formats it has.
constexpr std::array<std::string_view, 7> weight_endings = {".nc",  ".nc4",  ".cdf",  ".ncf",
                                                            ".npz", ".esmf", ".scrip"};

// Throws InvalidInput if an array has elements, and not as many as wanted.
void require_number(const char* what, std::size_t length, std::size_t wanted) {
  if (length == 0 || length == wanted) return;
  throw InvalidInput(std::string(what) + " are " + std::to_string(length) + " instead of " +
                     std::to_string(wanted));
}

// Throws InvalidInput if an array of a side is not of `size` points.
void require_side(const WeightSide& side, std::size_t size) {
  require_number("points", side.points.size(), size);
  require_number("areas", side.areas.size(), size);
  require_number("fractions", side.fractions.size(), size);
  require_number("the mask's numbers", side.mask.size(), size);
  for (const Column& column : side.columns) {
    require_number("the cells of a column", column.ends.size(), size);
  }
  const bool has_cells = size > 0 && side.corners.size() % size == 0;
  if (!side.corners.empty() && !has_cells) {
    throw InvalidInput(std::to_string(side.corners.size()) + " corners of " + std::to_string(size) +
                       " cells");
  }
  if (side.shape.empty()) return;
  std::uint64_t product = 1;
  for (const std::uint64_t length : side.shape) {
    if (!system::multiply_checked(product, length, product)) product = 0;
  }
  // A product of 0, also in place of an overflow, must not pass for a shape that is not known.
  require_number("the points of the shape", product == 0 ? ~std::size_t{0} : product, size);
}

// Throws InvalidInput if parts of the content do not fit together. apply() with no field only
// checks the weights.
void require_content(const WeightFile& content) {
  apply(content.weights, {}, {}, 0);
  require_side(content.source, content.weights.num_columns);
  require_side(content.target, content.weights.num_rows());
}

}  // namespace

void write_weights(const FileName& file, const WeightFile& content, const NetcdfOptions& netcdf) {
  const system::ArithmeticScope arithmetic;
  require_content(content);
  io::in_file(file.path, [&] {
    io::write_whole<formats::WeightsToWrite>(weight_writers, file, "weights are written as",
                                             {content, io::with_kind(netcdf, file)});
  });
}

WeightFile read_weights(const FileName& file, const WeightReadOptions& options) {
  const system::ArithmeticScope arithmetic;
  const std::string ending = io::ending(file);
  const bool is_known = std::ranges::find(weight_endings, ending) != weight_endings.end();
  if (!is_known && !file.format.empty()) {
    io::throw_unknown_ending(file, "weights are read from", weight_endings);
  }
  io::FileBytes bytes(file, true);
  return io::in_file(bytes.name(), [&] {
    const bool is_netcdf = io::is_netcdf(bytes.head());
    if (is_netcdf && file.format.empty()) {
      return formats::read_weights_netcdf(io::NetcdfReader(bytes), {}, options);
    }
    if (!is_known) io::throw_unknown_ending(file, "weights are read from", weight_endings);
    if (ending == ".npz" && is_netcdf) throw io::BadValue("the file is netCDF, not npz");
    if (ending == ".npz") return formats::read_weights_npz(bytes.text());
    // Where the file is no netCDF, this throws with the reason.
    return formats::read_weights_netcdf(io::NetcdfReader(bytes), format_of({"", file.format}),
                                        options);
  });
}

void write_weights(const FileName& file, const Remap& remap, const NetcdfOptions& netcdf) {
  write_weights(file, weight_file(remap), netcdf);
}

}  // namespace rondel
