// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The fields of a netCDF file, read slice by slice in memory that does not grow with the file.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "interpolation/field_blocks.h"
#include "interpolation/field_formats.h"
#include "interpolation/field_layout.h"
#include "io/cf_values.h"
#include "io/netcdf_reader.h"
#include "rondel/fields.h"

namespace rondel::interpolation {

// The fields of a netCDF file, which lives as long as this.
class FieldSlices {
 public:
  // Throws BadValue.
  FieldSlices(const io::NetcdfReader& file, const FieldsToRead& wanted,
              std::size_t most_of_block = usual_block);

  // Only axes have their values here; read() reads those of the fields.
  [[nodiscard]] const FieldSet& fields() const { return fields_; }
  // As FieldFile::read().
  void read(std::size_t array, std::size_t first, std::span<double> out) const;

 private:
  struct SlicedVariable {
    const io::NetcdfReader::Variable* variable;
    std::size_t num_points;  // with those that are left out
    FieldDimensions layout;
    FieldBlocks blocks;
    io::ValueRules rules;
    std::size_t first;  // field: the only one, where one of several is chosen
  };

  // False if the variable is no field at the points.
  bool add(const io::NetcdfReader::Variable& variable);
  bool add_one_of_several(const std::string& name);
  void add_with_layout(const io::NetcdfReader::Variable& variable, FieldDimensions layout);
  void add_all();
  void add_axes(const io::NetcdfReader::Variable& variable, const FieldDimensions& layout,
                std::vector<FieldArray>& axes);
  void read_all_points(const SlicedVariable& source, std::size_t first,
                       std::span<double> out) const;
  void read_block(const SlicedVariable& source, const FieldBlock& block,
                  std::span<double> out) const;
  static void mean(const SlicedVariable& source, std::span<double> values);
  void keep_block(const SlicedVariable& source, const FieldBlock& block) const;

  const io::NetcdfReader& file_;
  std::size_t most_of_block_;
  FieldDimensionFinder layouts_;
  FieldSet fields_;
  std::vector<SlicedVariable> sources_;  // of the arrays
  // The last block of which a part was wanted.
  mutable std::vector<double> block_;
  mutable const SlicedVariable* source_of_block_ = nullptr;
  mutable std::size_t first_of_block_ = 0;
};

}  // namespace rondel::interpolation
