// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/file_bytes.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>
#include <functional>
#include <system_error>

#include "rondel/error.h"

namespace rondel::io {
namespace {

// The registry of mapped files, for a signal handler: in fixed buffers, without a lock. A slot goes
// free -> claimed -> in_use -> free; the handler reads slots in use only.
enum class SlotState : int { free, claimed, in_use };
struct Slot {
  std::atomic<SlotState> state{SlotState::free};
  const char* begin = nullptr;
  const char* end = nullptr;
  char name[PATH_MAX] = {};
};
constexpr std::size_t num_slots = 4;
Slot slots[num_slots];
static_assert(std::atomic<SlotState>::is_always_lock_free);

std::size_t register_mapping(const void* mapping, std::size_t size, const std::string& name) {
  if (name.size() >= PATH_MAX) return num_slots;
  for (std::size_t i = 0; i < num_slots; ++i) {
    SlotState expected = SlotState::free;
    if (!slots[i].state.compare_exchange_strong(expected, SlotState::claimed)) continue;
    slots[i].begin = static_cast<const char*>(mapping);
    slots[i].end = slots[i].begin + size;
    std::memcpy(slots[i].name, name.c_str(), name.size() + 1);
    slots[i].state.store(SlotState::in_use);
    return i;
  }
  return num_slots;
}

void forget_mapping(std::size_t slot) noexcept {
  if (slot < num_slots) slots[slot].state.store(SlotState::free);
}

[[noreturn]] void fail(const std::string& path, int error) {
  throw FileError((path == "-" ? "<stdin>" : path) + ": " + std::generic_category().message(error));
}

class Descriptor {
 public:
  explicit Descriptor(const std::string& path)
      : is_owned_(path != "-"),
        value_(is_owned_ ? ::open(path.c_str(), O_RDONLY | O_CLOEXEC) : STDIN_FILENO) {
    if (value_ < 0) fail(path, errno);
  }
  ~Descriptor() {
    if (is_owned_) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const noexcept { return value_; }

 private:
  bool is_owned_;
  int value_;
};

std::string read_to_end(int descriptor, const std::string& path) {
  std::string bytes;
  std::size_t size = 0;
  while (true) {
    if (bytes.size() == size) bytes.resize(size < 65536 ? 65536 : 2 * size);
    const ssize_t count = ::read(descriptor, bytes.data() + size, bytes.size() - size);
    if (count == 0) break;
    if (count > 0) {
      size += static_cast<std::size_t>(count);
    } else if (errno != EINTR) {
      fail(path, errno);
    }
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace

FileBytes::FileBytes(const std::string& path) {
  const Descriptor file(path);
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) fail(path, errno);
  if (S_ISDIR(status.st_mode)) fail(path, EISDIR);
  // Files of /proc and /sys are regular too, but claim to be empty.
  if (path == "-" || !S_ISREG(status.st_mode) || status.st_size == 0) {
    copy_ = read_to_end(file.get(), path);
    return;
  }
  size_ = static_cast<std::size_t>(status.st_size);
  void* const mapping = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file.get(), 0);
  if (mapping == MAP_FAILED) fail(path, errno);
  ::madvise(mapping, size_, MADV_SEQUENTIAL);
  mapping_ = mapping;
  slot_ = register_mapping(mapping, size_, path);
}

void FileBytes::keep() const noexcept {
  if (mapping_ != nullptr) ::madvise(mapping_, size_, MADV_NORMAL);
}

FileBytes::~FileBytes() {
  if (mapping_ == nullptr) return;
  forget_mapping(slot_);
  ::munmap(mapping_, size_);
}

const char* mapped_file_at(const void* address) noexcept {
  const auto* const byte = static_cast<const char*>(address);
  for (const Slot& slot : slots) {
    if (slot.state.load() != SlotState::in_use) continue;
    if (std::less_equal<>()(slot.begin, byte) && std::less<>()(byte, slot.end)) return slot.name;
  }
  return nullptr;
}

}  // namespace rondel::io
