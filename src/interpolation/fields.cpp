// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// read_fields and write_fields: which format; tables and arrays.
#include "rondel/fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "interpolation/field_formats.h"
#include "interpolation/field_names.h"
#include "io/bad_value.h"
#include "io/binary.h"
#include "io/column_text.h"
#include "io/csv_columns.h"
#include "io/csv_records.h"
#include "io/ending.h"
#include "io/file_bytes.h"
#include "io/npy_header.h"
#include "io/number.h"
#include "rondel/error.h"
#include "system/arithmetic.h"

namespace rondel {
namespace interpolation {
namespace {

double value_of(std::string_view cell, const std::string& name) {
  const std::string_view text = io::trim(cell);
  const bool is_missing = text.empty() || text == "nan" || text == "NaN" || text == "NA";
  return is_missing ? std::numeric_limits<double>::quiet_NaN() : io::parse_number(cell, name);
}

FieldSet read_table(std::string_view bytes, char delimiter, const FieldsToRead& wanted) {
  if (wanted.names.empty()) throw io::BadValue("no column of the table is named (--value)");
  io::CsvRecords records(io::table_text(bytes),
                         wanted.options.delimiter == '\0' ? delimiter : wanted.options.delimiter);
  if (!records.next()) throw io::BadValue("the table has no header");
  FieldSet fields;
  const std::vector<std::string> header = io::column_names(records.fields());
  io::require_different_names(header);
  std::vector<std::size_t> columns;
  for (const std::string& name : wanted.names) {
    const auto at = io::find_column(header, name);
    if (!at) throw io::BadValue("no column " + io::in_quotes(name));
    columns.push_back(*at);
    FieldArray array;
    array.name = name;
    fields.arrays.push_back(std::move(array));
  }
  while (records.next()) {
    if (records.fields().size() != header.size()) {
      throw io::BadValue(std::to_string(records.fields().size()) + " fields where the header has " +
                             std::to_string(header.size()),
                         records.line());
    }
    io::at_line_of(records, [&] {
      for (std::size_t c = 0; c < columns.size(); ++c) {
        FieldArray& array = fields.arrays[c];
        array.values.push_back(value_of(records.fields()[columns[c]], array.name));
      }
    });
    ++fields.num_points;
  }
  if (wanted.num_points != 0 && fields.num_points != wanted.num_points) {
    throw io::BadValue(std::to_string(fields.num_points) + " rows for " +
                       std::to_string(wanted.num_points) + " points");
  }
  return fields;
}

// A name for each column: one that a column before has gets a number.
class ColumnNames {
 public:
  std::string unique(const std::string& name) {
    std::string text = name;
    for (std::size_t k = 2; !used_.insert(text).second; ++k) {
      text = name + "_" + std::to_string(k);
    }
    return text;
  }

 private:
  std::set<std::string> used_;
};

std::string header_of(const FieldsToWrite& job, char separator) {
  ColumnNames names;
  std::string text;
  const auto append = [&](const std::string& name) {
    if (!text.empty()) text += separator;
    io::append_csv_field(text, names.unique(name), separator);
  };
  if (!job.side.points.empty()) {
    append("lon");
    append("lat");
  }
  for (const Column& column : job.side.columns) append(column.name);
  for (const FieldArray& array : job.fields.arrays) {
    for (const std::string& name : names_of_fields(array, job.fields.axes)) append(name);
  }
  return text + '\n';
}

void write_table(io::AtomicFile& file, const FieldsToWrite& job, char separator) {
  const std::vector<LonLat>& points = job.side.points;
  std::string text = header_of(job, separator);
  const std::size_t n = job.fields.num_points;
  for (std::size_t i = 0; i < n; ++i) {
    bool is_first = true;
    const auto separate = [&] {
      if (!is_first) text += separator;
      is_first = false;
    };
    if (!points.empty()) {
      separate();
      io::append_number(text, points[i].lon_deg);
      separate();
      io::append_number(text, points[i].lat_deg);
    }
    for (const Column& column : job.side.columns) {
      separate();
      io::append_csv_field(text, io::cell_of(column, i), separator);
    }
    for (const FieldArray& array : job.fields.arrays) {
      for (std::size_t f = 0; f < array.num_fields(); ++f) {
        separate();
        const double value = array.values[f * n + i];
        if (!std::isnan(value)) io::append_number(text, value);
      }
    }
    text += '\n';
    file.write(text);
    text.clear();
  }
  file.write(text);
}

}  // namespace

FieldSet read_fields_csv(std::string_view bytes, const FieldsToRead& wanted) {
  return read_table(bytes, ',', wanted);
}
FieldSet read_fields_tsv(std::string_view bytes, const FieldsToRead& wanted) {
  return read_table(bytes, '\t', wanted);
}

FieldSet read_fields_npy(std::string_view bytes, const FieldsToRead& wanted) {
  if (!wanted.names.empty()) throw io::BadValue("fields are named, but .npy files have no names");
  const io::NpyHeader header = io::parse_npy_header(bytes);
  const bool is_double = header.dtype == "<f8" || header.dtype == ">f8";
  if (!is_double && header.dtype != "<f4" && header.dtype != ">f4") {
    throw io::BadValue("dtype " + io::in_quotes(header.dtype) + " where f8 or f4 is needed");
  }
  const std::size_t rank = header.shape.size();
  const std::size_t item = is_double ? 8 : 4;
  const std::uint64_t n = rank == 0 ? 0 : header.shape.back();
  const std::uint64_t count = rank == 2 ? header.shape[0] : 1;
  std::uint64_t size = 0;
  if (rank < 1 || rank > 2 || (wanted.num_points != 0 && n != wanted.num_points) ||
      (rank == 2 && header.is_fortran_order) || __builtin_mul_overflow(n, count, &size) ||
      __builtin_mul_overflow(size, std::uint64_t{item}, &size) ||
      size != bytes.size() - header.data_offset) {
    throw io::BadValue("shape " + io::shape_text(header.shape) +
                       " where (n,) or (fields, n) in C "
                       "order is needed, n being " +
                       std::to_string(wanted.num_points));
  }
  FieldSet fields;
  fields.num_points = n;
  FieldArray array;
  array.name = "value";
  if (rank == 2) {
    array.dimensions = {"field"};
    array.shape = {count};
  }
  const std::endian order = header.dtype[0] == '>' ? std::endian::big : std::endian::little;
  array.values.resize(size / item);
  const char* data = bytes.data() + header.data_offset;
  for (std::size_t i = 0; i < array.values.size(); ++i) {
    array.values[i] = is_double ? io::load<double>(data + i * item, order)
                                : double{io::load<float>(data + i * item, order)};
  }
  fields.arrays.push_back(std::move(array));
  return fields;
}

void write_fields_csv(io::AtomicFile& file, const FieldsToWrite& job) {
  write_table(file, job, ',');
}
void write_fields_tsv(io::AtomicFile& file, const FieldsToWrite& job) {
  write_table(file, job, '\t');
}

// (n,) of one field, (fields, n) of more, the arrays one after the other.
void write_fields_npy(io::AtomicFile& file, const FieldsToWrite& job) {
  std::uint64_t count = 0;
  for (const FieldArray& array : job.fields.arrays) count += array.num_fields();
  const std::uint64_t n = job.fields.num_points;
  const bool is_one = job.fields.arrays.size() == 1 && job.fields.arrays[0].shape.empty();
  file.write(io::make_npy_header(
      "<f8", is_one ? std::vector<std::uint64_t>{n} : std::vector<std::uint64_t>{count, n}));
  for (const FieldArray& array : job.fields.arrays) file.write(io::NumberBytes(array.values));
}

}  // namespace interpolation

namespace {

struct FieldReader {
  std::string_view ending;
  FieldSet (*read)(std::string_view, const interpolation::FieldsToRead&);
};
constexpr std::array<FieldReader, 4> field_readers = {
    {{".csv", &interpolation::read_fields_csv},
     {".tsv", &interpolation::read_fields_tsv},
     {".npy", &interpolation::read_fields_npy},
     {".nc", &interpolation::read_fields_netcdf}}};
using FieldWriter = io::Writer<interpolation::FieldsToWrite>;
constexpr std::array<FieldWriter, 4> field_writers = {
    {{".csv", &interpolation::write_fields_csv},
     {".tsv", &interpolation::write_fields_tsv},
     {".npy", &interpolation::write_fields_npy},
     {".nc", &interpolation::write_fields_netcdf}}};

}  // namespace

std::size_t FieldArray::num_fields() const {
  std::size_t product = 1;
  for (const std::uint64_t length : shape) product *= length;
  return product;
}

FieldSet read_fields(const FileName& file, std::span<const std::string> names,
                     std::uint64_t num_points, const ReadOptions& options,
                     std::span<const std::uint64_t> shape) {
  const FieldReader& reader =
      io::require_format<FieldReader>(field_readers, file, "fields are read from");
  io::FileBytes bytes(file.path);
  return io::in_file(bytes.name(), [&] {
    return reader.read(bytes.text(), {names, num_points, options, shape});
  });
}

bool can_write_fields(const FileName& file) {
  return io::find_format<FieldWriter>(field_writers, file) != nullptr;
}

void write_fields(const FileName& file, const FieldSet& fields, const WeightSide& points) {
  for (const FieldArray& array : fields.arrays) {
    if (array.values.size() == array.num_fields() * fields.num_points) continue;
    throw InvalidInput("array '" + array.name + "' has " + std::to_string(array.values.size()) +
                       " values");
  }
  for (const Column& column : points.columns) {
    if (column.ends.size() == fields.num_points) continue;
    throw InvalidInput("column '" + column.name + "' has " + std::to_string(column.ends.size()) +
                       " cells for values at " + std::to_string(fields.num_points));
  }
  if (!points.points.empty() && points.points.size() != fields.num_points) {
    throw InvalidInput(std::to_string(points.points.size()) + " points for values at " +
                       std::to_string(fields.num_points));
  }
  io::write_whole<interpolation::FieldsToWrite>(field_writers, file, "fields are written as",
                                                {fields, points});
}

}  // namespace rondel
