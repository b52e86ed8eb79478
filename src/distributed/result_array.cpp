// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "distributed/result_array.h"

#include <optional>
#include <vector>

#include "io/npy_header.h"

namespace rondel::distributed {
namespace {

class NpyResult final : public ResultArray {
 public:
  explicit NpyResult(const std::string& path) : file_(path) {}

  void reserve(std::uint64_t num_bytes) override {
    constexpr std::uint64_t header = 128;
    file_.reserve(header + num_bytes);
  }
  void begin(const NumberType& type, const ArrayShape& shape) override {
    std::vector<std::uint64_t> sizes = {shape.num_rows};
    if (shape.num_columns != 0) sizes.push_back(shape.num_columns);
    file_.write(io::make_npy_header(type.npy, sizes));
  }
  void write(std::string_view bytes) override { file_.write(bytes); }
  void commit() override { file_.commit(); }

 private:
  io::AtomicFile file_;
};

class ZarrResult final : public ResultArray {
 public:
  ZarrResult(io::ZarrGroup& group, MakeHead head) : group_(group), head_(head) {}

  void reserve(std::uint64_t num_bytes) override { group_.reserve(num_bytes); }
  void begin(const NumberType& type, const ArrayShape& shape) override {
    array_.emplace(group_, head_(type.zarr, shape.num_rows));
  }
  void write(std::string_view bytes) override { array_->write(bytes); }
  void commit() override { array_->finish(); }

 private:
  io::ZarrGroup& group_;
  MakeHead head_;
  std::optional<io::ZarrArray> array_;
};

}  // namespace

std::unique_ptr<ResultArray> make_result(const std::string& path) {
  return std::make_unique<NpyResult>(path);
}

std::unique_ptr<ResultArray> make_result(io::ZarrGroup& group, MakeHead head) {
  return std::make_unique<ZarrResult>(group, head);
}

}  // namespace rondel::distributed
