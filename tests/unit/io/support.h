// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The parts that tests of readers and writers share.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "io/bad_value.h"
#include "rondel/error.h"
#include "rondel/io.h"
#include "support/temporary_files.h"
#include "support/thrown.h"

namespace rondel::test {

inline const std::filesystem::path corpus = RONDEL_SOURCE_DIR "/tests/corpus/io";

// The octahedron, which all good files of the corpus hold.
inline const std::vector<Point> octahedron = {{1, 0, 0},  {0, 1, 0}, {-1, 0, 0},
                                              {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
inline const std::vector<Triple> octahedron_faces = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4},
                                                     {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};

inline std::string read_all(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The message of the FileError that `action` throws; empty if it throws none.
template <typename Action>
std::string message_of(Action action) {
  return thrown_message<FileError>(action);
}

// The message of the BadValue that `action` throws; empty if it throws none.
template <class Action>
std::string refused(const Action& action) {
  return thrown_message<io::BadValue>(action);
}

// The files of a folder of the corpus, in order.
inline std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// Compares the messages for the files of a folder with its list "expected.txt".
template <typename Read>
void expect_messages(const std::filesystem::path& folder, Read read) {
  std::vector<std::string> messages;
  const std::string prefix = folder.string() + "/";
  for (const auto& file : files_in(folder)) {
    if (file.filename() == "expected.txt") continue;
    const std::string message = message_of([&] { read(file.string()); });
    EXPECT_TRUE(message.starts_with(prefix)) << file << ": " << message;
    messages.push_back(message.substr(std::min(prefix.size(), message.size())));
  }
  std::sort(messages.begin(), messages.end());
  std::string text;
  for (const std::string& message : messages) text += message + "\n";
  EXPECT_EQ(text, read_all(folder / "expected.txt"));
}

}  // namespace rondel::test
