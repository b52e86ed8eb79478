// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "formats/regrid_fields.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <system_error>
#include <utility>

#include "formats/field_cells.h"
#include "formats/grid_of_file.h"
#include "formats/regrid_plan.h"
#include "formats/weight_formats.h"
#include "io/bad_value.h"
#include "io/file_bytes.h"
#include "io/netcdf_reader.h"
#include "rondel/conventions.h"
#include "rondel/error.h"
#include "rondel/named_grids.h"

namespace rondel::formats {
namespace {

void add_history(const std::string& line, FieldSet& fields) {
  if (line.empty()) return;
  for (auto& [name, text] : fields.attributes) {
    if (name != "history") continue;
    text.insert(0, text.empty() ? line : line + "\n");
    return;
  }
  fields.attributes.emplace_back("history", line);
}

// Throws FileError if a file has as many places as a side, and others.
void require_places_of(const FileName& in, const RegridSide& side) {
  io::FileBytes bytes(file_and_variable(in).first, true);
  io::in_file(bytes.name(), [&] {
    const io::NetcdfReader reader(bytes);
    const PlacesOfGrid grid{side.num_places(), side.axes(),
                            [&](std::size_t i) { return side.place(i); }};
    if (!may_be_at(reader, grid)) {
      throw io::BadValue("its longitudes and latitudes are not the places of " + side.name());
    }
    require_named_places(reader, grid);
  });
}

// True if a file of netCDF has numbers called "mask", which say nothing of its cells here.
bool has_mask_variable(const FileName& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file.path, error) || !is_netcdf_file(file)) return false;
  io::FileBytes bytes(file, true);
  return io::in_file(bytes.name(), [&] {
    const io::NetcdfReader reader(bytes);
    const io::VariableInFile* const mask = reader.find("mask");
    return mask != nullptr && mask->type != io::NetcdfType::text && !mask->shape.empty();
  });
}

}  // namespace

void require_file_of_fields(const FileName& in, bool has_source) {
  const FileName file = file_and_variable(in).first;
  std::error_code error;
  if (file.bytes != nullptr || !std::filesystem::exists(file.path, error)) return;
  if (is_netcdf_file(file)) return;
  const std::string format = format_of(file);
  if (format == "csv" || format == "tsv" || format == "npy") {
    if (has_source) return;
    throw FileError(file.path +
                    ": a table or array does not say which grid its values are on: --source names "
                    "it; rondel interpolate carries values at points");
  }
  throw FileError(file.path +
                  ": it is no netCDF, from which fields are read; GRIB has to be converted to it, "
                  "and rondel.regrid in Python takes Zarr that xarray opens");
}

bool has_flags(const FieldArray& array) {
  const auto is_text_of_flags = [](const auto& attribute) {
    return is_attribute_of_flags(attribute.first) && !attribute.second.empty();
  };
  return std::ranges::any_of(array.attributes, is_text_of_flags) ||
         std::ranges::any_of(array.numbers, is_attribute_of_flags, &NumericAttribute::name);
}

std::vector<std::string> wanted_variables(const FileName& in,
                                          const std::vector<std::string>& names) {
  const std::string variable = file_and_variable(in).second;
  return names.empty() && !variable.empty() ? std::vector{variable} : names;
}

// The places are compared while the file is opened; of very many only some are.
std::unique_ptr<FieldFile> open_fields(const FileName& in, const std::vector<std::string>& names,
                                       const RegridSide& side) {
  std::vector<LonLat> places;
  if (side.num_places() <= max_compared) {
    places = side.places();
  } else if (is_netcdf_file(file_and_variable(in).first)) {
    require_places_of(in, side);
  }
  const FieldExtras extras{.has_others = true, .has_positions = false};
  return std::make_unique<FieldFile>(file_and_variable(in).first, names, side.num_places(),
                                     ReadOptions{}, side.shape(), WantedPlaces{places}, extras);
}

FieldSet fields_at_targets(const FieldSet& in, std::vector<FieldArray>&& arrays,
                           const RegridSide& source, const RegridSide& target,
                           const std::string& history) {
  FieldSet fields;
  fields.num_points = target.num_places();
  fields.arrays = std::move(arrays);
  fields.axes = in.axes;
  fields.others = in.others;
  fields.unlimited = in.unlimited;
  fields.attributes = in.attributes;
  fields.numbers = in.numbers;
  fields.dimension = target.has_sites() ? "point" : "cell";
  target.add_mapping(fields);
  const auto tell = [&](const RegridSide& side, const char* name) {
    if (side.are_corners_made()) fields.attributes.emplace_back(name, made_corners_text);
  };
  tell(source, source_corners_name);
  tell(target, target_corners_name);
  add_history(history, fields);
  return fields;
}

void add_remarks(const std::string& file, const std::vector<std::string>& remarks,
                 std::vector<std::string>& all) {
  for (const std::string& remark : remarks) {
    std::string text = file;
    text += ": ";
    text += remark;
    if (std::ranges::count(all, text) == 0) all.push_back(text);
  }
}

std::vector<std::string> remarks_of(const RegridSide& source, const RegridSide& target,
                                    const std::string& file, const FieldSet& fields) {
  std::vector<std::string> all;
  for (const RegridSide* const side : {&source, &target}) {
    add_remarks(file_and_variable({side->name(), {}}).first.path, side->remarks(), all);
  }
  add_remarks(file, fields.remarks, all);
  for (const RegridSide* const side : {&source, &target}) {
    const FileName own = file_and_variable({side->name(), {}}).first;
    if (own.path == file || NamedGrid::is_name(side->name()) || !has_mask_variable(own)) continue;
    add_remarks(own.path, {"the variable \"mask\" masks nothing"}, all);
  }
  if (std::ranges::count(fields.arrays, "mask", &FieldArray::name) > 0) {
    add_remarks(file, {"the variable \"mask\" is a field as others, and masks nothing"}, all);
  }
  return all;
}

}  // namespace rondel::formats
