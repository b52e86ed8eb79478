// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Readers and writers of fields: one function for each format and direction.
//
// in    the bytes of a file and which fields are wanted; or a FieldSet without values, and the
//       values one field after the other
// out   a FieldSet; or a file
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/atomic_file.h"
#include "rondel/fields.h"

namespace rondel::formats {

// A reader is asked for the fields of these names, or for all. With num_points = 0 they are at as
// many points as the file has.
struct FieldsToRead {
  std::span<const std::string> names;
  std::uint64_t num_points;
  const ReadOptions& options;
  std::span<const std::uint64_t> shape;  // of the points' grid; empty: not known
  WantedPlaces places = {};
  FieldExtras extras = {};
};
// Each of these reads the content of a file. They throw BadValue if it is not as the format says.
// They return the fields with values; `wanted.names` are columns of tables, and .npy has no names.
FieldSet read_fields_csv(std::string_view bytes, const FieldsToRead& wanted);
FieldSet read_fields_tsv(std::string_view bytes, const FieldsToRead& wanted);
FieldSet read_fields_npy(std::string_view bytes, const FieldsToRead& wanted);

// A writer gets the fields and the points that they are at before it gets any values.
struct FieldsToWrite {
  const FieldSet& fields;  // names, dimensions and attributes of the fields, without values
  const WeightSide& side;
  NetcdfOptions netcdf;
  unsigned threads = 1;  // that compress
};

// Receives the values that FieldWriter is given, in the order of the fields, and writes them.
class FieldSink {
 public:
  FieldSink() = default;
  virtual ~FieldSink() = default;
  FieldSink(const FieldSink&) = delete;
  FieldSink& operator=(const FieldSink&) = delete;
  // Takes the next values; those of a field come after those of the field before it.
  virtual void write(std::span<const double> values) = 0;
  // Completes the file after the last value.
  virtual void finish() = 0;
  // Returns sentences about what the file does not have, though the fields do.
  [[nodiscard]] virtual std::vector<std::string> remarks() const { return {}; }
};
// Each of these begins a file. `job` refers to objects that must live until finish().
std::unique_ptr<FieldSink> begin_fields_csv(io::AtomicFile& file, const FieldsToWrite& job);
std::unique_ptr<FieldSink> begin_fields_tsv(io::AtomicFile& file, const FieldsToWrite& job);
std::unique_ptr<FieldSink> begin_fields_npy(io::AtomicFile& file, const FieldsToWrite& job);
std::unique_ptr<FieldSink> begin_fields_netcdf(io::AtomicFile& file, const FieldsToWrite& job);

}  // namespace rondel::formats
