// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Runs a fuzzer's function without libFuzzer: on all files that are named (of folders, on
// their files), then on inputs from a deterministic stream. Files are the seeds
// from which half of the stream is made by changing a few bytes.
//
//     NAME [--runs N] [--seed S] [--longest BYTES] [FILE|FOLDER]...
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "support/random.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

// There with a sanitizer only, which ends the program without a signal.
// NOLINTNEXTLINE(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" void __sanitizer_set_death_callback(void (*callback)()) __attribute__((weak));

namespace {

using Bytes = std::vector<std::uint8_t>;
using rondel::test::Random;

Bytes read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::vector<std::filesystem::path> files_of(const std::filesystem::path& path) {
  if (!std::filesystem::is_directory(path)) {
    if (std::filesystem::exists(path)) return {path};
    return {};
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(path)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

Bytes invented(Random& random, std::size_t longest) {
  Bytes bytes(random.below(longest + 1));
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.next() >> 56);
  return bytes;
}

void change(Bytes& bytes, Random& random) {
  for (std::size_t n = 1 + random.below(4); n > 0; --n) {
    const std::size_t at = random.below(bytes.size() + 1);
    const auto value = static_cast<std::uint8_t>(random.next() >> 56);
    if (at == bytes.size() || random.below(4) == 0) {
      bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at), value);
    } else if (random.below(3) == 0) {
      bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(at));
    } else {
      bytes[at] = value;
    }
  }
}

// What runs, and where a crash leaves it.
struct Reproducer {
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;
  char path[256] = {};
};
Reproducer reproducer;

// Signal handlers may do little more than this.
void leave_input() {
  const int file = ::open(reproducer.path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (file < 0) return;
  const ssize_t written = ::write(file, reproducer.data, reproducer.size);
  static_cast<void>(written);
  ::close(file);
}

extern "C" void leave_input_and_end(int signal) {
  leave_input();
  std::raise(signal);  // its default action has been restored (SA_RESETHAND)
}

void prepare_for_crashes(const std::string& name) {
  std::snprintf(reproducer.path, sizeof reproducer.path, "%s.input", name.c_str());
  struct sigaction action {};
  action.sa_handler = leave_input_and_end;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int signal : {SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV, SIGTERM}) {
    ::sigaction(signal, &action, nullptr);
  }
  if (__sanitizer_set_death_callback != nullptr) __sanitizer_set_death_callback(leave_input);
}

// Of its own length, so that a sanitizer sees what is read beyond the end.
void run(const Bytes& input) {
  const Bytes bytes(input);
  reproducer.data = bytes.data();
  reproducer.size = bytes.size();
  LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t runs = 0;
  std::uint64_t seed = 1;
  std::size_t longest = 200;
  std::vector<Bytes> seeds;
  const std::string name = std::filesystem::path(argv[0]).filename().string();
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const auto value = [&] { return i + 1 < argc ? std::strtoull(argv[++i], nullptr, 10) : 0; };
    if (argument == "--runs") {
      runs = value();
    } else if (argument == "--seed") {
      seed = value();
    } else if (argument == "--longest") {
      longest = value();
    } else {
      for (const auto& path : files_of(argument)) seeds.push_back(read(path));
    }
  }
  prepare_for_crashes(name);
  for (const Bytes& bytes : seeds) run(bytes);
  Random random(seed);
  for (std::size_t i = 0; i < runs; ++i) {
    const bool is_new = seeds.empty() || random.coin();
    Bytes bytes = is_new ? invented(random, longest) : seeds[random.below(seeds.size())];
    if (!is_new) change(bytes, random);
    run(bytes);
  }
  std::printf("%zu files and %zu generated inputs\n", seeds.size(), runs);
  return 0;
}
