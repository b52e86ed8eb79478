// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/atomic_file.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <list>
#include <memory>
#include <system_error>
#include <utility>

#include "rondel/error.h"
#include "system/descriptor.h"

namespace rondel::io {
namespace {

// Bytes are gathered to pieces of this size, so that few calls of the system write them.
constexpr std::size_t buffer_size = std::size_t{1} << 18;

// The complete files of this thread that will appear together; null: files appear at once.
thread_local std::list<AtomicFile>* kept_files = nullptr;

}  // namespace

// Returns a short name that does not depend on the target's name, which may have the maximal
// length.
std::string temporary_name(const std::string& directory) {
  static std::atomic<unsigned> counter{0};
  return directory + ".rondel-" + std::to_string(system::process_number()) + "-" +
         std::to_string(counter.fetch_add(1)) + ".tmp";
}

AtomicFile::AtomicFile(const FileName& file) : path_(file.path), string_(file.bytes) {
  if (string_ != nullptr) return;
  buffer_.reserve(buffer_size);
  if (path_ == "-") {
    path_ = "<stdout>";
    descriptor_ = system::standard_output;
    system::keep_bytes(descriptor_);
  } else {
    open();
  }
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)),
      string_(other.string_),
      target_(std::move(other.target_)),
      directory_(std::move(other.directory_)),
      temporary_(std::exchange(other.temporary_, {})),
      is_nameless_(other.is_nameless_),
      buffer_(std::move(other.buffer_)),
      num_drained_(other.num_drained_),
      is_reserved_(other.is_reserved_),
      slot_(other.slot_),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::write(std::string_view bytes) {
  if (string_ != nullptr) {
    buffer_ += bytes;
    return;
  }
  if (buffer_.size() + bytes.size() > buffer_size) flush();
  if (bytes.size() >= buffer_size) {
    drain(bytes);
  } else {
    buffer_ += bytes;
  }
}

void AtomicFile::write_at(std::uint64_t place, std::string_view bytes) {
  if (string_ != nullptr) {
    buffer_.resize(std::max<std::size_t>(buffer_.size(), place + bytes.size()));
    buffer_.replace(place, bytes.size(), bytes);
    return;
  }
  flush();
  while (!bytes.empty()) {
    const std::ptrdiff_t count = system::write_at(descriptor_, place, bytes);
    if (count < 0) fail(errno);
    bytes.remove_prefix(static_cast<std::size_t>(count));
    place += static_cast<std::uint64_t>(count);
    num_drained_ = std::max(num_drained_, place);
  }
}

void AtomicFile::extend(std::uint64_t size) {
  constexpr std::string_view zero("\0", 1);
  const std::uint64_t end = string_ != nullptr ? buffer_.size() : num_drained_ + buffer_.size();
  if (end < size) write_at(size - 1, zero);
}

void AtomicFile::flush() {
  drain(buffer_);
  buffer_.clear();
}

void AtomicFile::drain(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::ptrdiff_t count = system::write(descriptor_, bytes);
    if (count < 0) fail(errno);
    bytes.remove_prefix(static_cast<std::size_t>(count));
    num_drained_ += static_cast<std::uint64_t>(count);
  }
}

void AtomicFile::reserve(std::uint64_t size) {
  if (is_direct()) return;
  if (system::reserve(descriptor_, size) != 0) fail(errno);
  is_reserved_ = true;
}

void AtomicFile::expect(std::uint64_t size) {
  if (is_direct()) return;
  if (system::prepare(descriptor_, size) != 0) fail(errno);
  is_reserved_ = true;
}

void AtomicFile::commit() {
  if (string_ != nullptr) {
    string_->swap(buffer_);
    return;
  }
  flush();
  if (is_reserved_ && system::resize(descriptor_, num_drained_) != 0) fail(errno);
  if (kept_files != nullptr && !is_direct()) {
    kept_files->push_back(std::move(*this));
  } else {
    rename();
  }
}

// Closes the file, but not standard output, which others may use.
int AtomicFile::close() noexcept {
  const int descriptor = descriptor_;
  descriptor_ = -1;
  return descriptor < 0 || descriptor == system::standard_output ? 0 : system::close(descriptor);
}

void AtomicFile::fail(int error) {
  discard();
  throw FileError(path_, std::error_code(error, std::generic_category()));
}

}  // namespace rondel::io

namespace rondel {

struct FilesTogether::Impl {
  std::list<io::AtomicFile> files;
  std::list<io::AtomicFile>* outer = io::kept_files;
};

FilesTogether::FilesTogether() : impl_(std::make_unique<Impl>()) { io::kept_files = &impl_->files; }

FilesTogether::~FilesTogether() { io::kept_files = impl_->outer; }

void FilesTogether::commit() {
  io::kept_files = impl_->outer;
  for (io::AtomicFile& file : impl_->files) file.commit();
  impl_->files.clear();
}

}  // namespace rondel
