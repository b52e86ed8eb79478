// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <system_error>

#include "io/file_bytes.h"
#include "io/signal_slots.h"
#include "rondel/error.h"
#include "rondel/io.h"

namespace rondel::io {
namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 18;

// A file beyond the last slot is not removed by a signal.
constexpr std::size_t num_slots = 8;
SignalSlots<num_slots> temporaries;

void remove_temporaries() noexcept {
  static_cast<void>(temporaries.find([](const auto& file) {
    ::unlink(file.name.data());
    return false;
  }));
}

extern "C" void rondel_remove_temporaries_and_end(int signal) {
  remove_temporaries();
  std::raise(signal);  // its default action has been restored (SA_RESETHAND)
}

// Memory that is mapped from a file is no longer there.
extern "C" void rondel_report_cut_file(int signal, siginfo_t* info, void* /*context*/) {
  remove_temporaries();
  const char* const name = mapped_file_at(info->si_addr);
  if (name == nullptr) {
    std::raise(signal);
    return;
  }
  for (const char* text : {"rondel: ", name, ": the file was cut while it was read\n"}) {
    if (::write(STDERR_FILENO, text, std::strlen(text)) < 0) break;
  }
  ::_exit(1);
}

// Short and independent of the target's name, which may be as long as a name can be.
std::string temporary_name(const std::string& directory) {
  static std::atomic<unsigned> counter{0};
  return directory + ".rondel-" + std::to_string(::getpid()) + "-" +
         std::to_string(counter.fetch_add(1)) + ".tmp";
}

std::string resolve_links(const std::string& path) {
  const std::unique_ptr<char, decltype(&std::free)> resolved(::realpath(path.c_str(), nullptr),
                                                             &std::free);
  return resolved ? resolved.get() : path;
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : path_(path), target_(path), slot_(num_slots) {
  if (path == "-") throw FileError("-: standard output is not supported; name a file");
  struct stat status {};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) fail(EISDIR);
  if (exists && ::access(path.c_str(), W_OK) != 0) fail(errno);
  buffer_.reserve(buffer_size);
  if (exists && !S_ISREG(status.st_mode)) {
    descriptor_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail(errno);
    return;
  }
  if (exists) target_ = resolve_links(path);
  const std::size_t slash = target_.rfind('/');
  create(slash == std::string::npos ? "" : target_.substr(0, slash + 1));
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::create(const std::string& directory) {
  directory_ = directory;
  // Without a name, so that not even a killed process leaves a file; some file systems cannot.
  if (::access("/proc/self/fd", X_OK) == 0) {
    descriptor_ =
        ::open(directory.empty() ? "." : directory.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666);
    is_nameless_ = descriptor_ >= 0;
  }
  if (is_nameless_) return;
  make_temporary([&](const char* name) {
    descriptor_ = ::open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    return descriptor_ >= 0;
  });
}

void AtomicFile::make_temporary(const std::function<bool(const char*)>& make) {
  for (;;) {
    temporary_ = temporary_name(directory_);
    slot_ = temporaries.remember(temporary_);
    if (make(temporary_.c_str())) return;
    const int error = errno;
    temporaries.forget(slot_);
    temporary_.clear();
    if (error != EEXIST) fail(error);
  }
}

void AtomicFile::write(std::string_view bytes) {
  if (buffer_.size() + bytes.size() > buffer_size) flush();
  if (bytes.size() > buffer_size) {
    drain(bytes);
  } else {
    buffer_ += bytes;
  }
}

void AtomicFile::flush() {
  drain(buffer_);
  buffer_.clear();
}

void AtomicFile::drain(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
    if (count >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno != EINTR) {
      fail(errno);
    }
  }
}

void AtomicFile::commit() {
  flush();
  if (is_nameless_) {
    const std::string link = "/proc/self/fd/" + std::to_string(descriptor_);
    make_temporary([&](const char* name) {
      return ::linkat(AT_FDCWD, link.c_str(), AT_FDCWD, name, AT_SYMLINK_FOLLOW) == 0;
    });
  }
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  if (closed != 0) fail(errno);
  if (temporary_.empty()) return;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporaries.forget(slot_);
  temporary_.clear();
}

void AtomicFile::fail(int error) {
  discard();
  throw FileError(path_ + ": " + std::generic_category().message(error));
}

void AtomicFile::discard() noexcept {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
  if (temporary_.empty()) return;
  ::unlink(temporary_.c_str());
  temporaries.forget(slot_);
  temporary_.clear();
}

}  // namespace rondel::io

namespace rondel::inline v0 {

void remove_temporaries_on_signal() {
  struct sigaction action {};
  action.sa_handler = &io::rondel_remove_temporaries_and_end;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) ::sigaction(signal, &action, nullptr);
  }
  action.sa_sigaction = &io::rondel_report_cut_file;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_SIGINFO);
  ::sigaction(SIGBUS, &action, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace rondel::inline v0
