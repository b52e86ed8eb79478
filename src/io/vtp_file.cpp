// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/vtp_file.h"

namespace rondel::io {
namespace {

// Returns the text of an XML attribute.
std::string attribute(const std::string& name, const std::string& value) {
  return " " + name + "=\"" + value + "\"";
}

// Builds the XML head together with the list of arrays whose bytes follow in the same order.
class Head {
 public:
  void open(const std::string& tag) { text_ += "<" + tag + ">\n"; }
  void close(const std::string& tag) { text_ += "</" + tag + ">\n"; }

  void add(const VtpArray& array) {
    text_ += "<DataArray" + attribute("type", array.type) + attribute("Name", array.name) +
             attribute("NumberOfComponents", std::to_string(array.components)) +
             attribute("format", "appended") + attribute("offset", std::to_string(offset_)) +
             "/>\n";
    offset_ += sizeof(std::uint64_t) + array.num_bytes;
    arrays_.push_back(&array);
  }

  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] const std::vector<const VtpArray*>& arrays() const { return arrays_; }

 private:
  std::string text_;
  std::uint64_t offset_ = 0;
  std::vector<const VtpArray*> arrays_;
};

}  // namespace

void write_vtp(AtomicFile& file, const VtpMesh& mesh) {
  Head head;
  head.open(
      R"(VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64")");
  head.open("PolyData");
  head.open("Piece" + attribute("NumberOfPoints", std::to_string(mesh.num_points)) +
            attribute("NumberOfPolys", std::to_string(mesh.num_polys)));
  head.open("PointData");
  for (const VtpArray& array : mesh.point_data) head.add(array);
  head.close("PointData");
  head.open("CellData");
  for (const VtpArray& array : mesh.cell_data) head.add(array);
  head.close("CellData");
  head.open("Points");
  head.add(mesh.points);
  head.close("Points");
  head.open("Polys");
  head.add(mesh.connectivity);
  head.add(mesh.offsets);
  head.close("Polys");
  head.close("Piece");
  head.close("PolyData");

  file.write("<?xml version=\"1.0\"?>\n");
  file.write(head.text());
  file.write("<AppendedData encoding=\"raw\">\n_");
  for (const VtpArray* array : head.arrays()) {
    write_values<std::uint64_t>(file, 1, [array](std::size_t) { return array->num_bytes; });
    array->write(file);
  }
  file.write("\n</AppendedData>\n</VTKFile>\n");
}

}  // namespace rondel::io
