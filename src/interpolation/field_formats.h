// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The formats of fields, one function each way.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "interpolation/field_layout.h"
#include "io/atomic_file.h"
#include "io/cf_values.h"
#include "io/netcdf_reader.h"
#include "rondel/fields.h"

namespace rondel::interpolation {

struct FieldsToRead {
  std::span<const std::string> names;
  std::uint64_t num_points;
  const ReadOptions& options;
  std::span<const std::uint64_t> shape;  // of the points' grid; empty: not known
};
// Each reads the content of a file. Throws BadValue.
FieldSet read_fields_csv(std::string_view bytes, const FieldsToRead& wanted);
FieldSet read_fields_tsv(std::string_view bytes, const FieldsToRead& wanted);
FieldSet read_fields_npy(std::string_view bytes, const FieldsToRead& wanted);

// The fields of a netCDF file, which lives as long as this.
class FieldSlices {
 public:
  // Throws BadValue.
  FieldSlices(const io::NetcdfReader& file, const FieldsToRead& wanted);

  // With the values of the axes alone.
  [[nodiscard]] const FieldSet& fields() const { return fields_; }
  // As FieldFile::read().
  void read(std::size_t array, std::size_t first, std::span<double> out) const;

 private:
  struct SlicedVariable {
    const io::NetcdfReader::Variable* variable;
    FieldDimensions layout;
    io::ValueRules rules;
  };

  bool add(const io::NetcdfReader::Variable& variable);
  void add_all();
  void add_axes();
  void read_block(const SlicedVariable& source, std::uint64_t block, std::uint64_t size) const;

  const io::NetcdfReader& file_;
  FieldDimensionFinder layouts_;
  FieldSet fields_;
  std::vector<SlicedVariable> sources_;  // of the arrays
  // The last block of values that was read and brought into order.
  mutable std::vector<double> block_;
  mutable const SlicedVariable* source_of_block_ = nullptr;
  mutable std::uint64_t number_of_block_ = 0;
};

struct FieldsToWrite {
  const FieldSet& fields;  // the arrays without values
  const WeightSide& side;
  NetcdfOptions netcdf;
};

// What writes the values that FieldWriter is given.
class FieldSink {
 public:
  FieldSink() = default;
  virtual ~FieldSink() = default;
  FieldSink(const FieldSink&) = delete;
  FieldSink& operator=(const FieldSink&) = delete;
  virtual void write(std::span<const double> values) = 0;
  virtual void finish() = 0;
};
// Each begins a file. What is to be written lives until finish().
std::unique_ptr<FieldSink> begin_fields_csv(io::AtomicFile& file, const FieldsToWrite& job);
std::unique_ptr<FieldSink> begin_fields_tsv(io::AtomicFile& file, const FieldsToWrite& job);
std::unique_ptr<FieldSink> begin_fields_npy(io::AtomicFile& file, const FieldsToWrite& job);
std::unique_ptr<FieldSink> begin_fields_netcdf(io::AtomicFile& file, const FieldsToWrite& job);

}  // namespace rondel::interpolation
