// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>

#include "command.h"
#include "process.h"
#include "rondel/io.h"

namespace rondel::cli {
namespace {

// If a standard stream is closed, a file that is opened later would take its number and receive its
// text. So it is opened in the wrong direction: using it fails, as it should.
void guard_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) != -1) continue;
    const int mode = stream == STDIN_FILENO ? O_WRONLY : O_RDONLY;
    if (open("/dev/null", mode) == -1) std::_Exit(failed);
  }
}

// Handles a signal that ends the process: it ends by the same signal, so that its parent sees that.
extern "C" void rondel_remove_temporaries_and_end(int signal) {
  remove_temporaries();
  std::signal(signal, SIG_DFL);  // rondel_interrupt() does not reset it
  std::raise(signal);
}

// A handler of signals may only write to such a flag.
std::atomic<bool> is_interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);

// Handles the first Ctrl-C; the second one ends the process.
extern "C" void rondel_interrupt(int /*signal*/) {
  is_interrupted = true;
  std::signal(SIGINT, &rondel_remove_temporaries_and_end);
}

// Makes signals that end the process remove temporary files. SIGPIPE, when a reader goes away, ends
// it silently, as with other tools. Exceeding a limit of file sizes becomes an error instead of a
// signal.
void handle_signals() {
  struct sigaction action {};
  action.sa_handler = &rondel_remove_temporaries_and_end;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGHUP, SIGINT, SIGPIPE, SIGTERM}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace

void prepare_process() {
  guard_standard_streams();
  handle_signals();
}

// A process that its parent has made ignore Ctrl-C, as shells do with jobs in the background, goes
// on ignoring it.
const std::atomic<bool>& interrupted_by_user() {
  if (std::signal(SIGINT, &rondel_interrupt) == SIG_IGN) std::signal(SIGINT, SIG_IGN);
  return is_interrupted;
}

std::vector<const char*> arguments_of_process(int argc, const char* const* argv) {
  return {argv, argv + argc};
}

std::filesystem::path path_of_executable(const std::string& name) {
  namespace fs = std::filesystem;
  std::error_code error;
  // Linux knows it; elsewhere it is the name that the program was called by, or is looked for where
  // shells do.
  if (fs::path known = fs::read_symlink("/proc/self/exe", error); !error) return known;
  if (name.find('/') != std::string::npos) return fs::canonical(name, error);
  const char* const folders = std::getenv("PATH");
  std::istringstream list(folders == nullptr ? "" : folders);
  for (std::string folder; std::getline(list, folder, ':');) {
    fs::path found = fs::canonical(fs::path(folder) / name, error);
    if (!error) return found;
  }
  return {};
}

bool has_terminal() { return isatty(STDERR_FILENO) != 0; }

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  constexpr std::uint64_t unit = 1024;  // Linux counts ru_maxrss in KiB
  return static_cast<std::uint64_t>(usage.ru_maxrss) * unit;
}

}  // namespace rondel::cli
