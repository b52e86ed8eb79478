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

# Appends the function NAME_text to `functions`. Literals have 8 KiB and are joined when the text is first asked for:
# compilers need not take a longer literal than one of 64 KiB, even one that they join themselves.
function(append_text name text)
  set(source "std::string_view ${name}_text() {\n  static const std::string text = joined({")
  string(LENGTH "${text}" length)
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${text}" ${at} 8192 part)
    string(APPEND source "\n    R\"~~~(${part})~~~\",")
    math(EXPR at "${at} + 8192")
  endwhile()
  string(APPEND functions "${source}});\n  return text;\n}\n\n")
  set(functions "${functions}" PARENT_SCOPE)
endfunction()

set(script "(() => {\n\"use strict\";")
set(names "")
foreach(module IN LISTS MODULES)
  read_script("${VIEWER}/src/${module}" text)
  string(APPEND script "${text}")
endforeach()
string(APPEND script "})();")

set(functions "")
append_text(script "${script}")
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
append_text(frame "${text}")
file(READ "${VIEWER}/style.css" text)
append_text(style "${text}")
file(READ "${COAST}" text)
append_text(coast "${text}")

file(WRITE "${OUTPUT}" "// Made by cmake/EmbedPage.cmake.
#include \"page/page_text.h\"

#include <initializer_list>
#include <string>

namespace rondel::page {
namespace {

std::string joined(std::initializer_list<std::string_view> parts) {
  std::string text;
  for (const std::string_view part : parts) text += part;
  return text;
}

}  // namespace

${functions}}  // namespace rondel::page
")
