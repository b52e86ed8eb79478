// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <io.h>
#include <windows.h>
// This header must come after windows.h.
#include <psapi.h>
#include <shellapi.h>

#include <csignal>
#include <span>
#include <string>

#include "process.h"

namespace rondel::cli {
namespace {

// Converts UTF-16 to UTF-8; the first call of the system's function counts the bytes.
std::string utf8(const wchar_t* text) {
  const auto convert = [&](char* to, int room) {
    return ::WideCharToMultiByte(CP_UTF8, 0, text, -1, to, room, nullptr, nullptr);
  };
  std::string result(static_cast<std::size_t>(convert(nullptr, 0)), '\0');
  convert(result.data(), static_cast<int>(result.size()));
  return result;  // includes the zero that ends it
}

// The flag that the first Ctrl-C sets.
std::atomic<bool> is_interrupted = false;

extern "C" void rondel_interrupt(int /*signal*/) {
  is_interrupted = true;  // the second Ctrl-C ends the process, as the system has reset the handler
}

}  // namespace

const std::atomic<bool>& interrupted_by_user() {
  std::signal(SIGINT, &rondel_interrupt);
  return is_interrupted;
}

// Temporary files need no handler, since the system deletes them.
void prepare_process() {
  for (const int stream : {0, 1, 2}) ::_setmode(stream, _O_BINARY);
  ::SetConsoleOutputCP(CP_UTF8);
}

// The arguments of main() are in an encoding that cannot name every file.
std::vector<const char*> arguments_of_process(int argc, const char* const* argv) {
  static std::vector<std::string> texts;
  wchar_t** const wide = ::CommandLineToArgvW(::GetCommandLineW(), &argc);
  if (wide == nullptr) return {argv, argv + argc};
  for (const wchar_t* text : std::span(wide, static_cast<std::size_t>(argc))) {
    texts.push_back(utf8(text));
  }
  ::LocalFree(wide);
  std::vector<const char*> arguments;
  for (const std::string& text : texts) arguments.push_back(text.c_str());
  return arguments;
}

// The system's terminals obey sequences of control characters after they are asked to.
std::filesystem::path path_of_executable(const std::string& /*name*/) {
  std::wstring path(32768, L'\0');  // the longest path of Windows
  const DWORD size = GetModuleFileNameW(nullptr, path.data(), static_cast<DWORD>(path.size()));
  path.resize(size < path.size() ? size : 0);
  return path;
}

bool has_terminal() {
  const HANDLE console = ::GetStdHandle(STD_ERROR_HANDLE);
  DWORD mode = 0;
  return ::GetConsoleMode(console, &mode) != 0 &&
         ::SetConsoleMode(console, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING) != 0;
}

std::uint64_t peak_memory_bytes() {
  PROCESS_MEMORY_COUNTERS counters{};
  ::K32GetProcessMemoryInfo(::GetCurrentProcess(), &counters, sizeof counters);
  return counters.PeakWorkingSetSize;
}

}  // namespace rondel::cli
