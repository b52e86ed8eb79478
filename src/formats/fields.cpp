// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads and writes fields as tables (CSV, TSV) and as arrays of NumPy (.npy). In a table a row is a
// point and a column a field; an array has the shape (n,) or (fields, n). Missing values are empty
// cells in tables and NaN in arrays; infinite values in a file that is read are errors.
#include "rondel/fields.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>

#include "formats/field_columns.h"
#include "formats/field_formats.h"
#include "formats/field_names.h"
#include "io/bad_value.h"
#include "io/binary.h"
#include "io/column_text.h"
#include "io/csv_columns.h"
#include "io/csv_records.h"
#include "io/npy_header.h"
#include "io/number.h"
#include "system/checked_product.h"

namespace rondel::formats {
namespace {

// Names the line of a table with one column that is empty, since an empty value looks like a
// missing row there. `records` are at their end.
std::string text_of_empty_line(std::vector<std::uint64_t> lines, const io::CsvRecords& records) {
  lines.push_back(records.line());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::uint64_t next = i == 0 ? 2 : lines[i - 1] + 1;
    if (lines[i] > next) {
      return "; line " + std::to_string(next) +
             R"( is empty, which is no row: "" is a missing value)";
    }
  }
  return {};
}

// Reads the columns that `wanted` names from a table with a header; each row is a point. Throws
// BadValue for a missing column, a row of another length, or another number of rows than points.
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
        array.values.push_back(number_in_cell(records.fields()[columns[c]], array.name));
      }
    });
    fields.lines.push_back(records.line());
    ++fields.num_points;
  }
  if (wanted.num_points != 0 && fields.num_points != wanted.num_points) {
    throw io::BadValue(std::to_string(fields.num_points) + " rows for " +
                       std::to_string(wanted.num_points) + " points" +
                       (header.size() == 1 ? text_of_empty_line(fields.lines, records) : ""));
  }
  return fields;
}

// Returns the header: places, properties and fields. A property that has the name of a field gives
// way to it.
std::string header_line(const FieldsToWrite& job, char separator) {
  std::vector<std::string> names;
  if (!job.side.points.empty() || job.fields.num_points == 0) {  // the columns of no rows, too
    names = {"lon", "lat"};
  }
  // Names of fields are made free first, so that properties get the underscores; then they change
  // places, since properties stand before fields.
  const auto num_coordinates = static_cast<std::ptrdiff_t>(names.size());
  for (const FieldArray& array : job.fields.arrays) {
    for (const std::string& name : names_of_fields(array, job.fields.axes)) names.push_back(name);
  }
  const auto num_others = static_cast<std::ptrdiff_t>(names.size());
  for (const Column& column : job.side.columns) names.push_back(column.name);
  // The reader of tables must know the places from them.
  if (num_coordinates > 0) {
    io::distinguish_from_coordinates(std::span(names).subspan(2));
  }
  names = free_names(std::move(names));
  std::rotate(names.begin() + num_coordinates, names.begin() + num_others, names.end());
  std::string text;
  for (const std::string& name : names) {
    if (!text.empty()) text += separator;
    io::append_csv_field(text, name, separator);
  }
  return text + '\n';
}

// Keeps the table until it is complete, because a row has the values of all fields at one point.
class TableSink : public FieldSink {
 public:
  // Begins a table; `separator` is a comma or a tab.
  TableSink(io::AtomicFile& file, const FieldsToWrite& job, char separator)
      : file_(file), job_(job), separator_(separator) {}

  // Keeps the values; those of each field follow each other.
  void write(std::span<const double> values) override {
    values_.insert(values_.end(), values.begin(), values.end());
  }
  // Writes the table row by row: place, properties, then the value of each field.
  void finish() override {
    const std::vector<LonLat>& points = job_.side.points;
    const std::size_t n = job_.fields.num_points;
    std::string text = header_line(job_, separator_);
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t begin = text.size();
      bool is_first = true;
      const auto separate = [&] {
        if (!is_first) text += separator_;
        is_first = false;
      };
      if (!points.empty()) {
        separate();
        if (!std::isnan(points[i].lon_deg)) io::append_number(text, points[i].lon_deg);
        separate();
        if (!std::isnan(points[i].lat_deg)) io::append_number(text, points[i].lat_deg);
      }
      for (const Column& column : job_.side.columns) {
        separate();
        io::append_csv_field(text, column.cell(i), separator_);
      }
      for (std::size_t at = i; at < values_.size(); at += n) {
        separate();
        if (!std::isnan(values_[at])) io::append_number(text, values_[at]);
      }
      // A line that consists of one empty field would be an empty line, which readers skip.
      if (text.size() == begin) text += "\"\"";
      text += '\n';
      file_.write(text);
      text.clear();
    }
    file_.write(text);
  }

 private:
  io::AtomicFile& file_;
  FieldsToWrite job_;
  char separator_;
  std::vector<double> values_;
};

// Writes the shape (n,) for one field and (fields, n) for several, the arrays one after the other.
class NpySink : public FieldSink {
 public:
  // Writes the header of the array.
  NpySink(io::AtomicFile& file, const FieldSet& fields) : file_(file) {
    std::uint64_t count = 0;
    for (const FieldArray& array : fields.arrays) count += array.num_fields();
    const std::uint64_t n = fields.num_points;
    const bool is_one = fields.arrays.size() == 1 && fields.arrays[0].shape.empty();
    file.write(io::make_npy_header(
        "<f8", is_one ? std::vector<std::uint64_t>{n} : std::vector<std::uint64_t>{count, n}));
  }
  // Writes the values at once, as their order is that of the array.
  void write(std::span<const double> values) override { file_.write(io::NumberBytes(values)); }
  void finish() override {}

 private:
  io::AtomicFile& file_;
};

// Returns a number of a type of NumPy as a double. Integers that are no doubles are refused.
template <typename Number>
double loaded(const char* data, std::endian order) {
  const auto number = io::load<Number>(data, order);
  return io::exact_double(number);
}

// A type of NumPy without its byte order, its size in bytes and the function that reads it.
struct NpyNumbers {
  std::string_view type;
  std::size_t size;
  double (*load)(const char*, std::endian);
};
constexpr NpyNumbers npy_numbers[] = {
    {"f8", 8, &loaded<double>},        {"f4", 4, &loaded<float>},
    {"b1", 1, &loaded<std::uint8_t>},  {"i1", 1, &loaded<std::int8_t>},
    {"i2", 2, &loaded<std::int16_t>},  {"i4", 4, &loaded<std::int32_t>},
    {"i8", 8, &loaded<std::int64_t>},  {"u1", 1, &loaded<std::uint8_t>},
    {"u2", 2, &loaded<std::uint16_t>}, {"u4", 4, &loaded<std::uint32_t>},
    {"u8", 8, &loaded<std::uint64_t>}};

// Returns the type that a dtype such as "<f8" names. Throws BadValue for types that are no numbers.
const NpyNumbers& type_of_npy(const std::string& dtype) {
  const std::string_view type =
      std::string_view(dtype).substr(std::min<std::size_t>(1, dtype.size()));
  const auto* const found = std::ranges::find(npy_numbers, type, &NpyNumbers::type);
  const bool has_order = dtype.starts_with('<') || dtype.starts_with('>') || dtype.starts_with('|');
  if (found != std::end(npy_numbers) && has_order) return *found;
  throw io::BadValue("dtype " + io::in_quotes(dtype) +
                     " where float64, float32, an integer or bool is needed");
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
  const NpyNumbers& type = type_of_npy(header.dtype);
  const std::size_t rank = header.shape.size();
  const std::size_t item = type.size;
  // The last dimension counts points, the one before it fields.
  const std::uint64_t n = rank == 0 ? 0 : header.shape.back();
  const std::uint64_t count = rank == 2 ? header.shape[0] : 1;
  std::uint64_t size = 0;
  if (rank < 1 || rank > 2 || (wanted.num_points != 0 && n != wanted.num_points) ||
      (rank == 2 && header.is_fortran_order) || !system::multiply_checked(n, count, size) ||
      !system::multiply_checked(size, item, size)) {
    throw io::BadValue("shape " + io::shape_text(header.shape) +
                       " where (n,) or (fields, n) in C "
                       "order is needed, n being " +
                       std::to_string(wanted.num_points));
  }
  if (const std::size_t found = bytes.size() - header.data_offset; found != size) {
    throw io::BadValue("shape " + io::shape_text(header.shape) + ": " + std::to_string(n * count) +
                       " numbers of " + std::to_string(item) + " bytes are needed, there are " +
                       std::to_string(found) + " bytes");
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
    array.values[i] = type.load(data + i * item, order);
    if (!std::isinf(array.values[i])) continue;
    throw io::BadValue((rank == 2 ? "field " + std::to_string(i / n) + ": " : "") + "value " +
                       (array.values[i] > 0 ? "inf" : "-inf") + " at point " +
                       std::to_string(i % n) + " is not finite");
  }
  fields.arrays.push_back(std::move(array));
  return fields;
}

std::unique_ptr<FieldSink> begin_fields_csv(io::AtomicFile& file, const FieldsToWrite& job) {
  return std::make_unique<TableSink>(file, job, ',');
}
std::unique_ptr<FieldSink> begin_fields_tsv(io::AtomicFile& file, const FieldsToWrite& job) {
  return std::make_unique<TableSink>(file, job, '\t');
}
std::unique_ptr<FieldSink> begin_fields_npy(io::AtomicFile& file, const FieldsToWrite& job) {
  return std::make_unique<NpySink>(file, job.fields);
}

}  // namespace rondel::formats
