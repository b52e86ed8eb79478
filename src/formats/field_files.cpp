// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads and writes fields as files, whole and in slices, and picks the format: FieldFile,
// read_fields(), FieldWriter and write_fields().
//
// A netCDF file is read in slices (field_slices.h); tables and .npy files are read at once and
// their values kept. A file that is written appears whole or not at all, when finish() commits it.
#include <algorithm>
#include <array>
#include <optional>

#include "formats/field_formats.h"
#include "formats/field_slices.h"
#include "io/bad_value.h"
#include "io/ending.h"
#include "io/file_bytes.h"
#include "io/number.h"
#include "rondel/conventions.h"
#include "rondel/error.h"
#include "rondel/fields.h"

namespace rondel {
namespace {

// A format that is read, by the ending of its files.
struct FieldReader {
  std::string_view ending;
  // A null pointer stands for netCDF, which is read in slices.
  FieldSet (*read)(std::string_view, const formats::FieldsToRead&);
};
constexpr FieldReader field_readers[] = {{".csv", &formats::read_fields_csv},
                                         {".tsv", &formats::read_fields_tsv},
                                         {".npy", &formats::read_fields_npy},
                                         {".nc", nullptr},
                                         {".nc4", nullptr},
                                         {".cdf", nullptr},
                                         {".ncf", nullptr}};

// A format that is written, by the ending of its files.
struct FieldBeginning {
  std::string_view ending;
  std::unique_ptr<formats::FieldSink> (*begin)(io::AtomicFile&, const formats::FieldsToWrite&);
};
constexpr FieldBeginning field_writers[] = {{".csv", &formats::begin_fields_csv},
                                            {".tsv", &formats::begin_fields_tsv},
                                            {".npy", &formats::begin_fields_npy},
                                            {".nc", &formats::begin_fields_netcdf},
                                            {".nc4", &formats::begin_fields_netcdf}};

// True if a file is read as netCDF: by its first bytes unless the user names a format, or else by
// its ending.
bool is_netcdf_file(const FileName& file, const io::FileBytes& bytes) {
  if (file.format.empty() && io::is_netcdf(bytes.head())) return true;
  const FieldReader* const reader = io::find_format<FieldReader>(field_readers, file);
  return reader != nullptr && reader->read == nullptr;
}

}  // namespace

std::size_t FieldArray::num_fields() const {
  std::size_t product = 1;
  for (const std::uint64_t length : shape) product *= length;
  return product;
}

std::string FieldArray::lengths_in_words() const {
  std::string text;
  for (std::size_t d = 0; d < dimensions.size(); ++d) {
    text += (d == 0 ? "" : ", ") + dimensions[d] + " " + std::to_string(shape[d]);
  }
  return text;
}

void remove_flags(FieldArray& array) {
  std::erase_if(array.numbers, [](const auto& a) { return is_attribute_of_flags(a.name); });
  std::erase_if(array.attributes, [](const auto& a) { return is_attribute_of_flags(a.first); });
}

// A file that is open, with its fields.
struct FieldFile::OpenFields {
  explicit OpenFields(const FileName& file) : bytes(file) {}

  io::FileBytes bytes;
  std::optional<io::NetcdfReader> netcdf;
  // The fields of netCDF; for other formats `fields` and the values are read at once.
  std::optional<formats::FieldSlices> slices;
  FieldSet fields;                          // without values
  std::vector<std::vector<double>> values;  // by array
};

FieldFile::FieldFile(const FileName& file, std::span<const std::string> names,
                     std::uint64_t num_points, const ReadOptions& options,
                     std::span<const std::uint64_t> shape, const WantedPlaces& places,
                     const FieldExtras& extras)
    : content_(std::make_unique<OpenFields>(file)) {
  OpenFields& content = *content_;
  for (std::size_t k = 1; k < names.size(); ++k) {
    if (std::ranges::count(names.first(k), names[k]) == 0) continue;
    throw FileError(content.bytes.name() + ": " + io::in_quotes(names[k]) + " is named twice");
  }
  const formats::FieldsToRead wanted{names, num_points, options, shape, places, extras};
  if (is_netcdf_file(file, content.bytes)) {
    io::in_file(content.bytes.name(), [&] {
      content.netcdf.emplace(content.bytes);
      content.slices.emplace(*content.netcdf, wanted);
    });
    return;
  }
  const FieldReader& reader =
      io::require_format<FieldReader>(field_readers, file, "fields are read from");
  content.fields =
      io::in_file(content.bytes.name(), [&] { return reader.read(content.bytes.text(), wanted); });
  for (FieldArray& array : content.fields.arrays) {
    content.values.push_back(std::move(array.values));
    array.values.clear();
  }
}

FieldFile::~FieldFile() = default;

const FieldSet& FieldFile::fields() const {
  return content_->slices ? content_->slices->fields() : content_->fields;
}

std::optional<std::size_t> FieldFile::find(const std::string& name) const {
  if (content_->slices) {
    return io::in_file(content_->bytes.name(), [&] { return content_->slices->find(name); });
  }
  const std::vector<FieldArray>& arrays = content_->fields.arrays;
  const auto found = std::ranges::find(arrays, name, &FieldArray::name);
  if (found == arrays.end()) return std::nullopt;
  return static_cast<std::size_t>(found - arrays.begin());
}

void FieldFile::keep_chunks(std::size_t bytes) const {
  if (content_->slices) content_->slices->keep_chunks(bytes);
}

std::uint64_t FieldFile::bytes_beside() const {
  return content_->slices ? content_->slices->bytes_beside() : 0;
}

void FieldFile::read(std::size_t array, std::size_t first, std::span<double> out,
                     const Execution& execution) const {
  if (content_->slices) {
    io::in_file(content_->bytes.name(),
                [&] { content_->slices->read(array, first, out, execution.threads); });
    return;
  }
  // Values of other formats are those of all fields, one after the other.
  const auto begin = content_->values[array].begin() +
                     static_cast<std::ptrdiff_t>(first * content_->fields.num_points);
  std::copy_n(begin, out.size(), out.begin());
}

void FieldFile::read_points(std::size_t array, std::size_t field, std::size_t first_point,
                            std::span<double> out) const {
  if (content_->slices) {
    io::in_file(content_->bytes.name(),
                [&] { content_->slices->read_points(array, field, first_point, out); });
    return;
  }
  const std::size_t begin = field * content_->fields.num_points + first_point;
  std::copy_n(content_->values[array].begin() + static_cast<std::ptrdiff_t>(begin), out.size(),
              out.begin());
}

FieldSet read_fields(const FileName& file, std::span<const std::string> names,
                     std::uint64_t num_points, const ReadOptions& options,
                     std::span<const std::uint64_t> shape) {
  const FieldFile source(file, names, num_points, options, shape);
  FieldSet fields = source.fields();
  for (std::size_t a = 0; a < fields.arrays.size(); ++a) {
    FieldArray& array = fields.arrays[a];
    array.values.resize(array.num_fields() * fields.num_points);
    source.read(a, 0, array.values);
  }
  return fields;
}

bool can_write_fields(const FileName& file) {
  return io::find_format<FieldBeginning>(field_writers, file) != nullptr;
}

// A file that is begun. The sink refers to the file, so it is destroyed first.
struct FieldWriter::BegunFields {
  explicit BegunFields(const FileName& name) : file(name) {}

  io::AtomicFile file;
  std::unique_ptr<formats::FieldSink> sink;
};

FieldWriter::FieldWriter(const FileName& file, const FieldSet& fields, const WeightSide& points,
                         const NetcdfOptions& netcdf, const Execution& execution) {
  for (const Column& column : points.columns) {
    if (column.ends.size() == fields.num_points) continue;
    throw InvalidInput("column '" + column.name + "' has " + std::to_string(column.ends.size()) +
                       " cells for values at " + std::to_string(fields.num_points));
  }
  if (!points.points.empty() && points.points.size() != fields.num_points) {
    throw InvalidInput(std::to_string(points.points.size()) + " points for values at " +
                       std::to_string(fields.num_points));
  }
  // The writer of the format defines the header now; values follow by write().
  const FieldBeginning& writer =
      io::require_format<FieldBeginning>(field_writers, file, "fields are written as");
  output_ = std::make_unique<BegunFields>(file);
  output_->sink = io::in_file(file.path, [&] {
    return writer.begin(output_->file,
                        {fields, points, io::with_kind(netcdf, file), execution.threads});
  });
}

FieldWriter::~FieldWriter() = default;

void FieldWriter::write(std::span<const double> values) { output_->sink->write(values); }

std::vector<std::string> FieldWriter::remarks() const {
  std::vector<std::string> remarks = output_->sink->remarks();
  for (std::string& remark : remarks) remark.insert(0, output_->file.path() + ": ");
  return remarks;
}

void FieldWriter::finish() {
  output_->sink->finish();
  output_->file.commit();
}

void write_fields(const FileName& file, const FieldSet& fields, const WeightSide& points,
                  const NetcdfOptions& netcdf) {
  for (const FieldArray& array : fields.arrays) {
    if (array.values.size() == array.num_fields() * fields.num_points) continue;
    throw InvalidInput("array '" + array.name + "' has " + std::to_string(array.values.size()) +
                       " values");
  }
  FieldWriter writer(file, fields, points, netcdf);
  for (const FieldArray& array : fields.arrays) writer.write(array.values);
  writer.finish();
}

}  // namespace rondel
