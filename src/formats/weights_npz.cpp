// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Weights as scipy.sparse.save_npz() stores a matrix in compressed sparse rows (CSR): a ZIP archive
// with the arrays `data`, `indices` (columns from 0), `indptr` (offsets of rows), `shape` (targets,
// sources) and the text `format`.
#include <array>
#include <limits>
#include <optional>

#include "formats/weight_formats.h"
#include "io/bad_value.h"
#include "io/binary.h"
#include "io/npy_header.h"
#include "io/number.h"
#include "io/zip_file.h"
#include "io/zip_reader.h"
#include "system/checked_product.h"

namespace rondel::formats {
namespace {

// A member of the archive that is an array of one dimension.
class NpzArray {
 public:
  // Reads the member `name`.npy. Throws BadValue unless its size is that of one dimension of
  // numbers.
  NpzArray(std::string_view archive, const std::string& name)
      : name_(name), bytes_(io::zip_member(archive, name + ".npy")) {
    header_ = io::parse_npy_header(bytes_);
    const std::string_view dtype = header_.dtype;
    if (dtype.size() != 3 || dtype[0] == '=' || header_.shape.size() != 1) refuse();
    const auto item = static_cast<std::uint64_t>(dtype[2] - '0');
    std::uint64_t needed = 0;
    if (item < 1 || item > 8 || !system::multiply_checked(header_.shape[0], item, needed) ||
        needed != bytes_.size() - header_.data_offset) {
      refuse();
    }
    order_ = dtype[0] == '>' ? std::endian::big : std::endian::little;
  }

  // Returns the numbers, doubles, floats or integers, converted to Out.
  template <typename Out>
  [[nodiscard]] std::vector<Out> values() const {
    const std::string_view type = std::string_view(header_.dtype).substr(1);
    if (type == "f8") return copied<double, Out>();
    if (type == "f4") return copied<float, Out>();
    return integers<Out>(type);
  }
  // Returns the numbers converted to Out. Throws BadValue for other types than integers of 32 and
  // 64 bits.
  template <typename Out>
  [[nodiscard]] std::vector<Out> integers() const {
    return integers<Out>(std::string_view(header_.dtype).substr(1));
  }

 private:
  // Throws BadValue with the type and the shape of the array.
  [[noreturn]] void refuse() const {
    throw io::BadValue(io::in_quotes(name_) + " is an array " + io::in_quotes(header_.dtype) +
                       " of shape " + io::shape_text(header_.shape) +
                       " where another one is needed");
  }
  template <typename Out>
  [[nodiscard]] std::vector<Out> integers(std::string_view type) const {
    if (type == "i4") return copied<std::int32_t, Out>();
    if (type == "i8") return copied<std::int64_t, Out>();
    if (type == "u4") return copied<std::uint32_t, Out>();
    if (type == "u8") return copied<std::uint64_t, Out>();
    refuse();
  }
  template <typename T, typename Out>
  [[nodiscard]] std::vector<Out> copied() const {
    std::vector<Out> out(header_.shape[0]);
    const char* data = bytes_.data() + header_.data_offset;
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i] = static_cast<Out>(io::load<T>(data + i * sizeof(T), order_));
    }
    return out;
  }

  std::string name_;
  std::string bytes_;
  io::NpyHeader header_;
  std::endian order_ = std::endian::little;
};

// Returns a text that is stored as bytes or, by old versions of SciPy, in four bytes a letter.
std::string text_of_member(std::string_view archive, std::string_view name) {
  const std::string bytes = io::zip_member(archive, name);
  const io::NpyHeader header = io::parse_npy_header(bytes);
  std::string text;
  for (const char c : std::string_view(bytes).substr(header.data_offset)) {
    if (c != '\0') text += c;
  }
  return text;
}

// Throws BadValue for matrices that SciPy stores in other formats.
void require_csr(std::string_view archive) {
  const std::string format = text_of_member(archive, "format.npy");
  if (format != "csr") {
    throw io::BadValue("a matrix in the format " + io::in_quotes(format) +
                       " where \"csr\" is needed");
  }
}

// Adds what this library stores beside a matrix, which SciPy ignores. Without it, weights that
// cover a part of a target could not be told from wrong ones.
void add_facts(io::ZipWriter& zip, const WeightFile& content) {
  const auto add_text = [&](const char* name, const std::string& text) {
    if (text.empty()) return;
    zip.add(name, io::make_npy_header("|S" + std::to_string(text.size()), {}), text);
  };
  add_text("method.npy", content.method);
  add_text("normalization.npy", content.normalization);
  const std::vector<double>& fractions = content.target.fractions;
  if (fractions.empty()) return;
  const std::array<std::uint64_t, 1> shape = {fractions.size()};
  zip.add("fractions.npy", io::make_npy_header("<f8", shape), io::NumberBytes(fractions));
}

// Reads the members of add_facts() that are there. Throws BadValue unless there is a fraction for
// each row.
void read_facts(std::string_view archive, WeightFile& content) {
  const auto text = [&](std::string_view name) {
    return io::has_zip_member(archive, name) ? text_of_member(archive, name) : std::string();
  };
  content.method = text("method.npy");
  content.normalization = text("normalization.npy");
  if (!io::has_zip_member(archive, "fractions.npy")) return;
  content.target.fractions = NpzArray(archive, "fractions").values<double>();
  if (content.target.fractions.size() != content.weights.num_rows()) {
    throw io::BadValue("\"fractions\" has " + std::to_string(content.target.fractions.size()) +
                       " values for " + std::to_string(content.weights.num_rows()) + " rows");
  }
}

}  // namespace

void write_weights_npz(io::AtomicFile& file, const WeightsToWrite& job) {
  const WeightFile& content = job.content;
  const Weights& weights = content.weights;
  io::ZipWriter zip(file);
  const auto add = [&](const char* name, const char* dtype, std::span<const std::uint64_t> shape,
                       std::string_view bytes) {
    zip.add(name, io::make_npy_header(dtype, shape), bytes);
  };
  const auto length = [](const auto& values) {
    return std::array<std::uint64_t, 1>{values.size()};
  };
  // SciPy computes with signed indices of one width.
  const std::vector<std::int64_t> columns(weights.columns.begin(), weights.columns.end());
  const std::vector<std::int64_t> offsets(weights.offsets.begin(), weights.offsets.end());
  const std::array<std::int64_t, 2> shape = {static_cast<std::int64_t>(weights.num_rows()),
                                             static_cast<std::int64_t>(weights.num_columns)};
  add("indices.npy", "<i8", length(columns), io::NumberBytes(columns));
  add("indptr.npy", "<i8", length(offsets), io::NumberBytes(offsets));
  add("format.npy", "|S3", {}, "csr");
  add("shape.npy", "<i8", length(shape), io::NumberBytes(shape));
  add("data.npy", "<f8", length(weights.values), io::NumberBytes(weights.values));
  add_facts(zip, content);
  zip.finish();
}

WeightFile read_weights_npz(std::string_view bytes) {
  require_csr(bytes);
  const auto shape = NpzArray(bytes, "shape").integers<std::int64_t>();
  const auto offsets = NpzArray(bytes, "indptr").integers<std::int64_t>();
  const auto columns = NpzArray(bytes, "indices").integers<std::int64_t>();
  WeightFile content;
  Weights& weights = content.weights;
  weights.values = NpzArray(bytes, "data").values<double>();
  if (shape.size() != 2 || shape[0] < 0 || shape[1] < 0 || shape[1] > no_index || offsets.empty() ||
      offsets.size() - 1 != static_cast<std::uint64_t>(shape[0])) {
    throw io::BadValue(R"("shape" and "indptr" do not fit together)");
  }
  if (columns.size() != weights.values.size()) {
    throw io::BadValue(R"("indices" and "data" do not fit together)");
  }
  weights.num_columns = static_cast<std::size_t>(shape[1]);
  weights.offsets.assign(offsets.begin(), offsets.end());
  // Offsets begin with 0, never decrease, and end with the number of entries.
  for (std::size_t r = 0; r < offsets.size(); ++r) {
    const std::int64_t before = r == 0 ? 0 : offsets[r - 1];
    const bool is_last = r + 1 == offsets.size();
    const auto end = static_cast<std::int64_t>(columns.size());
    if (offsets[r] < before || (r == 0 && offsets[r] != 0) || (is_last && offsets[r] != end)) {
      throw io::BadValue("\"indptr\" is wrong at " + std::to_string(r));
    }
  }
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (columns[k] < 0 || columns[k] >= shape[1]) {
      throw io::BadValue("entry " + std::to_string(k) + ": column " + std::to_string(columns[k]) +
                         " of " + std::to_string(shape[1]));
    }
    weights.columns.push_back(static_cast<Index>(columns[k]));
  }
  read_facts(bytes, content);
  return content;
}

}  // namespace rondel::formats
