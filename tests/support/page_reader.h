// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads a page as a browser does, with zlib's own functions and other code than the writer's.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace rondel::test {

inline std::string from_base64(std::string_view text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  unsigned count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = (bits << 6U) | static_cast<std::uint32_t>(digits.find(c));
    count += 6;
    if (count >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 0xffU);
  }
  return bytes;
}

inline std::string inflated(const std::string& stream, std::size_t size) {
  std::string bytes(size + 1, '\0');
  uLongf length = bytes.size();
  const int status = uncompress(reinterpret_cast<Bytef*>(bytes.data()), &length,
                                reinterpret_cast<const Bytef*>(stream.data()), stream.size());
  if (status != Z_OK) throw std::runtime_error("not a zlib stream");
  bytes.resize(length);
  return bytes;
}

// The text between two others, from `at` on, which moves behind it.
inline std::string_view text_between(std::string_view page, std::string_view begin,
                                     std::string_view end, std::size_t& at) {
  const std::size_t from = page.find(begin, at);
  if (from == std::string_view::npos)
    throw std::runtime_error("not in the page: " + std::string(begin));
  const std::size_t to = page.find(end, from + begin.size());
  at = to;
  return page.substr(from + begin.size(), to - from - begin.size());
}

inline nlohmann::json about_of(std::string_view page) {
  std::size_t at = 0;
  return nlohmann::json::parse(text_between(page, R"(id="about">)", "</script>", at));
}

// An array of the page.
template <class Number>
std::vector<Number> array_of_page(std::string_view page, const std::string& name) {
  const nlohmann::json about = about_of(page);
  for (const auto& entry : about["arrays"]) {
    if (entry["name"] != name) continue;
    std::size_t at = 0;
    const auto text = text_between(page, "id=\"data-" + name + "\">", "</script>", at);
    const std::size_t count = entry["length"];
    const std::string planes = inflated(from_base64(text), count * sizeof(Number));
    if (planes.size() != count * sizeof(Number)) throw std::runtime_error("wrong length: " + name);
    std::vector<Number> values(count);
    for (std::size_t i = 0; i < count; ++i) {
      char bytes[sizeof(Number)];
      for (std::size_t k = 0; k < sizeof(Number); ++k) bytes[k] = planes[k * count + i];
      std::memcpy(&values[i], bytes, sizeof(Number));
    }
    return values;
  }
  throw std::runtime_error("no array " + name);
}

}  // namespace rondel::test
