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

#include "io/atomic_file.h"
#include "rondel/fields.h"

namespace rondel::interpolation {

struct FieldsToRead {
  std::span<const std::string> names;
  std::uint64_t num_points;
  const ReadOptions& options;
  std::span<const std::uint64_t> shape;  // of the points' grid; empty: not known
  WantedPlaces places = {};
};
// Each reads the content of a file. Throws BadValue.
FieldSet read_fields_csv(std::string_view bytes, const FieldsToRead& wanted);
FieldSet read_fields_tsv(std::string_view bytes, const FieldsToRead& wanted);
FieldSet read_fields_npy(std::string_view bytes, const FieldsToRead& wanted);

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
