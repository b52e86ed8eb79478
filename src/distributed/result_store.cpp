// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Two files: one has a slot for each bucket, as large as its number of sites may need, with
// duplicates, rows, faces, neighbors and points; borders, whose size is known only when a bucket is
// triangulated, are appended to the other one.

#include "distributed/result_store.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <utility>

#include "distributed/checksum.h"

namespace rondel::distributed {
namespace {

template <class T>
std::uint64_t checksum_of(std::span<const T> values) {
  Checksum sum;
  sum.add(values);
  return sum.value();
}

// Reads values at a place of a file.
template <class Values>
Values values_at(const ScratchFile& file, std::uint64_t place, std::uint64_t size) {
  Values values(size);
  file.read(place, std::span(values));
  return values;
}

// Returns a sum that does not depend on the order of the duplicates, so that they may be added in
// pieces.
std::uint64_t sum_of(std::span<const DuplicateRow> duplicates) {
  std::uint64_t sum = 0;
  for (const DuplicateRow& d : duplicates) sum += checksum_of(std::span(&d, 1));
  return sum;
}

// Writes what a WordReader reads, without copying it first: if sites lie on a curve, all of them
// are open.
class BorderWriter {
 public:
  BorderWriter(ScratchFile& file, std::uint64_t place) : file_(file), begin_(place), end_(place) {}

  [[nodiscard]] std::uint64_t num_words() const { return (end_ - begin_) / sizeof(std::uint64_t); }
  [[nodiscard]] std::uint64_t checksum() const { return sum_.value(); }

  void add(std::uint64_t word) { put(std::span<const std::uint64_t>(&word, 1)); }

  // Appends a vector as WordReader::read() expects it, and adds it to the checksum: its size, then
  // its bytes, filled up to whole words with zeros.
  template <class T>
  void add(const std::vector<T>& values) {
    add(values.size());
    const auto bytes = std::as_bytes(std::span(values));
    const std::size_t num_rest = bytes.size() % sizeof(std::uint64_t);
    put(bytes.first(bytes.size() - num_rest));
    if (num_rest == 0) return;
    std::uint64_t last = 0;
    std::memcpy(&last, bytes.last(num_rest).data(), num_rest);
    add(last);
  }

 private:
  template <class T>
  void put(std::span<const T> values) {
    file_.write(end_, values);
    sum_.add(values);
    end_ += values.size_bytes();
  }

  ScratchFile& file_;
  std::uint64_t begin_;
  std::uint64_t end_;
  Checksum sum_;
};

// Writes the border of a bucket in the order in which border_of() reads it.
void write_border(const StoredBorder& stored, BorderWriter& writer) {
  const bulk::BucketBorder& border = stored.border;
  writer.add(stored.points);
  writer.add(stored.named_points);
  writer.add(stored.rows);
  writer.add(border.open_sites);
  writer.add(border.open_edges);
  writer.add(border.hidden);
  writer.add(border.num_faces);
  writer.add(border.rim);
  writer.add(border.rim_corners);
  writer.add(border.rim_neighbors);
}

// Reads the border of a bucket, with or without its rim.
StoredBorder border_of(const Words& words, bool has_rim) {
  StoredBorder stored;
  bulk::BucketBorder& border = stored.border;
  WordReader reader(words);
  reader.read(stored.points);
  reader.read(stored.named_points);
  reader.read(stored.rows);
  reader.read(border.open_sites);
  reader.read(border.open_edges);
  reader.read(border.hidden);
  border.num_faces = static_cast<Index>(reader.word());
  if (!has_rim) return stored;
  reader.read(border.rim);
  reader.read(border.rim_corners);
  reader.read(border.rim_neighbors);
  return stored;
}

}  // namespace

ResultStore::ResultStore(const std::string& faces, const std::string& borders,
                         std::span<const BucketCut> cuts, StoreParts parts)
    : faces_(faces),
      borders_(borders),
      borders_end_(borders_.size()),
      first_site_(1, 0),
      parts_(parts) {
  for (const BucketCut& cut : cuts) first_site_.push_back(first_site_.back() + cut.num_sites);
}

void ResultStore::add_duplicates(std::size_t i, StoredBucket& stored,
                                 std::span<const DuplicateRow> duplicates) {
  faces_.write(duplicates_at(i) + sizeof(DuplicateRow) * stored.num_duplicates, duplicates);
  stored.num_duplicates += duplicates.size();
  stored.duplicates_checksum += sum_of(duplicates);
}

void ResultStore::write(std::size_t i, const bulk::Bucket& bucket,
                        std::span<const std::uint64_t> vertex_rows, std::span<const Point> points,
                        const StoredBorder& border, StoredBucket& stored) {
  stored.num_vertices = vertex_rows.size();
  stored.num_faces = bucket.faces.size();
  stored.num_hidden = bucket.hidden.size();
  Checksum sum;
  const auto write = [&](std::uint64_t place, const auto& values) {
    faces_.write(place, std::span(std::as_const(values)));
    sum.add(std::span(std::as_const(values)));
  };
  write(rows_at(i, stored), vertex_rows);
  write(faces_at(i, stored), bucket.faces);
  if (parts_.has_neighbors) write(neighbors_at(i, stored), bucket.neighbors);
  if (parts_.has_points) write(points_at(i, stored), points);
  stored.checksum = sum.value();

  BorderWriter writer(borders_, borders_end_);
  write_border(border, writer);
  stored.border_place = borders_end_;
  stored.border_words = writer.num_words();
  stored.border_checksum = writer.checksum();
  borders_end_ += writer.num_words() * sizeof(std::uint64_t);
}

// The sizes of the files are compared first, as reading beyond their ends is an error.
bool ResultStore::has(std::size_t i, const StoredBucket& stored) const {
  const std::uint64_t end =
      points_at(i, stored) + (parts_.has_points ? sizeof(Point) * stored.num_vertices : 0);
  const std::uint64_t border_end =
      stored.border_place + sizeof(std::uint64_t) * stored.border_words;
  if (faces_.size() < end || borders_.size() < border_end) return false;
  const Words words = border_words(stored);
  if (checksum_of(std::span(words)) != stored.border_checksum) return false;
  Checksum sum;
  const auto add = [&](const auto& values) { sum.add(std::span(values)); };
  add(vertex_rows(i, stored));
  add(faces(i, stored));
  if (parts_.has_neighbors) add(neighbors(i, stored));
  if (parts_.has_points) add(points(i, stored));
  return sum.value() == stored.checksum && duplicates_sum(i, stored) == stored.duplicates_checksum;
}

std::uint64_t ResultStore::duplicates_sum(std::size_t i, const StoredBucket& stored) const {
  std::vector<DuplicateRow> some(4096);
  std::uint64_t sum = 0;
  for (std::uint64_t first = 0; first < stored.num_duplicates; first += some.size()) {
    const std::uint64_t size = std::min<std::uint64_t>(some.size(), stored.num_duplicates - first);
    read_duplicates(i, first, std::span(some).first(size));
    sum += sum_of(std::span(some).first(size));
  }
  return sum;
}

std::vector<std::uint64_t> ResultStore::vertex_rows(std::size_t i,
                                                    const StoredBucket& stored) const {
  return values_at<std::vector<std::uint64_t>>(faces_, rows_at(i, stored), stored.num_vertices);
}

LargeVector<Triple> ResultStore::faces(std::size_t i, const StoredBucket& stored) const {
  return values_at<LargeVector<Triple>>(faces_, faces_at(i, stored), stored.num_faces);
}

LargeVector<Triple> ResultStore::neighbors(std::size_t i, const StoredBucket& stored) const {
  return values_at<LargeVector<Triple>>(faces_, neighbors_at(i, stored), stored.num_faces);
}

LargeVector<Point> ResultStore::points(std::size_t i, const StoredBucket& stored) const {
  return values_at<LargeVector<Point>>(faces_, points_at(i, stored), stored.num_vertices);
}

void ResultStore::read_duplicates(std::size_t i, std::uint64_t first,
                                  std::span<DuplicateRow> duplicates) const {
  faces_.read(duplicates_at(i) + sizeof(DuplicateRow) * first, duplicates);
}

Words ResultStore::border_words(const StoredBucket& stored) const {
  return values_at<Words>(borders_, stored.border_place, stored.border_words);
}

std::uint64_t ResultStore::num_open_sites(const StoredBucket& stored) const {
  std::uint64_t size = 0;  // the first word is the number of the points
  borders_.read(stored.border_place, std::span(&size, 1));
  return size;
}

StoredBorder ResultStore::border(const StoredBucket& stored) const {
  return border_of(border_words(stored), true);
}

StoredBorder ResultStore::outline(const StoredBucket& stored) const {
  return border_of(border_words(stored), false);
}

}  // namespace rondel::distributed
