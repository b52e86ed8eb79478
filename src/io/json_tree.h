// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// JSON as a tree. It is parsed by nlohmann's parser but does not use its trees, whose destructors
// allocate memory and end the program if there is none.
//
// in    the text of a document
// out   a tree; and calls for the objects in it as they are completed
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/number.h"

namespace rondel::io {

// The text is not JSON, or too deep for this reader; the message says at which line.
class JsonError : public BadValue {
 public:
  using BadValue::BadValue;
};

struct JsonMember;

// A value with all that is in it.
struct JsonTree {  // NOLINT(bugprone-exception-escape): to move nlohmann's values does not throw
  // An integer beyond 64 bits keeps its digits, as a string in `scalar`.
  enum class Kind : std::uint8_t { scalar, integer, array, object };

  Kind kind = Kind::scalar;
  nlohmann::json scalar;  // null, a boolean, a number or a string
  std::vector<JsonTree> items;
  std::vector<JsonMember> members;  // in the order of the text, which columns of tables have

  [[nodiscard]] bool is_null() const { return kind == Kind::scalar && scalar.is_null(); }
  [[nodiscard]] bool is_number() const {
    return kind == Kind::integer || (kind == Kind::scalar && scalar.is_number());
  }
  [[nodiscard]] bool is_string() const { return kind == Kind::scalar && scalar.is_string(); }
  [[nodiscard]] bool is_array() const { return kind == Kind::array; }
  [[nodiscard]] double number() const {
    return kind == Kind::integer ? parse_number(string(), "number") : scalar.get<double>();
  }
  [[nodiscard]] std::string string() const { return scalar.get<std::string>(); }

  // Returns the member of an object, or null if there is none.
  [[nodiscard]] const JsonTree& member(const std::string& name) const;
  // True if an object has the member.
  [[nodiscard]] bool has_member(const std::string& name) const;
  // Returns the tree as JSON without white space.
  [[nodiscard]] std::string text() const;
};

// A value with its name in an object.
struct JsonMember {  // NOLINT(bugprone-exception-escape)
  std::string name;
  JsonTree value;
};

// Builds the tree from the parser's events (nlohmann::json::sax_parse). Throws JsonError, and
// BadValue for an object with two members of one name, of which only one would be seen.
class JsonTreeBuilder : public nlohmann::json_sax<nlohmann::json> {
 public:
  // Deeper trees are refused, since they are read and destroyed by recursion.
  static constexpr std::size_t max_depth = 512;

  // Functions that are called with the number of values that contain a new one, and with the name
  // of the member of the root that these are in.
  struct Listener {
    std::function<void(std::size_t depth, const std::string& member)> on_object_start;
    // Returns true if the object has been used and is removed from the tree.
    std::function<bool(std::size_t depth, const std::string& member, const JsonTree&)> on_object;
  };
  explicit JsonTreeBuilder(Listener listener) : listener_(std::move(listener)) {}

  [[nodiscard]] const JsonTree& root() const { return root_; }

  bool null() override { return add_scalar(nullptr); }
  bool boolean(bool value) override { return add_scalar(value); }
  bool number_integer(std::int64_t value) override { return add_scalar(value); }
  bool number_unsigned(std::uint64_t value) override { return add_scalar(value); }
  bool number_float(double value, const std::string& text) override;
  bool string(std::string& value) override { return add_scalar(std::move(value)); }
  bool binary(nlohmann::json::binary_t& /*value*/) override { return false; }
  bool start_object(std::size_t /*size*/) override { return open(JsonTree::Kind::object); }
  bool start_array(std::size_t /*size*/) override { return open(JsonTree::Kind::array); }
  bool key(std::string& name) override;
  bool end_object() override;
  bool end_array() override;
  bool parse_error(std::size_t position, const std::string& token,
                   const nlohmann::json::exception& error) override;

 private:
  // An object or array that has begun and not ended.
  struct Level {  // NOLINT(bugprone-exception-escape)
    JsonTree tree;
    std::string key;              // key of the next member, in an object
    std::set<std::string> names;  // of its members, of which there may be thousands
  };

  // Begins an object or array.
  bool open(JsonTree::Kind kind);
  // Puts a value into the innermost object or array, or makes it the root.
  bool add(JsonTree value);
  bool add_scalar(nlohmann::json value);
  [[nodiscard]] const std::string& root_member() const;

  Listener listener_;
  std::vector<Level> open_;
  JsonTree root_;
};

}  // namespace rondel::io
