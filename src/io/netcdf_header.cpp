// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/netcdf_header.h"

#include <bit>

#include "io/bad_value.h"
#include "io/binary.h"
#include "io/number.h"

namespace rondel::io {
namespace {

// Reads the header's fields one after the other. Refuses a count if the bytes cannot hold as many
// members.
class HeaderFields {
 public:
  HeaderFields(std::string_view bytes, int version) : rest_(bytes), version_(version) {}

  std::uint32_t u32() { return next<std::uint32_t>(); }
  // A count has 64 bits in CDF-5; an offset has them in CDF-2, too.
  std::uint64_t count() { return version_ == 5 ? next<std::uint64_t>() : u32(); }
  std::uint64_t offset() { return version_ == 1 ? u32() : next<std::uint64_t>(); }

  // Returns a count of members of at least `least` bytes.
  std::size_t count_of(std::size_t least) {
    const std::uint64_t number = count();
    if (number > rest_.size() / least) {
      throw BadValue("the header counts " + std::to_string(number) + ", but has only " +
                     std::to_string(rest_.size()) + " bytes left");
    }
    return static_cast<std::size_t>(number);
  }
  std::string name() { return std::string(take(count_of(1))); }
  // Returns the next `size` bytes, and skips the padding behind them.
  std::string_view take(std::size_t size) {
    const std::uint64_t padded = netcdf_padded(size);
    if (padded > rest_.size()) throw BadValue("the header is cut off");
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(padded);
    return taken;
  }
  // Returns the length of a list whose members have at least `least` bytes.
  std::size_t list(std::uint32_t tag, std::size_t least) {
    const std::uint32_t found = u32();
    const std::size_t size = count_of(least);
    if (found != tag && (found != 0 || size != 0)) throw BadValue("the header is damaged");
    return size;
  }
  NetcdfType type() {
    const auto type = static_cast<NetcdfType>(u32());
    if (size_of(type) == 0) {
      throw BadValue("the header has a type " + std::to_string(static_cast<std::uint32_t>(type)));
    }
    return type;
  }

 private:
  template <typename T>
  T next() {
    if (rest_.size() < sizeof(T)) throw BadValue("the header is cut off");
    const T value = load<T>(rest_.data(), std::endian::big);
    rest_.remove_prefix(sizeof(T));
    return value;
  }

  std::string_view rest_;
  int version_;
};

// Returns the number of this type at an address, as a double.
double number_at(const char* at, NetcdfType type) {
  constexpr auto big = std::endian::big;
  switch (type) {
    case NetcdfType::int8:
      return load<std::int8_t>(at, big);
    case NetcdfType::int16:
      return load<std::int16_t>(at, big);
    case NetcdfType::int32:
      return load<std::int32_t>(at, big);
    case NetcdfType::float32:
      return load<float>(at, big);
    case NetcdfType::float64:
      return load<double>(at, big);
    case NetcdfType::uint16:
      return load<std::uint16_t>(at, big);
    case NetcdfType::uint32:
      return load<std::uint32_t>(at, big);
    case NetcdfType::int64:
      return static_cast<double>(load<std::int64_t>(at, big));
    case NetcdfType::uint64:
      return static_cast<double>(load<std::uint64_t>(at, big));
    case NetcdfType::text:
    case NetcdfType::uint8:
      break;
  }
  return load<std::uint8_t>(at, big);
}

// Reads a list of attributes.
std::vector<NetcdfAttribute> attributes_of(HeaderFields& fields) {
  // A member has a name of at least no bytes, a type and a count.
  std::vector<NetcdfAttribute> attributes(fields.list(netcdf_attributes_tag, 12));
  for (NetcdfAttribute& attribute : attributes) {
    attribute.name = fields.name();
    attribute.type = fields.type();
    const std::size_t size = size_of(attribute.type);
    const std::size_t count = fields.count_of(size);
    const std::string_view bytes = fields.take(count * size);
    if (attribute.type == NetcdfType::text) {
      attribute.text = bytes.substr(0, bytes.find('\0'));
      continue;
    }
    for (std::size_t i = 0; i < count; ++i) {
      attribute.numbers.push_back(number_at(bytes.data() + i * size, attribute.type));
      if (attribute.type == NetcdfType::int64 || attribute.type == NetcdfType::uint64) {
        attribute.integers.push_back(load<std::int64_t>(bytes.data() + i * size, std::endian::big));
      }
    }
  }
  return attributes;
}

// Reads the name, dimensions, attributes, type and offset of a variable.
void read_variable(HeaderFields& fields, std::size_t num_dimensions, VariableInFile& variable) {
  variable.name = fields.name();
  variable.dimensions.resize(fields.count_of(4));
  for (std::size_t& dimension : variable.dimensions) {
    const std::uint64_t number = fields.count();
    if (number >= num_dimensions) {
      throw BadValue("variable " + in_quotes(variable.name) + " has a dimension " +
                     std::to_string(number) + " of " + std::to_string(num_dimensions));
    }
    dimension = static_cast<std::size_t>(number);
  }
  variable.attributes = attributes_of(fields);
  variable.type = fields.type();
  fields.count();  // skips its size, which follows from the rest and is not correct if it is large
  variable.offset = fields.offset();
}

// Returns the number of the classic format: 1, 2 or 5. Throws BadValue for other files.
int version_of(std::string_view bytes) {
  if (!bytes.starts_with("CDF")) throw BadValue("not a netCDF file");
  const int version = bytes.size() > 3 ? bytes[3] : 0;
  if (version != 1 && version != 2 && version != 5) {
    throw BadValue("not one of netCDF's classic formats (CDF-1, CDF-2, CDF-5)");
  }
  return version;
}

}  // namespace

NetcdfHeader parse_netcdf_header(std::string_view bytes) {
  NetcdfHeader header;
  header.version = version_of(bytes);
  HeaderFields fields(bytes.substr(4), header.version);
  header.num_records = fields.count();
  const std::uint64_t unknown = header.version == 5 ? ~std::uint64_t{0} : 0xffff'ffff;
  header.counts_records = header.num_records != unknown;
  header.dimensions.resize(fields.list(netcdf_dimensions_tag, 8));
  for (NetcdfDimension& dimension : header.dimensions) {
    dimension.name = fields.name();
    dimension.size = fields.count();
  }
  header.attributes = attributes_of(fields);
  // A member has at least an empty name, no dimensions, no attributes, a type, a size and an
  // offset.
  header.variables.resize(fields.list(netcdf_variables_tag, 28));
  for (VariableInFile& variable : header.variables) {
    read_variable(fields, header.dimensions.size(), variable);
  }
  return header;
}

}  // namespace rondel::io
