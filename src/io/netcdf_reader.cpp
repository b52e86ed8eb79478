// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/netcdf_reader.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "io/bad_value.h"
#include "io/binary.h"
#include "io/netcdf4_file.h"
#include "io/netcdf_groups.h"
#include "io/netcdf_header.h"
#include "io/number.h"
#include "io/wide_integers.h"
#include "system/checked_product.h"
#include "system/large_arrays.h"

namespace rondel::io {
namespace {

// Throws BadValue with the name of the variable.
[[noreturn]] void refuse(const VariableInFile& variable, const std::string& why) {
  throw BadValue("variable " + in_quotes(variable.name) + " " + why);
}

// Products and sums of numbers that a damaged header may hold. They throw BadValue where they
// overflow.
std::uint64_t product(const VariableInFile& variable, std::uint64_t a, std::uint64_t b) {
  std::uint64_t result = 0;
  if (!system::multiply_checked(a, b, result)) refuse(variable, "is too large");
  return result;
}

std::uint64_t sum(const VariableInFile& variable, std::uint64_t a, std::uint64_t b) {
  std::uint64_t result = 0;
  if (!system::add_checked(a, b, result)) refuse(variable, "is too large");
  return result;
}

constexpr const char* not_numbers = "is a text where numbers are needed";

// Throws BadValue for the first value that was 2^63 or more.
void require_signed(const VariableInFile& variable, std::span<const std::int64_t> values) {
  for (const std::int64_t value : values) {
    if (value < 0) refuse(variable, "has an integer beyond 2^63");
  }
}

// Throws BadValue if the `size` bytes at the variable's offset end after the file.
void require_bytes(const VariableInFile& variable, std::uint64_t size, std::uint64_t file_size) {
  if (size == 0) return;
  const std::uint64_t end = sum(variable, variable.offset, size);
  if (end <= file_size) return;
  refuse(variable,
         "ends at byte " + std::to_string(end) + ", the file at " + std::to_string(file_size));
}

}  // namespace

bool is_netcdf(std::string_view head) { return head.starts_with("CDF") || is_hdf5(head); }

NetcdfReader::NetcdfReader(std::string_view bytes) : bytes_(bytes), size_(bytes.size()) {
  if (is_hdf5(bytes)) {
    netcdf4_ = std::make_shared<const Netcdf4File>(bytes);
    take(netcdf4_->header());
  } else {
    parse(bytes);
  }
}

NetcdfReader::NetcdfReader(FileBytes& file) : file_(&file), size_(file.claimed_size()) {
  if (size_ > 0 && file.has_path() && is_hdf5(file.head())) {
    netcdf4_ = std::make_shared<const Netcdf4File>(file.name());
    take(netcdf4_->header());
    return;
  }
  constexpr std::size_t growth = 8;
  while (size_ > file.head().size()) {
    try {
      parse(file.head());
      return;
    } catch (const BadValue&) {
      // The head that was read may be cut off, and not the file.
      file.longer_head(growth * file.head().size());
    }
  }
  *this = NetcdfReader(file.text());
}

void NetcdfReader::take(NetcdfHeader&& header) {
  dimensions_ = std::move(header.dimensions);
  attributes_ = std::move(header.attributes);
  variables_ = std::move(header.variables);
  passed_over_ = std::move(header.passed_over);
  numbers_.clear();
  // The first one of a name counts.
  for (std::size_t v = 0; v < variables_.size(); ++v) numbers_.emplace(variables_[v].name, v);
}

void NetcdfReader::parse(std::string_view head) {
  NetcdfHeader header = parse_netcdf_header(head);
  record_size_ = 0;
  const bool counts_records = header.counts_records;
  const std::uint64_t num_records = header.num_records;
  take(std::move(header));
  for (VariableInFile& variable : variables_) {
    variable.record_values = 1;
    for (std::size_t i = 0; i < variable.dimensions.size(); ++i) {
      const std::uint64_t size = dimensions_[variable.dimensions[i]].size;
      variable.shape.push_back(size);
      if (size != 0) {
        variable.record_values = product(variable, variable.record_values, size);
      } else if (i == 0) {
        variable.has_records = true;
      } else {
        refuse(variable, "has the dimension of records not as its first one");
      }
    }
    const std::uint64_t size = product(variable, variable.record_values, size_of(variable.type));
    variable.num_values = variable.record_values;
    if (!variable.has_records) require_bytes(variable, size, size_);
  }
  place_records(counts_records ? num_records : std::numeric_limits<std::uint64_t>::max());
}

// The records of all variables are interleaved, and padded unless there is only one variable. If
// the header does not count them, there are as many as the file has whole ones.
void NetcdfReader::place_records(std::uint64_t claimed) {
  std::size_t num_variables = 0;
  std::uint64_t unpadded = 0;
  std::uint64_t first = size_;
  for (const VariableInFile& variable : variables_) {
    if (!variable.has_records) continue;
    ++num_variables;
    unpadded = variable.record_values * size_of(variable.type);
    if (unpadded > size_ && claimed != 0) refuse(variable, "is longer than the file");
    record_size_ =
        sum(variable, record_size_, netcdf_padded(std::min(unpadded, ~std::uint64_t{7})));
    first = std::min(first, variable.offset);
  }
  if (num_variables == 0) return;
  if (num_variables == 1) record_size_ = unpadded;
  std::uint64_t number = claimed;
  if (number == std::numeric_limits<std::uint64_t>::max()) {
    number = record_size_ == 0 ? 0 : (size_ - first) / record_size_;
  }
  for (VariableInFile& variable : variables_) {
    if (!variable.has_records) continue;
    variable.shape.front() = number;
    variable.num_values = product(variable, number, variable.record_values);
    if (number == 0) continue;
    const std::uint64_t before = product(variable, number - 1, record_size_);
    require_bytes(variable, sum(variable, before, variable.record_values * size_of(variable.type)),
                  size_);
  }
  for (NetcdfDimension& dimension : dimensions_) {
    if (dimension.size != 0) continue;
    dimension.size = number;
    dimension.is_unlimited = true;
  }
}

NetcdfReader NetcdfReader::with(std::map<std::size_t, VariableInFile> variables) const {
  NetcdfReader made = *this;
  for (auto& [number, variable] : variables) made.variables_[number] = std::move(variable);
  return made;
}

const VariableInFile* NetcdfReader::find(std::string_view name) const {
  const auto at = numbers_.find(name);
  return at == numbers_.end() ? nullptr : &variables_[at->second];
}

const VariableInFile& NetcdfReader::require(std::string_view name) const {
  if (const VariableInFile* const variable = find(name)) return *variable;
  if (std::ranges::find(passed_over_, name) != passed_over_.end()) {
    throw BadValue("variable " + in_quotes(name) +
                   " has a type that the file defines itself, which is not read");
  }
  require_one_group(variables_, name);
  throw BadValue("no variable " + in_quotes(name));
}

std::uint64_t NetcdfReader::place(const VariableInFile& variable, std::uint64_t index) const {
  const std::size_t size = size_of(variable.type);
  if (!variable.has_records) return variable.offset + index * size;
  const std::uint64_t record = index / variable.record_values;
  return variable.offset + record * record_size_ + index % variable.record_values * size;
}

// Reads contiguous values together: all of them, or the rest of a record.
template <typename T, typename Out>
void NetcdfReader::copy(const VariableInFile& variable, std::uint64_t begin,
                        std::span<Out> out) const {
  std::vector<char> buffer;
  while (!out.empty()) {
    std::size_t count = out.size();
    if (variable.has_records) {
      count = static_cast<std::size_t>(
          std::min<std::uint64_t>(count, variable.record_values - begin % variable.record_values));
    }
    const std::uint64_t at = place(variable, begin);
    const char* first = nullptr;
    if (file_ == nullptr) {
      first = bytes_.data() + at;
    } else {
      buffer.resize(count * sizeof(T));
      file_->read_at(at, buffer.data(), buffer.size());
      first = buffer.data();
    }
    for (std::size_t i = 0; i < count; ++i) {
      // NOLINTNEXTLINE(bugprone-signed-char-misuse): a number, no character
      out[i] = static_cast<Out>(load<T>(first + i * sizeof(T), std::endian::big));
    }
    begin += count;
    out = out.subspan(count);
  }
}

void NetcdfReader::read_numbers(const VariableInFile& variable, std::uint64_t begin,
                                std::span<double> out) const {
  if (is_wide(variable.type)) {
    std::vector<std::int64_t> wide(out.size());
    read_wide(variable, begin, wide);
    to_doubles(variable, wide, out);
  } else if (netcdf4_ != nullptr) {
    require_numbers(variable);
    netcdf4_->read(variable, begin, out);
  } else if (variable.type == NetcdfType::float64) {
    copy<double>(variable, begin, out);
  } else if (variable.type == NetcdfType::float32) {
    copy<float>(variable, begin, out);
  } else {
    std::vector<std::int64_t> whole(out.size());
    read_integers(variable, begin, whole);
    std::ranges::copy(whole, out.begin());
  }
}

void NetcdfReader::read_wide(const VariableInFile& variable, std::uint64_t begin,
                             std::span<std::int64_t> out) const {
  if (netcdf4_ != nullptr) {
    netcdf4_->read(variable, begin, out);
  } else {
    copy<std::int64_t>(variable, begin, out);
  }
}

std::vector<double> NetcdfReader::rounded_numbers(const VariableInFile& variable,
                                                  bool& is_rounded) const {
  if (!is_wide(variable.type)) return numbers(variable);
  require_room(variable);
  std::vector<std::int64_t> wide(variable.num_values);
  read_wide(variable, 0, wide);
  std::vector<double> values(wide.size());
  is_rounded |= round_to_doubles(variable, wide, values) < wide.size();
  return values;
}

// Values of netCDF-4 that were never written take no bytes, and equal ones hardly any. So this
// bound is wide: it keeps a damaged size from taking all of the memory.
std::uint64_t NetcdfReader::max_values() const {
  constexpr unsigned max_packed = 20;  // logarithm of the largest number of values a byte
  return netcdf4_ == nullptr ? size_
                             : std::min(size_, ~std::uint64_t{0} >> max_packed) << max_packed;
}

std::vector<std::uint64_t> NetcdfReader::chunk_of(const VariableInFile& variable) const {
  std::vector<std::uint64_t> lengths(variable.shape.size(), 1);
  if (netcdf4_ != nullptr) netcdf4_->take_chunk(variable, lengths);
  return lengths;
}

// HDF5 counts from its signature, so that this is only for files that begin with it.
const Hdf5Chunks* NetcdfReader::chunks_of(const VariableInFile& variable) const {
  if (netcdf4_ == nullptr || file_ == nullptr || !has_hdf5_at_begin(file_->head())) return nullptr;
  return netcdf4_->chunks(variable);
}

bool NetcdfReader::has_chunks(const VariableInFile& variable) const {
  constexpr std::size_t least_values = 1024;
  const Hdf5Chunks* const chunks = chunks_of(variable);
  return chunks != nullptr && chunks->num_values() >= least_values;
}

void NetcdfReader::keep_chunks(const VariableInFile& variable, std::size_t bytes) const {
  const Hdf5Chunks* const chunks = chunks_of(variable);
  if (chunks != nullptr) chunks->set_room(bytes);
}

bool NetcdfReader::read_chunk(const VariableInFile& variable, const NetcdfBox& box,
                              const BoxPlace& out) const {
  const Hdf5Chunks* const chunks = chunks_of(variable);
  return chunks != nullptr && chunks->is_in_chunk(box) && chunks->read(*file_, box, out);
}

void NetcdfReader::require_numbers(const VariableInFile& variable) {
  if (variable.type == NetcdfType::text) refuse(variable, not_numbers);
}

void NetcdfReader::require_room(const VariableInFile& variable) const {
  require_numbers(variable);
  if (netcdf4_ == nullptr || variable.num_values <= max_values()) return;
  refuse(variable, "has " + std::to_string(variable.num_values) + " values in a file of " +
                       std::to_string(size_) + " bytes");
}

std::string NetcdfReader::characters(const VariableInFile& variable) const {
  std::string text(variable.num_values, '\0');
  if (netcdf4_ != nullptr) {
    netcdf4_->read(variable, text);
  } else {
    copy<char>(variable, 0, std::span<char>(text));
  }
  return text;
}

std::vector<std::string> NetcdfReader::strings(const VariableInFile& variable) const {
  return netcdf4_->strings(variable);
}

std::vector<double> NetcdfReader::numbers(const VariableInFile& variable) const {
  require_room(variable);
  auto values = system::large_vector<double>(variable.num_values);
  read_numbers(variable, 0, values);
  return values;
}

std::vector<std::int64_t> NetcdfReader::integers(const VariableInFile& variable) const {
  require_room(variable);
  std::vector<std::int64_t> values(variable.num_values);
  read_integers(variable, 0, values);
  return values;
}

void NetcdfReader::read_integers(const VariableInFile& variable, std::uint64_t begin,
                                 std::span<std::int64_t> out) const {
  const NetcdfType type = variable.type;
  const bool is_floating = type == NetcdfType::float32 || type == NetcdfType::float64;
  if (netcdf4_ != nullptr && type != NetcdfType::text && !is_floating) {
    netcdf4_->read(variable, begin, out);
    if (type == NetcdfType::uint64) require_signed(variable, out);
    return;
  }
  switch (type) {
    case NetcdfType::int8:
      copy<std::int8_t>(variable, begin, out);
      break;
    case NetcdfType::int16:
      copy<std::int16_t>(variable, begin, out);
      break;
    case NetcdfType::int32:
      copy<std::int32_t>(variable, begin, out);
      break;
    case NetcdfType::uint8:
      copy<std::uint8_t>(variable, begin, out);
      break;
    case NetcdfType::uint16:
      copy<std::uint16_t>(variable, begin, out);
      break;
    case NetcdfType::uint32:
      copy<std::uint32_t>(variable, begin, out);
      break;
    case NetcdfType::int64:
      copy<std::int64_t>(variable, begin, out);
      break;
    case NetcdfType::uint64:
      copy<std::uint64_t>(variable, begin, out);
      require_signed(variable, out);
      break;
    case NetcdfType::text:
      refuse(variable, not_numbers);
    case NetcdfType::float32:
    case NetcdfType::float64:
      refuse(variable, "is not of integers");
  }
}

const NetcdfAttribute* find_attribute(std::span<const NetcdfAttribute> attributes,
                                      std::string_view name) {
  const auto at = std::ranges::find(attributes, name, &NetcdfAttribute::name);
  return at == attributes.end() ? nullptr : &*at;
}

std::string netcdf_text(std::span<const NetcdfAttribute> attributes, std::string_view name) {
  const NetcdfAttribute* const attribute = find_attribute(attributes, name);
  return attribute == nullptr ? std::string() : attribute->text;
}

std::vector<std::uint64_t> shape_of_grid(const NetcdfReader& file, const VariableInFile& lengths,
                                         std::uint64_t size) {
  std::vector<std::uint64_t> shape;
  std::uint64_t product = 1;
  for (const std::int64_t length : file.integers(lengths)) {
    shape.push_back(static_cast<std::uint64_t>(length));
    if (length < 1 || !system::multiply_checked(product, shape.back(), product)) product = 0;
  }
  // Some programs write 0 or 1 for points that are on no grid.
  const bool is_unknown = shape.empty() || (shape.size() == 1 && product < 2);
  if (product != size && !is_unknown) {
    std::string text;
    for (const std::int64_t length : file.integers(lengths)) {
      text += (text.empty() ? "" : " x ") + std::to_string(length);
    }
    refuse(lengths, "is " + text + ", which does not multiply to " + std::to_string(size));
  }
  if (shape.size() < 2) return {};
  std::ranges::reverse(shape);
  return shape;
}

}  // namespace rondel::io
