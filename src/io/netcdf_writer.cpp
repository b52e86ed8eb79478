// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/netcdf_writer.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "io/bad_value.h"
#include "io/netcdf4_output.h"
#include "io/number.h"

namespace rondel::io {
namespace {

// The largest dimension, and the largest variable, of CDF-1 and CDF-2.
constexpr std::uint64_t largest_dimension = 0x7fff'ffff;
constexpr std::uint64_t largest_variable = 0xffff'fffc;
// Smaller files stay in memory long after they are written, so that reserving space is not worth
// it.
constexpr std::uint64_t large_file = std::uint64_t{1} << 25U;
// The largest offset at which a variable may start in CDF-1.
constexpr std::uint64_t largest_offset = 0x7fff'ffff;

// Returns the type that an attribute has in CDF-1 and CDF-2: its own, or for one of CDF-5 the next larger one
// that has all of its numbers.
NetcdfType type_of_cdf1(const NetcdfAttribute& attribute) {
  if (attribute.type <= NetcdfType::float64) return attribute.type;
  if (attribute.type == NetcdfType::uint8) return NetcdfType::int16;
  const bool fits = std::ranges::all_of(attribute.numbers, [](double number) {
    return std::abs(number) <= std::numeric_limits<std::int32_t>::max();
  });
  return fits ? NetcdfType::int32 : NetcdfType::float64;
}

// Builds the header. Counts have the width of the version.
class HeaderBytes {
 public:
  explicit HeaderBytes(int version) : version_(version), bytes_("CDF") {
    bytes_ += static_cast<char>(version);
  }

  void u32(std::uint64_t value) { add<std::uint32_t>(value); }
  void count(std::uint64_t value) { version_ == 5 ? add<std::uint64_t>(value) : u32(value); }
  void offset(std::uint64_t value) { version_ == 1 ? u32(value) : add<std::uint64_t>(value); }
  void name(std::string_view name) {
    count(name.size());
    text(name);
  }
  void text(std::string_view text) {
    bytes_ += text;
    pad();
  }
  // Appends the head of a list; an empty list has no tag.
  void list(std::uint32_t tag, std::size_t size) {
    u32(size == 0 ? 0 : tag);
    count(size);
  }
  void attributes(const std::vector<NetcdfAttribute>& attributes) {
    list(netcdf_attributes_tag, attributes.size());
    for (const NetcdfAttribute& attribute : attributes) {
      const NetcdfType type = version_ == 5 ? attribute.type : type_of_cdf1(attribute);
      name(attribute.name);
      u32(static_cast<std::uint32_t>(type));
      if (type == NetcdfType::text) {
        count(attribute.text.size());
        text(attribute.text);
      } else {
        count(attribute.numbers.size());
        for (const double value : attribute.numbers) number(value, type);
        pad();
      }
    }
  }
  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  template <typename T>
  void add(std::uint64_t value) {
    std::array<char, sizeof(T)> bytes;
    store(static_cast<T>(value), bytes.data(), std::endian::big);
    bytes_.append(bytes.data(), bytes.size());
  }
  // Appends a number of an attribute, which is one of this type.
  void number(double value, NetcdfType type) {
    if (type == NetcdfType::float32) {
      u32(std::bit_cast<std::uint32_t>(static_cast<float>(value)));
    } else if (type == NetcdfType::float64) {
      add<std::uint64_t>(std::bit_cast<std::uint64_t>(value));
    } else {
      const std::uint64_t bits = type == NetcdfType::uint64
                                     ? static_cast<std::uint64_t>(value)
                                     : static_cast<std::uint64_t>(static_cast<std::int64_t>(value));
      switch (size_of(type)) {
        case 1:
          return add<std::uint8_t>(bits);
        case 2:
          return add<std::uint16_t>(bits);
        case 4:
          return add<std::uint32_t>(bits);
        default:
          return add<std::uint64_t>(bits);
      }
    }
  }
  void pad() { bytes_.resize(netcdf_padded(bytes_.size())); }

  int version_;
  std::string bytes_;
};

}  // namespace

NetcdfWriter::NetcdfWriter(AtomicFile& file) : file_(file) {}
NetcdfWriter::~NetcdfWriter() = default;

std::size_t NetcdfWriter::add_dimension(std::string name, std::uint64_t size, bool is_unlimited) {
  dimensions_.push_back({std::move(name), size, is_unlimited});
  return dimensions_.size() - 1;
}

void NetcdfWriter::add_attribute(std::string name, std::string text) {
  attributes_.push_back({std::move(name), NetcdfType::text, std::move(text), {}});
}

void NetcdfWriter::add_attribute(NetcdfAttribute attribute) {
  attributes_.push_back(std::move(attribute));
}

void NetcdfWriter::add_variable(NetcdfVariable variable) {
  variables_.push_back(std::move(variable));
}

// Returns the size without the padding.
std::uint64_t NetcdfWriter::size_of_values(const NetcdfVariable& variable) const {
  std::uint64_t size = size_of(variable.type);
  for (const std::size_t dimension : variable.dimensions) size *= dimensions_[dimension].size;
  return size;
}

int NetcdfWriter::needed_version() const {
  for (const NetcdfDimension& dimension : dimensions_) {
    if (dimension.size > largest_dimension) return 5;
  }
  for (const NetcdfVariable& variable : variables_) {
    const std::uint64_t size =
        is_of_records(variable) ? size_of_record(variable) : size_of_values(variable);
    if (variable.type > NetcdfType::float64 || netcdf_padded(size) > largest_variable) return 5;
  }
  const std::vector<std::uint64_t> begins = offsets(header(2, 0).size());
  return !begins.empty() && std::ranges::max(begins) > largest_offset ? 2 : 1;
}

void NetcdfWriter::choose_records() {
  if (!file_.has_places()) return;
  const bool has_empty = std::ranges::any_of(
      dimensions_, [](const NetcdfDimension& dimension) { return dimension.size == 0; });
  for (std::size_t d = 0; d < dimensions_.size() && !has_empty && records_ == no_dimension; ++d) {
    const bool is_first = std::ranges::all_of(variables_, [&](const NetcdfVariable& variable) {
      const auto at = std::ranges::find(variable.dimensions, d);
      return at == variable.dimensions.end() || at == variable.dimensions.begin();
    });
    if (dimensions_[d].is_unlimited && is_first) records_ = d;
  }
}

std::vector<std::string> NetcdfWriter::remarks() const {
  std::string names;
  for (std::size_t d = 0; d < dimensions_.size() && netcdf4_ == nullptr; ++d) {
    // A dimension of length 0 is that of records.
    const bool is_limited = dimensions_[d].is_unlimited && d != records_ && dimensions_[d].size > 0;
    if (is_limited) names += (names.empty() ? "" : ", ") + dimensions_[d].name;
  }
  if (names.empty()) return {};
  return {"no records can be appended along " + names + ", as classic netCDF has " +
          (file_.has_places() ? "one dimension of records, in front of all others"
                              : "no dimension of records in a pipe") +
          "; netCDF-4 can"};
}

bool NetcdfWriter::is_of_records(const NetcdfVariable& variable) const {
  return std::ranges::any_of(variable.dimensions, [&](std::size_t dimension) {
    return dimension == records_ || dimensions_[dimension].size == 0;
  });
}

std::uint64_t NetcdfWriter::size_of_record(const NetcdfVariable& variable) const {
  std::uint64_t size = size_of(variable.type);
  for (const std::size_t dimension : variable.dimensions) {
    if (dimension != records_) size *= std::max<std::uint64_t>(dimensions_[dimension].size, 1);
  }
  return size;
}

// The records of one variable alone are not padded.
std::uint64_t NetcdfWriter::size_of_records() const {
  std::uint64_t size = 0;
  std::uint64_t unpadded = 0;
  std::size_t number = 0;
  for (const NetcdfVariable& variable : variables_) {
    if (!is_of_records(variable)) continue;
    unpadded = size_of_record(variable);
    size += netcdf_padded(unpadded);
    ++number;
  }
  return number == 1 ? unpadded : size;
}

// Records come behind all else.
std::vector<std::uint64_t> NetcdfWriter::offsets(std::uint64_t first_offset) const {
  std::uint64_t of_records = first_offset;
  for (const NetcdfVariable& variable : variables_) {
    if (!is_of_records(variable)) of_records += netcdf_padded(size_of_values(variable));
  }
  std::vector<std::uint64_t> result;
  for (const NetcdfVariable& variable : variables_) {
    const bool has_records = is_of_records(variable);
    std::uint64_t& next = has_records ? of_records : first_offset;
    result.push_back(next);
    next += netcdf_padded(has_records ? size_of_record(variable) : size_of_values(variable));
  }
  return result;
}

// For variables of records, the header has the size of one record.
std::string NetcdfWriter::header(int version, std::uint64_t first_offset) const {
  HeaderBytes bytes(version);
  bytes.count(records_ == no_dimension ? 0 : dimensions_[records_].size);
  bytes.list(netcdf_dimensions_tag, dimensions_.size());
  for (std::size_t d = 0; d < dimensions_.size(); ++d) {
    bytes.name(dimensions_[d].name);
    bytes.count(d == records_ ? 0 : dimensions_[d].size);
  }
  bytes.attributes(attributes_);
  bytes.list(netcdf_variables_tag, variables_.size());
  const std::vector<std::uint64_t> begins = offsets(first_offset);
  for (std::size_t v = 0; v < variables_.size(); ++v) {
    const NetcdfVariable& variable = variables_[v];
    bytes.name(variable.name);
    bytes.count(variable.dimensions.size());
    for (const std::size_t dimension : variable.dimensions) bytes.count(dimension);
    bytes.attributes(variable.attributes);
    bytes.u32(static_cast<std::uint32_t>(variable.type));
    bytes.count(netcdf_padded(size_of_record(variable)));
    bytes.offset(begins[v]);
  }
  return bytes.take();
}

// A dimension of length 0 is that of records: there is one at most, and variables begin with it.
void NetcdfWriter::require_records() const {
  const NetcdfDimension* records = nullptr;
  for (const NetcdfDimension& dimension : dimensions_) {
    if (dimension.size != 0) continue;
    if (records != nullptr) {
      throw BadValue("dimensions " + in_quotes(records->name) + " and " +
                     in_quotes(dimension.name) +
                     " have length 0, of which classic netCDF holds one; netCDF-4 can");
    }
    records = &dimension;
  }
  for (const NetcdfVariable& variable : variables_) {
    for (std::size_t k = 1; k < variable.dimensions.size(); ++k) {
      if (dimensions_[variable.dimensions[k]].size != 0) continue;
      throw BadValue("dimension " + in_quotes(records->name) + " has length 0, but variable " +
                     in_quotes(variable.name) +
                     " does not begin with it, as it does in classic netCDF; netCDF-4 can");
    }
  }
}

void NetcdfWriter::begin(int version) {
  require_records();
  choose_records();
  const int needed = needed_version();
  if (version == 0) version = needed;
  if (version < needed) {
    throw BadValue("CDF-" + std::to_string(version) +
                   " cannot hold it, as a dimension or a variable is too large; CDF-" +
                   std::to_string(needed) + " can");
  }
  const std::uint64_t size = header(version, 0).size();
  expected_ = size;
  for (const NetcdfVariable& variable : variables_) {
    expected_ += netcdf_padded(size_of_values(variable));
  }
  file_.write(header(version, size));
  if (records_ != no_dimension) {
    places_ = offsets(size);
    end_ = size + size_of_records() * dimensions_[records_].size;
    for (const NetcdfVariable& variable : variables_) {
      if (!is_of_records(variable)) end_ += netcdf_padded(size_of_values(variable));
    }
    expected_ = end_;
  }
  end_full_variables();
}

void NetcdfWriter::begin(const NetcdfOptions& options, unsigned threads) {
  switch (options.kind) {
    case NetcdfKind::by_name:
      begin(0);
      break;
    case NetcdfKind::cdf2:
      begin(2);
      break;
    case NetcdfKind::cdf5:
      begin(5);
      break;
    case NetcdfKind::netcdf4:
      netcdf4_ = std::make_unique<Netcdf4Output>(
          file_, Netcdf4Definitions{dimensions_, attributes_, variables_}, options.deflate,
          threads);
      end_full_variables();
      break;
  }
}

void NetcdfWriter::write_netcdf4(const void* values, std::size_t num_bytes) {
  assert(current_ < variables_.size() &&
         num_written_ + num_bytes <= size_of_values(variables_[current_]));
  const std::size_t size = size_of(variables_[current_].type);
  netcdf4_->write(current_, num_written_ / size, num_bytes / size, values);
  count_bytes(num_bytes);
}

void NetcdfWriter::find_room() {
  const std::uint64_t size = std::exchange(expected_, 0);
  if (size >= large_file) file_.expect(size);
}

void NetcdfWriter::write_bytes(std::string_view bytes) {
  assert(current_ < variables_.size() &&
         num_written_ + bytes.size() <= size_of_values(variables_[current_]));
  if (records_ != no_dimension) {
    write_records(bytes);
    return;
  }
  file_.write(bytes);
  count_bytes(bytes.size());
}

void NetcdfWriter::write_records(std::string_view bytes) {
  const NetcdfVariable& variable = variables_[current_];
  const std::uint64_t begin = places_[current_];
  std::uint64_t written = num_written_;
  const std::uint64_t whole =
      is_of_records(variable) ? size_of_record(variable) : size_of_values(variable);
  const std::uint64_t step = is_of_records(variable) ? size_of_records() : whole;
  find_room();
  for (std::string_view rest = bytes; !rest.empty();) {
    const std::uint64_t in_record = written % whole;
    const std::size_t count = std::min<std::uint64_t>(rest.size(), whole - in_record);
    file_.write_at(begin + written / whole * step + in_record, rest.substr(0, count));
    written += count;
    rest.remove_prefix(count);
  }
  count_bytes(bytes.size());
}

void NetcdfWriter::count_bytes(std::uint64_t size) {
  num_written_ += size;
  end_full_variables();
}

void NetcdfWriter::end_full_variables() {
  constexpr std::string_view zeros("\0\0\0", 3);
  while (current_ < variables_.size() && num_written_ == size_of_values(variables_[current_])) {
    if (netcdf4_ == nullptr && records_ == no_dimension) {
      file_.write(zeros.substr(0, netcdf_padded(num_written_) - num_written_));
    }
    num_written_ = 0;
    ++current_;
  }
}

void NetcdfWriter::finish() {
  assert(current_ == variables_.size());
  // Padding at the end, where nothing was written.
  if (records_ != no_dimension && end_ > 0) file_.extend(end_);
  if (netcdf4_ != nullptr) netcdf4_->finish();
}

}  // namespace rondel::io
