# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0

# Makes the C++ source that holds the page's template, style, script and coast as text:
#
#     cmake -DVIEWER=viewer -DCOAST=data/coast.txt -DMODULES="a.js;b.js" -DOUTPUT=page_text.cpp -P EmbedPage.cmake
#
# Parts of the template are the files of viewer/parts that parts.txt names, as the page to play has them, too. The script
# is all modules one after the other in one function, lower ones first: browsers load no modules from file://. Imports,
# the word `export` and comments of whole lines are left out, so every name at the top of a module is unique among all
# modules.

cmake_minimum_required(VERSION 3.25)

# `;` and `[` mean something in lists, so that texts are only ever single, quoted arguments.
function(read_script path result)
  file(READ "${path}" text)
  string(REGEX REPLACE "\n[ ]*//[^\n]*" "" text "\n${text}")
  string(REGEX REPLACE "\nimport [^;]*;" "" text "${text}")
  string(REGEX REPLACE "\nexport " "\n" text "${text}")
  if(text MATCHES "\n(import|export) ")
    message(FATAL_ERROR "${path}: an import or export is not as this script expects it")
  endif()
  string(REGEX MATCHALL "\n(async )?(function|class|const|let) [A-Za-z]+" found "${text}")
  foreach(definition IN LISTS found)
    string(REGEX REPLACE ".* " "" name "${definition}")
    if(name IN_LIST names)
      message(FATAL_ERROR "${path}: another module has the name ${name}, too")
    endif()
    list(APPEND names ${name})
  endforeach()
  set(names "${names}" PARENT_SCOPE)
  string(REGEX REPLACE "\n[ ]+" "\n" text "${text}")
  string(REGEX REPLACE "\n\n+" "\n" text "${text}")
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

# Literals of 8 KiB, which every compiler takes; the compiler joins them.
function(append_literal name text)
  set(source "constexpr char ${name}_bytes[] =")
  string(LENGTH "${text}" length)
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${text}" ${at} 8192 part)
    string(APPEND source "\n    R\"~~~(${part})~~~\"")
    math(EXPR at "${at} + 8192")
  endwhile()
  string(APPEND literals "${source};\n\n")
  set(literals "${literals}" PARENT_SCOPE)
endfunction()

set(script "(() => {\n\"use strict\";")
set(names "")
foreach(module IN LISTS MODULES)
  read_script("${VIEWER}/src/${module}" text)
  string(APPEND script "${text}")
endforeach()
string(APPEND script "})();")

set(literals "")
append_literal(script "${script}")
file(READ "${VIEWER}/page.html" text)
file(STRINGS "${VIEWER}/parts.txt" parts)
foreach(part IN LISTS parts)
  file(READ "${VIEWER}/parts/${part}.html" content)
  string(TOUPPER "@${part}@\n" place)
  if(NOT text MATCHES "\n${place}")
    message(FATAL_ERROR "page.html has no place for ${part}.html")
  endif()
  string(REPLACE "${place}" "${content}" text "${text}")
endforeach()
append_literal(frame "${text}")
file(READ "${VIEWER}/style.css" text)
append_literal(style "${text}")
file(READ "${COAST}" text)
append_literal(coast "${text}")

file(WRITE "${OUTPUT}" "// Made by cmake/EmbedPage.cmake.
#include \"page/page_text.h\"

namespace rondel::page {
namespace {

${literals}}  // namespace

std::string_view frame_text() { return {frame_bytes, sizeof(frame_bytes) - 1}; }
std::string_view style_text() { return {style_bytes, sizeof(style_bytes) - 1}; }
std::string_view script_text() { return {script_bytes, sizeof(script_bytes) - 1}; }
std::string_view coast_text() { return {coast_bytes, sizeof(coast_bytes) - 1}; }

}  // namespace rondel::page
")
