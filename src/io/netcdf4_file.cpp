// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/netcdf4_file.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <mutex>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/array_rows.h"
#include "io/bad_value.h"
#include "io/hdf5_library.h"
#include "io/netcdf_groups.h"
#include "io/netcdf_slabs.h"
#include "io/number.h"
#include "system/checked_product.h"

namespace rondel::io {
namespace {

using NetcdfLock = std::lock_guard<system::Mutex>;
using NetcdfName = std::array<char, netcdf_largest_name + 1>;

constexpr std::string_view hdf5_signature = "\x89HDF\r\n\x1a\n";

// A longer attribute is damaged, or is not one that readers of fields and meshes need.
constexpr std::size_t longest_attribute = std::size_t{1} << 24U;

// Returns the number of the file that `open` opens; throws BadValue with the reason if it fails.
template <class Open>
int opened(const NetcdfLibrary& library, const std::string& path, const Open& open) {
  const NetcdfLock lock(netcdf_library_lock());
  int number = 0;
  const int error = open(number);
  if (error == 0) return number;
  const char* const why = path.find('\\') == std::string::npos
                              ? "it is damaged, no netCDF-4, or locked by another program"
                              : "its name has a backslash";
  throw BadValue(std::string("netCDF-C cannot open it, maybe since ") + why +
                 "; it says: " + library.error_text(error));
}

// Reads the header of a file, group by group. Dimensions, variables and attributes that cannot be
// read are left out.
class Netcdf4Header {
 public:
  explicit Netcdf4Header(const NetcdfLibrary& library) : library_(library) {}

  // Adds the definitions of a group and of those in it; `prefix` is the group's name with a slash.
  void add_group(int group, const std::string& prefix) {
    int num_dimensions = 0;
    int num_variables = 0;
    int num_attributes = 0;
    int unlimited = 0;
    require_netcdf(library_, library_.inquire(group, &num_dimensions, &num_variables,
                                              &num_attributes, &unlimited));
    add_dimensions(group, prefix);
    if (prefix.empty()) {
      header_.attributes = attributes_of(group, netcdf_whole_file, num_attributes);
    }
    for (int number = 0; number < num_variables; ++number) add_variable(group, number, prefix);
    int num_groups = 0;
    require_netcdf(library_, library_.group_ids(group, &num_groups, nullptr));
    std::vector<int> groups(static_cast<std::size_t>(num_groups));
    if (num_groups > 0) require_netcdf(library_, library_.group_ids(group, nullptr, groups.data()));
    for (const int inner : groups) {
      NetcdfName name{};
      if (library_.group_name(inner, name.data()) != 0) continue;
      add_group(inner, prefix + name.data() + '/');
    }
  }

  NetcdfHeader take() { return std::move(header_); }

 private:
  void add_dimensions(int group, const std::string& prefix) {
    int count = 0;
    require_netcdf(library_, library_.dimension_ids(group, &count, nullptr, 0));
    std::vector<int> numbers(static_cast<std::size_t>(count));
    if (count > 0) {
      require_netcdf(library_, library_.dimension_ids(group, nullptr, numbers.data(), 0));
    }
    const std::vector<int> unlimited = unlimited_dimensions(group);
    for (const int number : numbers) {
      NetcdfName name{};
      std::size_t size = 0;
      require_netcdf(library_, library_.dimension(group, number, name.data(), &size));
      numbers_.push_back(number);
      const bool is_unlimited = std::ranges::count(unlimited, number) != 0;
      header_.dimensions.push_back({prefix + name.data(), size, is_unlimited});
    }
  }

  // Returns the numbers of the dimensions that may grow; none if the library does not say it.
  [[nodiscard]] std::vector<int> unlimited_dimensions(int group) const {
    int count = 0;
    if (library_.unlimited_ids(group, &count, nullptr) != 0 || count <= 0) return {};
    std::vector<int> numbers(static_cast<std::size_t>(count));
    if (library_.unlimited_ids(group, nullptr, numbers.data()) != 0) return {};
    return numbers;
  }

  void add_variable(int group, int number, const std::string& prefix) {
    NetcdfName name{};
    int type = 0;
    int rank = 0;
    int num_attributes = 0;
    std::vector<int> dimensions(netcdf_most_dimensions);
    if (library_.variable(group, number, name.data(), &type, &rank, dimensions.data(),
                          &num_attributes) != 0) {
      return;
    }
    if (type <= 0 || type > netcdf_string_type) {
      header_.passed_over.push_back(prefix + name.data());
      return;
    }
    VariableInFile variable;
    variable.name = prefix + name.data();
    variable.type = type == netcdf_string_type ? NetcdfType::text : static_cast<NetcdfType>(type);
    variable.has_strings = type == netcdf_string_type;
    variable.group = group;
    variable.number = number;
    variable.num_values = 1;
    for (int d = 0; d < rank; ++d) {
      const auto at = std::ranges::find(numbers_, dimensions[static_cast<std::size_t>(d)]);
      if (at == numbers_.end()) return;
      variable.dimensions.push_back(static_cast<std::size_t>(at - numbers_.begin()));
      const std::uint64_t size = header_.dimensions[variable.dimensions.back()].size;
      variable.shape.push_back(size);
      if (!system::multiply_checked(variable.num_values, size, variable.num_values)) return;
    }
    std::uint64_t num_bytes = 0;
    if (!system::multiply_checked(variable.num_values, sizeof(double), num_bytes)) return;
    variable.record_values = variable.num_values;
    variable.attributes = attributes_of(group, number, num_attributes);
    header_.variables.push_back(std::move(variable));
  }

  std::vector<NetcdfAttribute> attributes_of(int group, int variable, int count) {
    std::vector<NetcdfAttribute> attributes;
    for (int i = 0; i < count; ++i) {
      NetcdfName name{};
      int type = 0;
      std::size_t size = 0;
      if (library_.attribute_name(group, variable, i, name.data()) != 0 ||
          library_.attribute(group, variable, name.data(), &type, &size) != 0 ||
          size > longest_attribute) {
        continue;
      }
      NetcdfAttribute attribute{name.data(), NetcdfType::text, {}, {}};
      if (read_attribute(group, variable, type, size, attribute)) {
        attributes.push_back(std::move(attribute));
      }
    }
    return attributes;
  }

  // Reads an attribute; returns false if it is of a type that is not read.
  bool read_attribute(int group, int variable, int type, std::size_t size,
                      NetcdfAttribute& attribute) {
    const char* const name = attribute.name.c_str();
    if (type == netcdf_string_type) return read_strings(group, variable, size, attribute);
    if (type == static_cast<int>(NetcdfType::text)) {
      attribute.text.resize(size);
      if (library_.attribute_text(group, variable, name, attribute.text.data()) != 0) return false;
      attribute.text.resize(std::min(size, attribute.text.find('\0')));
      return true;
    }
    if (type <= 0 || type > netcdf_string_type) return false;
    attribute.type = static_cast<NetcdfType>(type);
    attribute.numbers.resize(size);
    if (attribute.type == NetcdfType::int64 || attribute.type == NetcdfType::uint64) {
      attribute.integers.resize(size);
      std::int64_t* const at = attribute.integers.data();
      const int error =
          attribute.type == NetcdfType::int64
              ? library_.attribute_integers(group, variable, name, reinterpret_cast<long long*>(at))
              : library_.attribute_naturals(group, variable, name,
                                            reinterpret_cast<unsigned long long*>(at));
      if (error != 0) return false;
    }
    return library_.attribute_numbers(group, variable, name, attribute.numbers.data()) == 0;
  }

  // Reads an attribute of strings, which become the words of one text.
  bool read_strings(int group, int variable, std::size_t size, NetcdfAttribute& attribute) {
    std::vector<char*> strings(size, nullptr);
    if (library_.attribute_strings(group, variable, attribute.name.c_str(), strings.data()) != 0) {
      return false;
    }
    for (std::size_t i = 0; i < size; ++i) {
      if (i > 0) attribute.text += ' ';
      if (strings[i] != nullptr) attribute.text += strings[i];
    }
    library_.free_strings(size, strings.data());
    return true;
  }

  const NetcdfLibrary& library_;
  NetcdfHeader header_;
  std::vector<int> numbers_;  // by dimension: the number that netCDF-C has for it
};

// Returns the number that stands for values that were never written.
template <class T>
T fill_of(const VariableInFile& variable) {
  const NetcdfAttribute* const fill = find_attribute(variable.attributes, "_FillValue");
  if constexpr (std::is_same_v<T, double>) {
    const bool is_given = fill != nullptr && !fill->numbers.empty();
    return is_given ? fill->numbers.front() : default_fill(variable.type);
  } else if constexpr (std::is_same_v<T, std::int64_t>) {
    if (fill != nullptr && !fill->integers.empty()) return fill->integers.front();
    if (variable.type == NetcdfType::int64) return default_fill_of_int64;
    if (variable.type == NetcdfType::uint64) return static_cast<T>(default_fill_of_uint64);
    return static_cast<T>(fill_of<double>(variable));
  } else {
    return {};  // texts
  }
}

// Returns the lengths of the array in the file, of which dimensions that are not read have 1.
std::vector<std::uint64_t> lengths_in_file(const VariableInFile& variable) {
  std::vector<std::uint64_t> lengths(variable.num_fixed, 1);
  lengths.insert(lengths.end(), variable.shape.begin(), variable.shape.end());
  return lengths;
}

// Reads a box by read(start, count, values). What goes beyond the array in the file is filled: there
// netCDF-C takes values of other places where several dimensions are short.
template <class T, class Read>
void read_stored(const VariableInFile& variable, const std::vector<std::size_t>& start,
                 const std::vector<std::size_t>& count, std::span<T> out, const Read& read) {
  std::vector<std::size_t> there = count;
  std::size_t size = 1;
  for (std::size_t d = 0; d < variable.stored.size(); ++d) {
    const std::uint64_t left =
        variable.stored[d] - std::min<std::uint64_t>(start[d], variable.stored[d]);
    there[d] = static_cast<std::size_t>(std::min<std::uint64_t>(count[d], left));
    size *= there[d];
  }
  if (there == count) {
    read(start, count, out.data());
    return;
  }
  std::ranges::fill(out, fill_of<T>(variable));
  if (size == 0) return;
  std::vector<T> values(size);
  read(start, there, values.data());
  const BoxLengths order = own_order(count.size());
  for_each_row(there, order, steps_of(there), steps_of(count),
               [&](std::size_t from, std::size_t to) {
                 std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(from), there.back(),
                             out.begin() + static_cast<std::ptrdiff_t>(to));
               });
}

}  // namespace

bool has_hdf5_at_begin(std::string_view head) { return head.starts_with(hdf5_signature); }

bool is_hdf5(std::string_view head) {
  if (has_hdf5_at_begin(head)) return true;
  for (std::size_t at = 512; at < head.size(); at *= 2) {
    if (head.substr(at).starts_with(hdf5_signature)) return true;
  }
  return false;
}

// The path is made absolute, so that it is never taken for an address in a network.
Netcdf4File::Netcdf4File(const std::string& path)
    : library_(netcdf_library()), path_(std::filesystem::absolute(path).string()) {
  number_ = opened(library_, path_,
                   [&](int& number) { return library_.open(path_.c_str(), 0, &number); });
}

Netcdf4File::Netcdf4File(std::string_view bytes) : library_(netcdf_library()) {
  number_ = opened(library_, path_, [&](int& number) {
    // The file is opened for reading, so that the bytes are not changed.
    return library_.open_memory("memory", 0, bytes.size(), const_cast<char*>(bytes.data()),
                                &number);
  });
}

Netcdf4File::~Netcdf4File() {
  const NetcdfLock lock(netcdf_library_lock());
  library_.close(number_);
}

NetcdfHeader Netcdf4File::header() const {
  const NetcdfLock lock(netcdf_library_lock());
  Netcdf4Header reader(library_);
  reader.add_group(number_, {});
  NetcdfHeader header = reader.take();
  resolve_names(header);
  take_stored_lengths(header);
  return header;
}

void Netcdf4File::take_stored_lengths(NetcdfHeader& header) const {
  const Hdf5Library* const hdf5 = path_.empty() ? nullptr : hdf5_library();
  if (hdf5 == nullptr) return;
  for (VariableInFile& variable : header.variables) {
    const bool may_be_short = std::ranges::any_of(
        variable.dimensions, [&](std::size_t d) { return header.dimensions[d].is_unlimited; });
    if (!may_be_short) continue;
    const Hdf5Object array(open_hdf5_array(*hdf5, path_, variable.name), hdf5->close_array);
    if (!array.is_open()) continue;
    std::vector<std::uint64_t> lengths = lengths_of(*hdf5, array.id());
    if (lengths.size() == variable.shape.size() && lengths != variable.shape) {
      variable.stored = std::move(lengths);
    }
  }
}

void Netcdf4File::read(const VariableInFile& variable, std::uint64_t begin,
                       std::span<double> out) const {
  for_each_slab(lengths_in_file(variable), begin, out.size(),
                [&](const auto& start, const auto& count, std::size_t offset, std::size_t size) {
                  read_box(variable, {start, count}, out.subspan(offset, size));
                });
}

void Netcdf4File::read_box(const VariableInFile& variable, const NetcdfBox& box,
                           std::span<double> out) const {
  const NetcdfLock lock(netcdf_library_lock());
  read_stored(variable, box.start, box.count, out,
              [&](const auto& start, const auto& count, double* values) {
                require_netcdf(library_, library_.read_doubles(variable.group, variable.number,
                                                               start.data(), count.data(), values));
              });
}

void Netcdf4File::take_chunk(const VariableInFile& variable,
                             std::span<std::uint64_t> lengths) const {
  const NetcdfLock lock(netcdf_library_lock());
  int storage = 0;
  std::vector<std::size_t> chunk(lengths.size(), 1);
  const int error = library_.chunks(variable.group, variable.number, &storage, chunk.data());
  if (error != 0 || storage != netcdf_in_chunks) return;
  for (std::size_t d = 0; d < lengths.size(); ++d) lengths[d] = std::max<std::size_t>(chunk[d], 1);
}

const Hdf5Chunks* Netcdf4File::chunks(const VariableInFile& variable) const {
  if (path_.empty()) return nullptr;
  const NetcdfLock lock(netcdf_library_lock());
  const auto [at, is_new] = chunks_.try_emplace({variable.group, variable.number});
  if (is_new) at->second = Hdf5Chunks::find(path_, variable, memory_);
  return at->second.get();
}

void Netcdf4File::read(const VariableInFile& variable, std::uint64_t begin,
                       std::span<std::int64_t> out) const {
  for_each_slab(lengths_in_file(variable), begin, out.size(),
                [&](const auto& start, const auto& count, std::size_t offset, std::size_t size) {
                  read_box(variable, {start, count}, out.subspan(offset, size));
                });
}

void Netcdf4File::read_box(const VariableInFile& variable, const NetcdfBox& box,
                           std::span<std::int64_t> out) const {
  static_assert(sizeof(long long) == sizeof(std::int64_t));
  const bool is_natural = variable.type == NetcdfType::uint64;
  const NetcdfLock lock(netcdf_library_lock());
  const auto read = [&](const auto& start, const auto& count, std::int64_t* values) {
    require_netcdf(
        library_,
        is_natural
            ? library_.read_naturals(variable.group, variable.number, start.data(), count.data(),
                                     reinterpret_cast<unsigned long long*>(values))
            : library_.read_integers(variable.group, variable.number, start.data(), count.data(),
                                     reinterpret_cast<long long*>(values)));
  };
  read_stored(variable, box.start, box.count, out, read);
}

void Netcdf4File::read(const VariableInFile& variable, std::string& out) const {
  const NetcdfLock lock(netcdf_library_lock());
  const auto read = [&](const auto& start, const auto& count, char* text) {
    require_netcdf(library_, library_.read_text(variable.group, variable.number, start.data(),
                                                count.data(), text));
  };
  for_each_slab(lengths_in_file(variable), 0, out.size(),
                [&](const auto& start, const auto& count, std::size_t offset, std::size_t size) {
                  read_stored(variable, start, count, std::span(out).subspan(offset, size), read);
                });
}

std::vector<std::string> Netcdf4File::strings(const VariableInFile& variable) const {
  std::vector<std::string> result(variable.num_values);
  const NetcdfLock lock(netcdf_library_lock());
  std::vector<char*> found(result.size(), nullptr);
  int error = 0;
  const auto read = [&](const auto& start, const auto& count, char** strings) {
    error =
        library_.read_strings(variable.group, variable.number, start.data(), count.data(), strings);
  };
  for_each_slab(lengths_in_file(variable), 0, found.size(),
                [&](const auto& start, const auto& count, std::size_t offset, std::size_t size) {
                  if (error != 0) return;
                  read_stored(variable, start, count, std::span(found).subspan(offset, size), read);
                });
  for (std::size_t i = 0; i < found.size() && error == 0; ++i) {
    if (found[i] != nullptr) result[i] = found[i];
  }
  library_.free_strings(found.size(), found.data());
  require_netcdf(library_, error);
  return result;
}

}  // namespace rondel::io
