// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/netcdf4_output.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <mutex>
#include <system_error>

#include "io/bad_value.h"
#include "io/netcdf_reader.h"
#include "io/netcdf_slabs.h"
#include "io/replacement.h"
#include "rondel/error.h"
#include "system/descriptor.h"

namespace rondel::io {
namespace {

using OutputLock = std::lock_guard<system::Mutex>;

// The number of values in a chunk is small enough for HDF5's cache of 1 MiB and more, and large enough for zlib.
constexpr std::uint64_t values_of_chunk = std::uint64_t{1} << 16U;

// A chunk has the last dimensions as long as they fit, and as many places of the next one as fit, too.
std::vector<std::size_t> chunk_lengths(const std::vector<std::uint64_t>& shape) {
  std::vector<std::size_t> lengths(shape.size(), 1);
  std::uint64_t room = values_of_chunk;
  for (std::size_t d = shape.size(); d-- > 0 && room > 1;) {
    lengths[d] = static_cast<std::size_t>(std::clamp<std::uint64_t>(shape[d], 1, room));
    room /= lengths[d];
    if (lengths[d] < shape[d]) break;
  }
  return lengths;
}

}  // namespace

Netcdf4Output::Netcdf4Output(AtomicFile& file, const Netcdf4Definitions& definitions, int deflate)
    : file_(file), library_(netcdf_library()) {
  const std::string folder =
      file.is_direct() ? (std::filesystem::temp_directory_path() / "").string() : file.directory();
  try {
    create(temporary_name(folder));
    define(definitions, deflate);
  } catch (...) {
    close();
    throw;
  }
}

Netcdf4Output::~Netcdf4Output() { close(); }

void Netcdf4Output::create(const std::string& name) {
  descriptor_ = open_replacement(name, file_.is_direct() ? name : file_.target());
  if (descriptor_ < 0) {
    throw FileError(name + ": " + std::generic_category().message(errno));
  }
  const OutputLock lock(netcdf_library_lock());
  const std::string whole = std::filesystem::absolute(name).string();
  const int error = library_.create(whole.c_str(), netcdf_create_netcdf4, &number_);
  is_open_ = error == 0;
  std::error_code failure;
  std::filesystem::remove(name, failure);
  if (failure) left_name_ = name;
  require_netcdf(library_, error);
}

void Netcdf4Output::define(const Netcdf4Definitions& definitions, int deflate) {
  const OutputLock lock(netcdf_library_lock());
  std::vector<int> dimensions;
  for (const NetcdfDimension& dimension : definitions.dimensions) {
    int number = 0;
    require_netcdf(library_,
                   library_.add_dimension(number_, dimension.name.c_str(),
                                          static_cast<std::size_t>(dimension.size), &number));
    dimensions.push_back(number);
  }
  for (const NetcdfAttribute& attribute : definitions.attributes) put(netcdf_whole_file, attribute);
  for (const NetcdfVariable& variable : definitions.variables) {
    std::vector<int> own;
    DefinedVariable output{0, size_of(variable.type), {}};
    for (const std::size_t dimension : variable.dimensions) {
      own.push_back(dimensions[dimension]);
      output.shape.push_back(definitions.dimensions[dimension].size);
    }
    variables_.push_back(std::move(output));
    define_variable(variable, own, deflate);
  }
  require_netcdf(library_, library_.end_definitions(number_));
}

void Netcdf4Output::define_variable(const NetcdfVariable& variable,
                                    const std::vector<int>& dimensions, int deflate) {
  DefinedVariable& output = variables_.back();
  require_netcdf(library_, library_.add_variable(number_, variable.name.c_str(),
                                                 static_cast<int>(variable.type),
                                                 static_cast<int>(dimensions.size()),
                                                 dimensions.data(), &output.number));
  if (!dimensions.empty()) {
    const std::vector<std::size_t> chunks = chunk_lengths(output.shape);
    require_netcdf(library_, library_.set_chunks(number_, output.number, 0, chunks.data()));
    if (deflate > 0) {
      const int shuffle = 1;  // bytes of the same weight together
      require_netcdf(library_, library_.set_deflate(number_, output.number, shuffle, 1, deflate));
    }
  }
  // All values are written, so netCDF-C need not fill any before.
  if (find_attribute(variable.attributes, "_FillValue") == nullptr) {
    require_netcdf(library_, library_.set_fill(number_, output.number, 1, nullptr));
  }
  for (const NetcdfAttribute& attribute : variable.attributes) put(output.number, attribute);
}

void Netcdf4Output::put(int variable, const NetcdfAttribute& attribute) {
  const char* const name = attribute.name.c_str();
  if (attribute.type == NetcdfType::text) {
    require_netcdf(library_, library_.put_text(number_, variable, name, attribute.text.size(),
                                               attribute.text.data()));
  } else {
    require_netcdf(library_,
                   library_.put_numbers(number_, variable, name, static_cast<int>(attribute.type),
                                        attribute.numbers.size(), attribute.numbers.data()));
  }
}

void Netcdf4Output::write(std::size_t variable, std::uint64_t begin, std::size_t size,
                          const void* values) {
  const DefinedVariable& output = variables_[variable];
  const char* const bytes = static_cast<const char*>(values);
  const OutputLock lock(netcdf_library_lock());
  for_each_slab(output.shape, begin, size,
                [&](const auto& start, const auto& count, std::size_t offset, std::size_t) {
                  require_netcdf(library_,
                                 library_.write(number_, output.number, start.data(), count.data(),
                                                bytes + offset * output.size_of_value));
                });
}

void Netcdf4Output::finish() {
  {
    const OutputLock lock(netcdf_library_lock());
    is_open_ = false;
    require_netcdf(library_, library_.close(number_));
  }
  std::string block(std::size_t{1} << 20U, '\0');
  const std::uint64_t size = system::size_of(descriptor_);
  for (std::uint64_t at = 0; at < size;) {
    const std::size_t wanted = std::min<std::uint64_t>(block.size(), size - at);
    const std::ptrdiff_t count = system::read_at(descriptor_, at, block.data(), wanted);
    if (count <= 0) throw FileError("netCDF-4: what was written cannot be read again");
    file_.write(std::string_view(block.data(), static_cast<std::size_t>(count)));
    at += static_cast<std::uint64_t>(count);
  }
  close();
}

void Netcdf4Output::close() {
  if (is_open_) {
    const OutputLock lock(netcdf_library_lock());
    library_.close(number_);
    is_open_ = false;
  }
  if (descriptor_ >= 0) system::close(descriptor_);
  descriptor_ = -1;
  std::error_code ignored;
  if (!left_name_.empty()) std::filesystem::remove(left_name_, ignored);
  left_name_.clear();
}

}  // namespace rondel::io
