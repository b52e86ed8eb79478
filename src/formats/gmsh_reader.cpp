// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads Gmsh's text formats 4.1 and 2.2: nodes, triangles, lines in the groups open, land and island,
// and the view of depths. A file has sections, "$Nodes" to "$EndNodes"; others are passed over. In
// 2.2 an element has its group; in 4.1 it has a curve or surface, whose groups are in "$Entities".
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "exact/vector.h"
#include "formats/ocean_lines.h"
#include "io/number.h"
#include "rondel/names.h"

namespace rondel::formats {
namespace {

using io::BadValue;
using mesh::BoundaryKind;

constexpr std::int64_t line_element = 1;
constexpr std::int64_t triangle_element = 2;
constexpr std::int64_t point_element = 15;

// An element with its nodes by their numbers in the file.
struct GmshElement {
  std::array<std::int64_t, 3> nodes;
  std::int64_t entity = 0;
  std::int64_t group = 0;
  std::uint64_t line = 0;
};

// Lines that follow each other, by the indices of their nodes.
struct GmshSegment {
  BoundaryKind kind;
  std::int64_t group;
  std::int64_t curve;  // segments of different ones are not joined
  std::vector<Index> nodes;
  std::uint64_t line;

  [[nodiscard]] bool is_closed() const { return nodes.front() == nodes.back(); }
};

// Appends one segment to the end of another one, turned if that is where they meet.
void append(GmshSegment& segment, GmshSegment&& next) {
  if (next.nodes.front() != segment.nodes.back()) std::ranges::reverse(next.nodes);
  segment.nodes.insert(segment.nodes.end(), next.nodes.begin() + 1, next.nodes.end());
}

// Joins segments of one kind, group and curve where just two of them meet, and returns all in the order
// of their first lines.
std::vector<GmshSegment> joined(std::vector<GmshSegment> segments) {
  using End = std::tuple<BoundaryKind, std::int64_t, std::int64_t, Index>;
  std::map<End, std::vector<std::size_t>> at_end;
  const auto end_of = [](const GmshSegment& segment, Index node) {
    return End{segment.kind, segment.group, segment.curve, node};
  };
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (segments[s].is_closed()) continue;
    for (const Index node : {segments[s].nodes.front(), segments[s].nodes.back()}) {
      at_end[end_of(segments[s], node)].push_back(s);
    }
  }
  std::vector<GmshSegment> result;
  std::vector<bool> is_taken(segments.size());
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (is_taken[s]) continue;
    GmshSegment all = std::move(segments[s]);
    is_taken[s] = true;
    for (int direction = 0; direction < 2; ++direction) {
      while (!all.is_closed()) {
        const auto& meeting = at_end.at(end_of(all, all.nodes.back()));
        if (meeting.size() != 2) break;
        const std::size_t next = is_taken[meeting[0]] ? meeting[1] : meeting[0];
        if (is_taken[next]) break;
        is_taken[next] = true;
        append(all, std::move(segments[next]));
      }
      std::ranges::reverse(all.nodes);
    }
    result.push_back(std::move(all));
  }
  return result;
}

class GmshReader {
 public:
  GmshReader(OceanLines& lines, MeshInFile& file) : lines_(lines), file_(file) {}

  // Reads all sections.
  void read() {
    if (!lines_.next() || lines_.words()[0] != "$MeshFormat") throw BadValue("not a file of Gmsh");
    read_format();
    while (lines_.next()) {
      const std::string section(lines_.words()[0]);
      if (!section.starts_with('$')) {
        throw BadValue(io::in_quotes(section) + " where a section is needed");
      }
      if (section == "$PhysicalNames") read_groups();
      if (section == "$Entities" && is_version_4_) read_entities();
      if (section == "$PartitionedEntities" && is_version_4_) read_partitioned_entities();
      if (section == "$Nodes") is_version_4_ ? read_nodes4() : read_nodes2();
      if (section == "$ParametricNodes" && !is_version_4_) read_nodes2();
      if (section == "$Elements") is_version_4_ ? read_elements4() : read_elements2();
      if (section == "$NodeData") read_data();
      skip_to("$End" + section.substr(1));
    }
  }
  // Makes the mesh of what has been read. Errors have their lines.
  void finish() {
    nodes_.sort();
    for (const GmshElement& element : triangles_) {
      at_line(element.line, [&] {
        const auto [a, b, c] = element.nodes;
        file_.mesh.triangles.push_back({nodes_[a], nodes_[b], nodes_[c]});
      });
      file_.triangle_lines.push_back(element.line);
    }
    take_depths();
    join_lines();
    drop_free_nodes(file_);
    require_one_radius();
  }

 private:
  void skip_to(const std::string& end) {
    while (lines_.words()[0] != end) {
      if (!lines_.next()) throw BadValue("the file ends before " + end);
    }
  }

  void read_format() {
    lines_.require("line of the format", 0, 1);
    const std::string version(lines_.words()[0]);
    is_version_4_ = version == "4.1";
    if (!is_version_4_ && version != "2.2" && version != "2") {
      throw BadValue("version " + io::in_quotes(version) +
                     " of the format, where 4.1 or 2.2 is needed");
    }
    if (lines_.integer(1, "kind of file") != 0) {
      throw BadValue("the file is binary; Gmsh writes text with -setnumber Mesh.Binary 0");
    }
    skip_to("$EndMeshFormat");
  }

  void read_groups() {
    lines_.require("number of groups", 0, 1);
    const std::uint64_t count = lines_.count(0, "number of groups");
    for (std::uint64_t k = 0; k < count; ++k) {
      lines_.require("group", k, count);
      const std::int64_t dimension = lines_.integer(0, "dimension of a group");
      const std::int64_t group = lines_.integer(1, "number of a group");
      std::string name;
      for (std::size_t w = 2; w < lines_.words().size(); ++w) {
        if (w > 2) name += ' ';
        name += lines_.words()[w];
      }
      std::erase(name, '"');
      for (char& c : name) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
      }
      if (dimension == 1) groups_[group] = name;
    }
    lines_.require("end of the groups", 0, 1);
  }

  // Reads which groups curves are in.
  void read_entities() {
    read_curves([] { return std::size_t{7}; });
    lines_.require("end of the entities", 0, 1);
  }

  // Reads the same of the parts of curves in partitions, which are curves of their own.
  void read_partitioned_entities() {
    lines_.require("number of partitions", 0, 1);
    lines_.require("number of ghosts", 0, 1);
    const std::uint64_t num_ghosts = lines_.count(0, "number of ghosts");
    for (std::uint64_t i = 0; i < num_ghosts; ++i) lines_.require("ghost", i, num_ghosts);
    // A curve has its number, its parent (2), the partitions, a box (6), the groups.
    read_curves(
        [&] { return static_cast<std::size_t>(lines_.count(3, "number of partitions")) + 10; });
  }

  // Reads the numbers of entities, passes by the points and reads the curves. place() says which word of the
  // current line has the number of groups.
  template <class Place>
  void read_curves(const Place& place) {
    lines_.require("numbers of entities", 0, 1);
    const std::uint64_t num_points = lines_.count(0, "number of points");
    const std::uint64_t num_curves = lines_.count(1, "number of curves");
    for (std::uint64_t i = 0; i < num_points; ++i) lines_.require("point", i, num_points);
    for (std::uint64_t i = 0; i < num_curves; ++i) {
      lines_.require("curve", i, num_curves);
      read_groups_of_curve(place());
    }
  }

  // Reads the groups of a curve, whose number is word k: the first one that is a kind of boundary counts.
  void read_groups_of_curve(std::size_t k) {
    const std::uint64_t count = lines_.count(k, "number of groups");
    if (count == 0) return;
    const auto group = [&](std::uint64_t i) {
      return std::abs(lines_.integer(k + 1 + static_cast<std::size_t>(i), "number of a group"));
    };
    std::int64_t chosen = group(0);
    for (std::uint64_t i = 1; i < count && !kind_of(chosen); ++i) chosen = group(i);
    groups_of_curves_[lines_.integer(0, "number of a curve")] = chosen;
  }
  [[nodiscard]] std::optional<BoundaryKind> kind_of(std::int64_t group) const {
    const auto found = groups_.find(group);
    return found == groups_.end() ? std::nullopt : from_name<BoundaryKind>(found->second);
  }

  // Adds the node whose coordinates begin with word k.
  void add_point(std::size_t k) {
    const auto coordinate = [&](std::size_t i) { return lines_.number(k + i, "coordinate"); };
    file_.mesh.points.push_back({coordinate(0), coordinate(1), coordinate(2)});
    file_.node_lines.push_back(lines_.line());
  }

  void read_nodes2() {
    lines_.require("number of nodes", 0, 1);
    const std::uint64_t count = lines_.count(0, "number of nodes");
    for (std::uint64_t i = 0; i < count; ++i) {
      lines_.require("node", i, count);
      nodes_.add(lines_.count(0, "number of a node"));
      add_point(1);
    }
    lines_.require("end of the nodes", 0, 1);
  }

  void read_nodes4() {
    lines_.require("numbers of nodes", 0, 1);
    const std::uint64_t num_blocks = lines_.count(0, "number of blocks");
    for (std::uint64_t b = 0; b < num_blocks; ++b) {
      lines_.require("block of nodes", b, num_blocks);
      const std::uint64_t count = lines_.count(3, "number of nodes");
      for (std::uint64_t i = 0; i < count; ++i) {
        lines_.require("number of node", i, count);
        nodes_.add(lines_.count(0, "number of a node"));
      }
      for (std::uint64_t i = 0; i < count; ++i) {
        lines_.require("node", i, count);
        add_point(0);
      }
    }
    lines_.require("end of the nodes", 0, 1);
  }

  // Adds the element whose nodes begin with word k.
  void add_element(std::int64_t type, std::size_t k, std::int64_t entity, std::int64_t group) {
    if (type == point_element) return;
    if (type != line_element && type != triangle_element) {
      throw BadValue("an element of type " + std::to_string(type) +
                     ", where lines (1) and triangles (2) are needed");
    }
    const auto node = [&](std::size_t i) { return lines_.integer(k + i, "number of a node"); };
    GmshElement element{{node(0), node(1), 0}, entity, group, lines_.line()};
    if (type == triangle_element) element.nodes[2] = node(2);
    (type == line_element ? line_elements_ : triangles_).push_back(element);
  }

  void read_elements2() {
    lines_.require("number of elements", 0, 1);
    const std::uint64_t count = lines_.count(0, "number of elements");
    for (std::uint64_t i = 0; i < count; ++i) {
      lines_.require("element", i, count);
      const std::int64_t type = lines_.integer(1, "type of an element");
      const std::uint64_t num_tags = lines_.count(2, "number of tags");
      const std::int64_t group = num_tags > 0 ? lines_.integer(3, "tag") : 0;
      const std::int64_t entity = num_tags > 1 ? lines_.integer(4, "tag") : 0;
      add_element(type, 3 + num_tags, entity, group);
    }
    lines_.require("end of the elements", 0, 1);
  }

  void read_elements4() {
    lines_.require("numbers of elements", 0, 1);
    const std::uint64_t num_blocks = lines_.count(0, "number of blocks");
    for (std::uint64_t b = 0; b < num_blocks; ++b) {
      lines_.require("block of elements", b, num_blocks);
      const std::int64_t entity = lines_.integer(1, "number of a curve");
      const std::int64_t type = lines_.integer(2, "type of an element");
      const std::uint64_t count = lines_.count(3, "number of elements");
      const auto found = groups_of_curves_.find(entity);
      const std::int64_t group = found == groups_of_curves_.end() ? 0 : found->second;
      for (std::uint64_t i = 0; i < count; ++i) {
        lines_.require("element", i, count);
        add_element(type, 1, entity, group);
      }
    }
    lines_.require("end of the elements", 0, 1);
  }

  // Reads a view of one number at each node, if it is that of depths.
  void read_data() {
    std::vector<std::string> names;
    read_tags("text", [&] { names.emplace_back(lines_.words()[0]); });
    read_tags("number", [] {});
    std::vector<std::int64_t> integers;
    read_tags("integer", [&] { integers.push_back(lines_.integer(0, "tag")); });
    const std::string wanted = '"' + std::string(depth_view) + '"';
    if (names.empty() || names[0] != wanted || integers.size() < 3 || integers[1] != 1) return;
    for (std::int64_t i = 0; i < integers[2]; ++i) {
      lines_.require("value", static_cast<std::uint64_t>(i),
                     static_cast<std::uint64_t>(integers[2]));
      depths_.emplace_back(lines_.integer(0, "number of a node"), lines_.number(1, "depth"));
      depth_lines_.push_back(lines_.line());
    }
    lines_.require("end of the view", 0, 1);
  }

  // Reads a number of lines, and calls visit() at each of them.
  template <class Visit>
  void read_tags(const char* what, const Visit& visit) {
    lines_.require(what, 0, 1);
    const std::uint64_t count = lines_.count(0, "number of tags");
    for (std::uint64_t k = 0; k < count; ++k) {
      lines_.require(what, k, count);
      visit();
    }
  }

  // Gives nodes their depths; those without one are 0 deep, which a remark says.
  void take_depths() {
    if (depths_.empty()) return;
    const std::size_t num_nodes = file_.mesh.points.size();
    file_.mesh.depths.assign(num_nodes, 0);
    std::vector<bool> is_missing(num_nodes);
    for (const Triple& triangle : file_.mesh.triangles) {
      for (const Index node : triangle) is_missing[node] = true;
    }
    for (std::size_t i = 0; i < depths_.size(); ++i) {
      at_line(depth_lines_[i], [&] {
        const Index node = nodes_[depths_[i].first];
        file_.mesh.depths[node] = depths_[i].second;
        is_missing[node] = false;
      });
    }
    const auto number = std::ranges::count(is_missing, true);
    if (number == 0) return;
    file_.remarks.push_back(std::to_string(number) + (number == 1 ? " node has" : " nodes have") +
                            " no depth in the view of depths, and " +
                            (number == 1 ? "gets" : "get") + " the depth 0");
  }

  // Joins lines to segments: those of an island on all of its curves, others on each curve. Lines of
  // a curve may be in any order.
  void join_lines() {
    std::size_t num_others = 0;
    const GmshElement* last = nullptr;
    std::vector<GmshSegment> segments;
    for (const GmshElement& line : line_elements_) {
      const std::optional<BoundaryKind> kind = kind_of(line.group);
      if (!kind) {
        ++num_others;
        continue;
      }
      const bool is_next = last != nullptr && last->entity == line.entity &&
                           last->group == line.group && last->nodes[1] == line.nodes[0];
      at_line(line.line, [&] {
        if (!is_next) {
          const std::int64_t curve = *kind == BoundaryKind::island ? 0 : line.entity;
          segments.push_back({*kind, line.group, curve, {nodes_[line.nodes[0]]}, line.line});
        }
        segments.back().nodes.push_back(nodes_[line.nodes[1]]);
      });
      last = &line;
    }
    std::vector<GmshSegment> whole = joined(std::move(segments));
    for (GmshSegment& segment : whole) {
      file_.segment_lines.push_back(segment.line);
      add_segment(file_, {segment.kind, std::move(segment.nodes)});
    }
    file_.has_boundary = !file_.mesh.boundary.empty();
    if (num_others == 0) return;
    file_.remarks.push_back(std::to_string(num_others) +
                            " lines are in no physical group that is called open, land or island, "
                            "and are left out");
  }

  // Throws BadValue unless all nodes are on one sphere.
  void require_one_radius() const {
    const std::vector<Point>& points = file_.mesh.points;
    if (points.empty()) return;
    const double radius = exact::length_of(points[0]);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double length = exact::length_of(points[i]);
      if (std::abs(length - radius) <= radius / 1000) continue;
      std::string text = "the node is at the distance ";
      io::append_number(text, length);
      text += " from the origin, and the first one at ";
      io::append_number(text, radius);
      throw BadValue(text + ": nodes have to be on a sphere", file_.node_lines[i]);
    }
  }

  OceanLines& lines_;
  MeshInFile& file_;
  bool is_version_4_ = false;
  NodeNames nodes_;
  std::map<std::int64_t, std::string> groups_;  // of curves
  std::map<std::int64_t, std::int64_t> groups_of_curves_;
  std::vector<GmshElement> line_elements_;
  std::vector<GmshElement> triangles_;
  std::vector<std::pair<std::int64_t, double>> depths_;
  std::vector<std::uint64_t> depth_lines_;
};

}  // namespace

void read_gmsh(std::string_view text, MeshInFile& file) {
  OceanLines lines(text);
  GmshReader reader(lines, file);
  io::at_line_of(lines, [&] { reader.read(); });
  reader.finish();
}

}  // namespace rondel::formats
