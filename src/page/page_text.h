// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What every page holds: texts of viewer/ and data/coast.txt, made part of the library when it is built.
#pragma once

#include <string_view>

namespace rondel::page {

std::string_view frame_text();   // viewer/page.html, with places @LIKE_THIS@
std::string_view style_text();   // viewer/style.css
std::string_view script_text();  // viewer/src, one script
std::string_view coast_text();   // data/coast.txt

}  // namespace rondel::page
