// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "io/json_tree.h"

#include <algorithm>
#include <string_view>

namespace rondel::io {

const JsonTree& JsonTree::member(const std::string& name) const {
  static const JsonTree null;
  const auto found = std::ranges::find(members, name, &JsonMember::name);
  return found == members.end() ? null : found->value;
}

bool JsonTree::has_member(const std::string& name) const {
  return std::ranges::find(members, name, &JsonMember::name) != members.end();
}

std::string JsonTree::text() const {
  if (kind == Kind::scalar) return scalar.dump();
  if (kind == Kind::integer) return string();
  std::string text;
  for (const JsonTree& item : items) text += (text.empty() ? "" : ",") + item.text();
  for (const auto& [name, value] : members) {
    text += (text.empty() ? "" : ",") + nlohmann::json(name).dump() + ":" + value.text();
  }
  return kind == Kind::array ? "[" + text + "]" : "{" + text + "}";
}

const std::string& JsonTreeBuilder::root_member() const {
  static const std::string none;
  return open_.empty() ? none : open_.front().key;
}

bool JsonTreeBuilder::open(JsonTree::Kind kind) {
  if (open_.size() == max_depth) {
    throw JsonError("values nested more than " + std::to_string(max_depth) + " deep");
  }
  if (kind == JsonTree::Kind::object) listener_.on_object_start(open_.size(), root_member());
  open_.emplace_back().tree.kind = kind;
  return true;
}

bool JsonTreeBuilder::add(JsonTree value) {
  if (open_.empty()) {
    root_ = std::move(value);
  } else if (Level& level = open_.back(); level.tree.is_array()) {
    level.tree.items.push_back(std::move(value));
  } else {
    level.tree.members.push_back({level.key, std::move(value)});
  }
  return true;
}

bool JsonTreeBuilder::add_scalar(nlohmann::json value) {
  JsonTree tree;
  tree.scalar = std::move(value);
  return add(std::move(tree));
}

// The parser calls this function also for integers beyond 64 bits, whose digits `text` has.
bool JsonTreeBuilder::number_float(double value, const std::string& text) {
  if (text.find_first_not_of("-0123456789") != std::string::npos) return add_scalar(value);
  JsonTree tree;
  tree.kind = JsonTree::Kind::integer;
  tree.scalar = text;
  return add(std::move(tree));
}

bool JsonTreeBuilder::key(std::string& name) {
  if (!open_.back().names.insert(name).second) {
    throw BadValue("two members " + in_quotes(name) + " of one object");
  }
  open_.back().key = name;
  return true;
}

bool JsonTreeBuilder::end_object() {
  JsonTree value = std::move(open_.back().tree);
  open_.pop_back();
  return listener_.on_object(open_.size(), root_member(), value) || add(std::move(value));
}

bool JsonTreeBuilder::end_array() {
  JsonTree value = std::move(open_.back().tree);
  open_.pop_back();
  return add(std::move(value));
}

bool JsonTreeBuilder::parse_error(std::size_t /*position*/, const std::string& /*token*/,
                                  const nlohmann::json::exception& error) {
  // Removes the beginning "[json.exception.parse_error.101] parse error at line 1, column 2: ".
  std::string_view reason = error.what();
  reason.remove_prefix(std::min(reason.find("] ") + 2, reason.size()));
  if (reason.starts_with("parse error at")) reason.remove_prefix(reason.find(": ") + 2);
  throw JsonError("not JSON: " + one_line(reason, 200));
}

}  // namespace rondel::io
