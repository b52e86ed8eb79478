// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// SMS's 2DM: a card a line. MESH2D begins the file; "E3T id a b c material" is a triangle, "ND id x y
// z" a node, whose z is the elevation of the ground, and "NS a b ... -z id" a string of nodes, which
// a negative one ends, on as many cards as it needs. Strings of files that are written have the word
// open, land or island behind their id, and those of islands are closed. Other cards are for other
// programs, and are passed over.
#include <algorithm>
#include <optional>
#include <string>

#include "formats/ocean_lines.h"
#include "io/number.h"
#include "meshing/mesh_border.h"
#include "rondel/names.h"

namespace rondel::formats {
namespace {

using io::BadValue;
using mesh::BoundaryKind;

constexpr std::size_t nodes_per_card = 10;

// A string of nodes by their numbers in the file.
struct NodeString {
  std::vector<std::int64_t> names;
  std::optional<BoundaryKind> kind;
  std::uint64_t line = 0;
};

class SmsReader {
 public:
  SmsReader(OceanLines& lines, MeshInFile& file) : lines_(lines), file_(file) {}

  void read() {
    if (!lines_.next() || lines_.words()[0] != "MESH2D") throw BadValue("not a 2DM file");
    while (lines_.next()) read_card();
    if (!string_.names.empty()) throw BadValue("the file ends within a nodestring");
    nodes_.sort();
    for (std::size_t t = 0; t < corners_.size(); ++t) {
      at_line(file_.triangle_lines[t], [&] {
        const auto& [a, b, c] = corners_[t];
        file_.mesh.triangles.push_back({nodes_[a], nodes_[b], nodes_[c]});
      });
    }
    take_strings();
  }

 private:
  void read_card() {
    const std::string_view card = lines_.words()[0];
    if (card == "ND") {
      nodes_.add(lines_.count(1, "number of a node"));
      add_node(file_, lines_.number(2, "longitude"), lines_.number(3, "latitude"));
      file_.mesh.depths.push_back(turned(lines_.number(4, "elevation")));
      file_.node_lines.push_back(lines_.line());
    } else if (card == "E3T") {
      const auto corner = [&](std::size_t k) { return lines_.integer(k, "number of a node"); };
      corners_.push_back({corner(2), corner(3), corner(4)});
      file_.triangle_lines.push_back(lines_.line());
    } else if (card == "NS") {
      read_string();
    } else if (card.size() == 3 && card[0] == 'E' && card[1] >= '2' && card[1] <= '9') {
      throw BadValue("an element " + io::in_quotes(card) + ", where E3T is needed");
    }
  }

  void read_string() {
    if (string_.names.empty()) string_.line = lines_.line();
    const std::size_t count = lines_.words().size();
    for (std::size_t k = 1; k < count; ++k) {
      const std::int64_t name = lines_.integer(k, "number of a node");
      string_.names.push_back(name < 0 ? -name : name);
      if (name >= 0) continue;
      // Behind the last node are the id of the string and its kind.
      if (k + 2 < count) {
        std::string kind(lines_.words()[k + 2]);
        std::erase(kind, '"');
        string_.kind = from_name<BoundaryKind>(kind);
      }
      strings_.push_back(std::move(string_));
      string_ = {};
      return;
    }
  }

  // Makes segments of strings with kinds; if one has none, finds the others.
  void take_strings() {
    std::vector<mesh::BoundarySegment> segments;
    for (const NodeString& string : strings_) {
      mesh::BoundarySegment& segment = segments.emplace_back();
      segment.kind = string.kind.value_or(BoundaryKind::open);
      at_line(string.line, [&] {
        for (const std::int64_t name : string.names) segment.nodes.push_back(nodes_[name]);
      });
    }
    const bool has_kinds =
        std::ranges::all_of(strings_, [](const NodeString& one) { return one.kind.has_value(); });
    if (!has_kinds) return find_land(segments);
    file_.has_boundary = !segments.empty();
    for (std::size_t s = 0; s < segments.size(); ++s) {
      file_.segment_lines.push_back(strings_[s].line);
      add_segment(file_, std::move(segments[s]));
    }
  }

  // Divides the border into open strings and land.
  void find_land(const std::vector<mesh::BoundarySegment>& segments) {
    std::vector<std::array<Index, 2>> open;
    for (const mesh::BoundarySegment& segment : segments) {
      if (segment.kind != BoundaryKind::open) continue;
      for (std::size_t k = 1; k < segment.nodes.size(); ++k) {
        const auto [low, high] = std::minmax(segment.nodes[k - 1], segment.nodes[k]);
        open.push_back({low, high});
      }
    }
    std::ranges::sort(open);
    open.erase(std::unique(open.begin(), open.end()), open.end());
    file_.open_edges = std::move(open);
    file_.remarks.emplace_back(
        "nodestrings do not say whether they are open, land or island: they are taken for open "
        "water, and the rest of the border for land");
  }

  OceanLines& lines_;
  MeshInFile& file_;
  NodeNames nodes_;
  std::vector<std::array<std::int64_t, 3>> corners_;
  std::vector<NodeString> strings_;
  NodeString string_;  // the one whose end has not been read
};

// Returns the cards of a segment.
std::string cards_of(const mesh::BoundarySegment& segment, std::size_t id) {
  const std::vector<Index> nodes = closed_nodes(segment);
  std::string text;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (k % nodes_per_card == 0) text += k == 0 ? "NS" : "\nNS";
    text += k + 1 == nodes.size() ? " -" : " ";
    io::append_integer(text, std::uint64_t{nodes[k]} + 1);
  }
  append_word(text, std::uint64_t{id});
  return text + ' ' + std::string(name_of(segment.kind)) + '\n';
}

}  // namespace

void read_2dm(std::string_view text, MeshInFile& file) {
  OceanLines lines(text);
  try {
    SmsReader(lines, file).read();
  } catch (const BadValue& bad) {
    throw bad.line() != 0 ? bad : BadValue(bad.what(), lines.line());
  }
}

void write_2dm(io::AtomicFile& file, const MeshOfFile& mesh) {
  file.write("MESH2D\n");
  write_lines(file, mesh.execution, mesh.mesh.triangles.size(),
              [&](std::string& text, std::size_t i) {
                text += "E3T";
                append_word(text, std::uint64_t{i} + 1);
                append_nodes(text, mesh.mesh.triangles[i]);
                text += " 1";
              });
  write_lines(file, mesh.execution, mesh.positions.size(), [&](std::string& text, std::size_t i) {
    text += "ND";
    append_word(text, std::uint64_t{i} + 1);
    append_word(text, mesh.positions[i].lon_deg);
    append_word(text, mesh.positions[i].lat_deg);
    append_word(text, turned(mesh.depth(i)));
  });
  for (std::size_t s = 0; s < mesh.mesh.boundary.size(); ++s) {
    file.write(cards_of(mesh.mesh.boundary[s], s + 1));
  }
}

}  // namespace rondel::formats
