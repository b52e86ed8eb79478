// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The files that a command reads and writes, which have to be different ones, and names that mean
/// a part of a file.
///
/// in    names of files as the command line has them, each with the option that it comes from
/// out   an exception that names the option and the file, if two of them are one
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "rondel/io.h"

namespace rondel::cli {

/// A file as the command line names it.
struct NamedFile {
  const char* option;  ///< "--to", or "INPUT"
  std::string path;    ///< may be empty, "-", FILE:NAME of an input, or no file at all as grid:1
};

/// Checks that no output of a command is one of its inputs, or another output. Every command that
/// writes calls it before any work.
/// Files are compared as the system knows them (device and number), so every spelling and every
/// link of a file is that file; of files that do not exist yet the resolved paths are compared.
/// \param inputs  the files that are read; a name may stand for several files, as FILE:NAME does
/// \param outputs  the files that are written; only --output may be standard output
/// \throws UsageError if a file that is written is also read, or is written twice
/// \throws FileError if the folder of an output does not exist
void require_separate_files(const std::vector<NamedFile>& inputs,
                            const std::vector<NamedFile>& outputs);

/// True if two names are one file: they have the same device and number, or lead to the same path.
bool are_one_file(const std::string& a, const std::string& b);

/// Returns FILE and the text behind its last colon, except for the colon of C:\; the whole text if
/// there is a file of that name.
std::pair<std::string, std::string> split_at_colon(const std::string& text);

}  // namespace rondel::cli
