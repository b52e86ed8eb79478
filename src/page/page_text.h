// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The texts that every page contains. They are files of viewer/ and data/coast.txt, compiled into
// the library.
#pragma once

#include <string_view>

namespace rondel::page {

std::string_view frame_text();   // viewer/page.html, with placeholders @LIKE_THIS@
std::string_view style_text();   // viewer/style.css
std::string_view script_text();  // all of viewer/src as one script
std::string_view coast_text();   // data/coast.txt

}  // namespace rondel::page
