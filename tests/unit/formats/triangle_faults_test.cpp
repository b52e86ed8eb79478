// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Files of meshes of triangles with one fault each: the message has the file, the line and the value.
#include <gtest/gtest.h>

#include <string>

#include "rondel/error.h"
#include "rondel/triangle_files.h"
#include "support/temporary_files.h"
#include "support/thrown.h"

namespace rondel::test {
namespace {

// The message for a file of two triangles in which the first `old_text` is replaced.
class FaultyFile {
 public:
  FaultyFile(std::string format, std::string text)
      : format_(std::move(format)), text_(std::move(text)) {
    EXPECT_EQ(message(text_), "");
  }
  [[nodiscard]] std::string with(const std::string& old_text, const std::string& new_text) const {
    std::string text = text_;
    const std::size_t at = text.find(old_text);
    EXPECT_NE(at, std::string::npos) << old_text;
    return message(text.replace(at, old_text.size(), new_text));
  }
  [[nodiscard]] std::string until(const std::string& end) const {
    return message(text_.substr(0, text_.find(end)));
  }
  [[nodiscard]] std::string message(std::string text) const {
    return thrown_message<FileError>(
        [&] { return mesh::read_triangle_mesh(FileName::in_memory(text, format_, "f")); });
  }

 private:
  std::string format_;
  std::string text_;
};

TEST(triangle_faults, of_adcirc_have_a_line_and_a_value) {
  const FaultyFile file("14",
                        "title\n2 4\n1 0 0 5\n2 1 0 6\n3 1 1 7\n4 0 1 8\n1 3 1 2 3\n2 3 1 3 4\n"
                        "1\n2\n2\n1\n2\n1\n4\n4 0\n2\n3\n4\n1\n");
  EXPECT_EQ(file.message(""), "f: the file is empty");
  EXPECT_EQ(file.message("title"), "f:1: the file ends before line of counts 1 of 1");
  EXPECT_EQ(file.with("2 4", "2"), "f:2: the line ends before the number of nodes");
  EXPECT_EQ(file.with("2 4", "x 4"), "f:2: number of elements \"x\" is not an integer");
  EXPECT_EQ(file.with("2 4", "-1 4"), "f:2: number of elements -1 is negative or too large");
  EXPECT_EQ(file.with("2 4", "2 99999999999"),
            "f:2: number of nodes 99999999999 is negative or too large");
  EXPECT_EQ(file.with("2 4", "2 5"), "f:7: node 1 where 5 is needed");
  EXPECT_EQ(file.with("2 1 0 6", "2 1 95.5 6"), "f:4: latitude 95.5 is outside [-90, 90]");
  EXPECT_EQ(file.with("2 1 0 6", "2 1x 0 6"), "f:4: longitude \"1x\" is not a number");
  EXPECT_EQ(file.with("2 1 0 6", "2 1 0"), "f:4: the line ends before the depth");
  EXPECT_EQ(file.with("2 1 0 6", "2 1 0 nan"), "f:4: depth \"nan\" is not finite");
  EXPECT_EQ(file.with("3 1 1 7", "5 1 1 7"), "f:5: node 5 where 3 is needed");
  EXPECT_EQ(file.with("2 3 1 3 4", "2 4 1 3 4 2"),
            "f:8: element 2 has 4 corners, where a triangle is needed");
  EXPECT_EQ(file.with("2 3 1 3 4", "2 3 1 3 9"),
            "f:8: node 9 does not exist; there are 4 nodes, counted from 1");
  EXPECT_EQ(file.with("2 3 1 3 4", "2 3 1 3 0"),
            "f:8: node 0 does not exist; there are 4 nodes, counted from 1");
  EXPECT_EQ(file.with("2 3 1 3 4", "2 3 1 3 3"), "f:8: triangle 2 has no area: nodes 1, 3 and 3");
  EXPECT_EQ(file.with("2 3 1 3 4", "2 3 1 2 4"),
            "f:7: triangle 1 has the edge between nodes 1 and 2 in the direction in which triangle "
            "2 has it");
  EXPECT_EQ(file.with("2 3 1 3 4", "2 3 1 2 3"),
            "f:7: triangle 1 has the edge between nodes 1 and 2 in the direction in which triangle "
            "2 has it");
  EXPECT_EQ(file.until("1\n2\n2\n1\n2\n1\n4\n"), "");
  EXPECT_EQ(file.until("2\n3\n4\n1\n"), "f:16: the file ends before node of a boundary 1 of 4");
  EXPECT_EQ(file.with("\n4 0\n", "\n4\n"), "f:16: the line ends before the type of a boundary");
  EXPECT_EQ(file.with("\n4 0\n", "\n4 1000\n"),
            "f:16: type of a boundary 1000 is not from 0 to 999");
  EXPECT_EQ(file.until("1\n4\n4 0\n"),
            "f:13: the file ends before number of land boundaries 1 of 1");
  EXPECT_EQ(file.with("\n2\n2\n1\n2\n", "\n7\n2\n1\n2\n"),
            "f:10: total number of boundary nodes 7 where the boundaries have 2");
  EXPECT_EQ(file.with("\n4 0\n", "\n3 0\n"),
            "f:15: total number of boundary nodes 4 where the boundaries have 3");
  EXPECT_EQ(file.with("\n4 0\n2\n3", "\n4 0\n3\n2"),
            "f:16: segment 2: nodes 2 and 4 are not joined by an edge of the border");
}

TEST(triangle_faults, of_unused_nodes_have_a_line) {
  const FaultyFile file("gr3", "t\n1 3\n1 0 0 5\n2 1 0 6\n3 1 1 7\n1 3 1 2 3\n");
  EXPECT_EQ(file.message("t\n1 4\n1 0 0 5\n2 1 0 6\n3 9 9 9\n4 1 1 7\n1 3 1 2 4\n"),
            "f:5: node 3 is in no triangle");
}

TEST(triangle_faults, of_sms_have_a_line_and_a_value) {
  const FaultyFile file("2dm",
                        "MESH2D\nE3T 1 1 2 3 1\nE3T 2 1 3 4 1\nND 1 0 0 5\nND 2 1 0 6\nND 3 1 1 7\n"
                        "ND 4 0 1 8\nNS 1 -2 1 open\nNS 2 3 4 -1 2 land\n");
  EXPECT_EQ(file.with("MESH2D", "MESH3D"), "f:1: not a 2DM file");
  EXPECT_EQ(file.with("E3T 2 1 3 4 1", "E4Q 2 1 3 4 1 1"),
            "f:3: an element \"E4Q\", where E3T is needed");
  EXPECT_EQ(file.with("E3T 2 1 3 4", "E3T 2 1 3 5"), "f:3: node 5 does not exist");
  EXPECT_EQ(file.with("E3T 2 1 3 4 1", "E3T 2 1 3"),
            "f:3: the line ends before the number of a node");
  EXPECT_EQ(file.with("ND 4 0 1", "ND 3 0 1"), "f:9: two nodes have the number 3");
  EXPECT_EQ(file.with("ND 4 0 1", "ND 4 0 -91"), "f:7: latitude -91 is outside [-90, 90]");
  EXPECT_EQ(file.with("ND 4 0 1 8", "ND 4 0 1 h"), "f:7: elevation \"h\" is not a number");
  EXPECT_EQ(file.with("ND 4 0", "ND -4 0"), "f:7: number of a node -4 is negative or too large");
  EXPECT_EQ(file.with("NS 1 -2 1 open", "NS 1 -9 1 open"), "f:8: node 9 does not exist");
  EXPECT_EQ(file.with("NS 2 3 4 -1 2 land", "NS 2 3 4 1"),
            "f:9: the file ends within a nodestring");
  EXPECT_EQ(file.with("NS 1 -2 1 open", "NS 1 -3 1 open"),
            "f:8: segment 1: nodes 1 and 3 are not joined by an edge of the border");
}

TEST(triangle_faults, of_gmsh_have_a_line_and_a_value) {
  const FaultyFile file("msh",
                        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n1 1 \"open\"\n"
                        "$EndPhysicalNames\n$Nodes\n3\n1 1 0 0\n2 0 1 0\n3 0 0 1\n$EndNodes\n"
                        "$Elements\n2\n1 1 2 1 1 1 2\n2 2 2 4 1 1 2 3\n$EndElements\n$NodeData\n1\n"
                        "\"depth\"\n1\n0\n3\n0\n1\n1\n2 5\n$EndNodeData\n");
  EXPECT_EQ(file.with("$MeshFormat", "$Mesh"), "f:1: not a file of Gmsh");
  EXPECT_EQ(file.with("2.2 0", "4 0"),
            "f:2: version \"4\" of the format, where 4.1 or 2.2 is needed");
  EXPECT_EQ(file.with("2.2 0", "2.2 1"),
            "f:2: the file is binary; Gmsh writes text with -setnumber Mesh.Binary 0");
  EXPECT_EQ(file.with("$EndMeshFormat", ""), "f:29: the file ends before $EndMeshFormat");
  EXPECT_EQ(file.with("$Nodes\n3", "$Nodes\nn"), "f:9: number of nodes \"n\" is not an integer");
  EXPECT_EQ(file.with("3 0 0 1", "3 0 0"), "f:12: the line ends before the coordinate");
  EXPECT_EQ(
      file.with("3 0 0 1", "3 0 0 2"),
      "f:12: the node is at the distance 2 from the origin, and the first one at 1: nodes have "
      "to be on a sphere");
  EXPECT_EQ(file.with("3 0 0 1", "2 0 0 1"), "f: two nodes have the number 2");
  EXPECT_EQ(file.with("2 2 2 4 1 1 2 3", "2 3 2 4 1 1 2 3 1"),
            "f:17: an element of type 3, where lines (1) and triangles (2) are needed");
  EXPECT_EQ(file.with("2 2 2 4 1 1 2 3", "2 2 2 4 1 1 2 7"), "f:17: node 7 does not exist");
  EXPECT_EQ(file.with("1 1 2 1 1 1 2", "1 1 9 1 1 1 2"),
            "f:16: the line ends before the number of a node");
  EXPECT_EQ(file.with("\n2 5\n", "\n8 5\n"), "f:28: node 8 does not exist");
  EXPECT_EQ(file.with("\n2 5\n", "\n2 x\n"), "f:28: depth \"x\" is not a number");
  EXPECT_EQ(file.until("$EndElements"), "f:17: the file ends before end of the elements 1 of 1");
  EXPECT_EQ(file.with("$NodeData", "NodeData"), "f:19: \"NodeData\" where a section is needed");
}

TEST(triangle_faults, of_fesom_name_the_file) {
  const TemporaryDirectory folder;
  const auto message = [&](const std::string& nodes, const std::string& triangles,
                           const std::string& depths) {
    static_cast<void>(folder.with("nod2d.out", nodes));
    static_cast<void>(folder.with("elem2d.out", triangles));
    static_cast<void>(folder.with("aux3d.out", depths));
    const std::string text = thrown_message<FileError>(
        [&] { return mesh::read_triangle_mesh(FileName(folder.file(""))); });
    return text.substr(std::min(text.size(), folder.file("").size()));
  };
  const std::string nodes = "3\n1 0 0 1\n2 1 0 1\n3 0 1 1\n";
  const std::string depths = "3\n0 -10\n-20\n-1\n-2\n-3\n";
  EXPECT_EQ(message(nodes, "1\n1 2 3\n", depths), "");
  EXPECT_EQ(message(nodes, "1\n1 2 4\n", depths),
            "elem2d.out:2: node 4 does not exist; there are 3 nodes, counted from 1");
  EXPECT_EQ(message(nodes, "1\n1 2 2\n", depths),
            "elem2d.out:2: triangle 1 has no area: nodes 1, 2 and 2");
  EXPECT_EQ(message("4\n1 0 0 1\n2 1 0 1\n3 0 1 1\n4 5 5 0\n", "1\n1 2 3\n", depths + "-9\n"),
            "nod2d.out: node 4 is in no triangle");
  EXPECT_EQ(message("3\n1 0 0 1\n3 1 0 1\n", "", ""), "nod2d.out:3: node 3 where 2 is needed");
  EXPECT_EQ(message("1\n1 0 0\n", "", ""),
            "nod2d.out:2: the line ends before the mark of the coast");
  EXPECT_EQ(message(nodes, "1\n1 2 3\n", "3\n0 -10\n-20\n-1\n-2\n"),
            "aux3d.out:5: the file ends before depth 3 of 3");
  EXPECT_EQ(message(nodes, "1\n1 2 3\n", "3\n0 -10\n-5\n-1\n-2\n-3\n"),
            "nod2d.out: level 3 is not finite, or not deeper than the one before");
  EXPECT_EQ(message(nodes, "1\n1 2 3\n", "3\n0 x\n"), "aux3d.out:2: level \"x\" is not a number");
}

}  // namespace
}  // namespace rondel::test
