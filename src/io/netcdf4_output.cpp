// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/netcdf4_output.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <system_error>

#include "io/atomic_file.h"
#include "io/bad_value.h"
#include "io/netcdf_reader.h"
#include "io/netcdf_slabs.h"
#include "io/number.h"
#include "rondel/error.h"
#include "system/descriptor.h"

namespace rondel::io {
namespace {

using OutputLock = std::lock_guard<system::Mutex>;

// The number of values in a chunk, which is large enough for zlib.
constexpr std::uint64_t values_of_chunk = std::uint64_t{1} << 16U;

// The size of the cache of a variable's chunks. Values come in their order, so that a chunk is
// complete soon and need not wait for the end of the file, where all that wait are compressed by one
// thread while no other has work.
constexpr std::uint64_t size_of_cache = std::uint64_t{1} << 22U;

// NetCDF-C and Hdf5ChunkWriter keep back fewer bytes of a variable: a cache, or 17 chunks of doubles.
constexpr std::uint64_t max_kept_back = std::uint64_t{1} << 24U;

// Returns the lengths of a chunk: the last dimensions as far as they fit, and as many indices of
// the next one as fit.
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

// Returns the number of values in all chunks. Chunks at the end of a dimension are as long as the
// others, which at most doubles a dimension.
std::uint64_t values_of_chunks(const std::vector<std::uint64_t>& shape) {
  const std::vector<std::size_t> lengths = chunk_lengths(shape);
  std::uint64_t values = 1;
  for (std::size_t d = 0; d < shape.size(); ++d) {
    values *= (shape[d] + lengths[d] - 1) / lengths[d] * lengths[d];
  }
  return values;
}

// Returns more than HDF5 takes for definitions: a header, lists of attributes and the trees that
// say where chunks are.
std::uint64_t max_bytes_of_definitions(const Netcdf4Definitions& definitions) {
  constexpr std::uint64_t bytes_per_item = std::uint64_t{1} << 14U;
  constexpr std::uint64_t of_attribute = 512;
  constexpr std::uint64_t of_chunk = 256;
  std::uint64_t size =
      bytes_per_item * (1 + definitions.dimensions.size() + definitions.variables.size());
  const auto add_attributes = [&](const std::vector<NetcdfAttribute>& attributes) {
    for (const NetcdfAttribute& attribute : attributes) {
      size += of_attribute +
              2 * (attribute.name.size() + attribute.text.size() + 8 * attribute.numbers.size());
    }
  };
  add_attributes(definitions.attributes);
  for (const NetcdfVariable& variable : definitions.variables) {
    add_attributes(variable.attributes);
    std::vector<std::uint64_t> shape;
    for (const std::size_t d : variable.dimensions) shape.push_back(definitions.dimensions[d].size);
    size += of_chunk * (1 + 2 * values_of_chunks(shape) / values_of_chunk);
  }
  return size;
}

// Returns the bytes of the value of `_FillValue`, or else zeros.
std::vector<unsigned char> fill_bytes(const NetcdfVariable& variable) {
  std::vector<unsigned char> bytes(size_of(variable.type), 0);
  const NetcdfAttribute* const fill = find_attribute(variable.attributes, "_FillValue");
  if (fill == nullptr || fill->numbers.empty()) return bytes;
  const double number = fill->numbers.front();
  const auto store = [&](auto value) { std::memcpy(bytes.data(), &value, sizeof value); };
  if (variable.type == NetcdfType::float32) {
    store(static_cast<float>(number));
  } else if (variable.type == NetcdfType::float64) {
    store(number);
  } else {
    // The last bytes are those of a larger integer, or the first ones where these come first.
    const auto integer = static_cast<std::int64_t>(number);
    const auto* const begin = reinterpret_cast<const unsigned char*>(&integer);
    const std::size_t skipped =
        std::endian::native == std::endian::big ? sizeof integer - bytes.size() : 0;
    std::copy_n(begin + skipped, bytes.size(), bytes.begin());
  }
  return bytes;
}

}  // namespace

Netcdf4Output::Netcdf4Output(AtomicFile& file, const Netcdf4Definitions& definitions, int deflate,
                             unsigned threads)
    : file_(file), library_(netcdf_library()), deflate_(deflate), threads_(threads) {
  const std::string folder =
      file.is_direct() ? (std::filesystem::temp_directory_path() / "").string() : file.directory();
  try {
    size_of_definitions_ = max_bytes_of_definitions(definitions);
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
  std::error_code failure;
  try {
    require_room();
    const OutputLock lock(netcdf_library_lock());
    path_ = std::filesystem::absolute(name).string();
    const int error = library_.create(path_.c_str(), netcdf_create_netcdf4, &number_);
    is_open_ = error == 0;
    require(error, "the file");
  } catch (...) {
    std::filesystem::remove(name, failure);
    throw;
  }
  std::filesystem::remove(name, failure);
  if (failure) left_name_ = name;
  // The library has emptied the file, and given the room back.
  size_with_room_ = 0;
  require_room();
}

void Netcdf4Output::require(int error, const std::string& what) const {
  if (error == 0) return;
  throw FileError(file_.path() + ": " + what + ": netCDF-C says: " + library_.error_text(error));
}

void Netcdf4Output::require_room() {
  std::uint64_t kept_back = size_of_definitions_;
  for (const DefinedVariable& variable : variables_) {
    if (variable.num_bytes_handed == 0) continue;
    const std::uint64_t of_chunk = values_of_chunk * variable.size_of_value;
    kept_back += std::min(
        {max_kept_back, variable.num_bytes_stored, 2 * variable.num_bytes_handed + of_chunk});
  }
  const std::uint64_t needed = system::size_of(descriptor_) + kept_back;
  if (needed <= size_with_room_) return;
  // Values come in small pieces, so that more room is found at once, and less often.
  constexpr std::uint64_t more = std::uint64_t{1} << 20U;
  size_with_room_ = needed + more;
  if (system::allocate(descriptor_, size_with_room_) == 0) return;
  size_with_room_ = needed;
  if (system::allocate(descriptor_, size_with_room_) == 0) return;
  throw FileError(file_.path(), std::error_code(errno, std::generic_category()));
}

void Netcdf4Output::define(const Netcdf4Definitions& definitions, int deflate) {
  const OutputLock lock(netcdf_library_lock());
  std::vector<int> dimensions;
  for (const NetcdfDimension& dimension : definitions.dimensions) {
    int number = 0;
    require(
        library_.add_dimension(
            number_, dimension.name.c_str(),
            dimension.is_unlimited ? netcdf_unlimited : static_cast<std::size_t>(dimension.size),
            &number),
        "dimension " + in_quotes(dimension.name));
    dimensions.push_back(number);
  }
  for (const NetcdfAttribute& attribute : definitions.attributes) put(netcdf_whole_file, attribute);
  for (const NetcdfVariable& variable : definitions.variables) {
    std::vector<int> own;
    DefinedVariable output{0, variable.name, size_of(variable.type), {}, 0, 0, false, nullptr};
    for (const std::size_t dimension : variable.dimensions) {
      output.is_unlimited = output.is_unlimited || definitions.dimensions[dimension].is_unlimited;
      own.push_back(dimensions[dimension]);
      output.shape.push_back(definitions.dimensions[dimension].size);
    }
    output.num_bytes_stored = values_of_chunks(output.shape) * output.size_of_value;
    variables_.push_back(std::move(output));
    define_variable(variable, own, deflate);
  }
  require(library_.end_definitions(number_), "the definitions");
  for (std::size_t v = 0; v < variables_.size(); ++v) {
    open_chunks(variables_[v], definitions.variables[v]);
  }
}

void Netcdf4Output::open_chunks(DefinedVariable& output, const NetcdfVariable& variable) {
  const std::vector<std::size_t> lengths = chunk_lengths(output.shape);
  std::uint64_t of_chunk = output.size_of_value;
  for (const std::size_t length : lengths) of_chunk *= length;
  if (deflate_ == 0 || output.num_bytes_stored <= of_chunk) return;
  output.chunks =
      Hdf5ChunkWriter::open({path_, output.name, output.shape, lengths, output.size_of_value,
                             deflate_, output.is_unlimited, fill_bytes(variable)},
                            threads_);
}

void Netcdf4Output::define_variable(const NetcdfVariable& variable,
                                    const std::vector<int>& dimensions, int deflate) {
  DefinedVariable& output = variables_.back();
  const std::string what = "variable " + in_quotes(variable.name);
  require(
      library_.add_variable(number_, variable.name.c_str(), static_cast<int>(variable.type),
                            static_cast<int>(dimensions.size()), dimensions.data(), &output.number),
      what);
  if (!dimensions.empty()) {
    const std::vector<std::size_t> chunks = chunk_lengths(output.shape);
    require(library_.set_chunks(number_, output.number, 0, chunks.data()), what);
    constexpr std::size_t slots = 1009;  // a prime number, as HDF5 wants it
    constexpr float first_out = 0.75F;   // how much sooner a complete chunk leaves than others
    require(library_.set_cache(number_, output.number, size_of_cache, slots, first_out), what);
    if (deflate > 0) {
      const int shuffle = 1;  // bytes of the same weight together
      require(library_.set_deflate(number_, output.number, shuffle, 1, deflate), what);
    }
  }
  // All values are written, so netCDF-C need not fill variables before.
  if (find_attribute(variable.attributes, "_FillValue") == nullptr) {
    require(library_.set_fill(number_, output.number, 1, nullptr), what);
  }
  for (const NetcdfAttribute& attribute : variable.attributes) put(output.number, attribute);
}

void Netcdf4Output::put(int variable, const NetcdfAttribute& attribute) {
  const char* const name = attribute.name.c_str();
  const int error =
      attribute.type == NetcdfType::text
          ? library_.put_text(number_, variable, name, attribute.text.size(), attribute.text.data())
          : library_.put_numbers(number_, variable, name, static_cast<int>(attribute.type),
                                 attribute.numbers.size(), attribute.numbers.data());
  require(error, "attribute " + in_quotes(attribute.name));
}

void Netcdf4Output::write(std::size_t variable, std::uint64_t begin, std::size_t size,
                          const void* values) {
  DefinedVariable& output = variables_[variable];
  const char* const bytes = static_cast<const char*>(values);
  output.num_bytes_handed += size * output.size_of_value;
  require_room();
  if (output.chunks != nullptr) {
    if (output.chunks->write(values, size)) return;
    throw FileError(file_.path() + ": variable " + in_quotes(output.name) +
                    ": HDF5 cannot write it");
  }
  const OutputLock lock(netcdf_library_lock());
  for_each_slab(output.shape, begin, size,
                [&](const auto& start, const auto& count, std::size_t offset, std::size_t) {
                  require(library_.write(number_, output.number, start.data(), count.data(),
                                         bytes + offset * output.size_of_value),
                          "variable " + in_quotes(output.name));
                });
}

void Netcdf4Output::finish() {
  {
    const OutputLock lock(netcdf_library_lock());
    for (DefinedVariable& variable : variables_) variable.chunks.reset();
    is_open_ = false;
    require(library_.close(number_), "the end of the file");
  }
  std::string block(std::size_t{1} << 20U, '\0');
  const std::uint64_t size = system::size_of(descriptor_);
  for (std::uint64_t at = 0; at < size;) {
    const std::size_t wanted = std::min<std::uint64_t>(block.size(), size - at);
    const std::ptrdiff_t count = system::read_at(descriptor_, at, block.data(), wanted);
    if (count <= 0) throw FileError(file_.path() + ": what was written cannot be read again");
    file_.write(std::string_view(block.data(), static_cast<std::size_t>(count)));
    at += static_cast<std::uint64_t>(count);
  }
  close();
}

void Netcdf4Output::close() {
  if (is_open_) {
    const OutputLock lock(netcdf_library_lock());
    for (DefinedVariable& variable : variables_) variable.chunks.reset();
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
