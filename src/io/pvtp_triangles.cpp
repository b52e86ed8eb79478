// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Parallel VTK XML (.pvtp), of which ParaView's processes read a piece each: an XML file that names the
// pieces, and a folder beside it with these, .vtp files of runs of faces with the sites that they
// have.

#include <charconv>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "io/atomic_folder.h"
#include "io/ending.h"
#include "io/file_bytes.h"
#include "io/triangle_formats.h"
#include "io/vtp_file.h"
#include "rondel/error.h"
#include "system/parallel.h"

namespace rondel::io {
namespace {

constexpr std::string_view piece_begin = "piece_";
constexpr std::string_view piece_end = ".vtp";
constexpr std::string_view piece_maker = "made by rondel";

std::string piece_name(std::size_t i) {
  return std::string(piece_begin) + std::to_string(i) + std::string(piece_end);
}

bool is_piece(std::string_view name) {
  if (!name.starts_with(piece_begin) || !name.ends_with(piece_end)) return false;
  name.remove_prefix(piece_begin.size());
  std::size_t i = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), i);
  return error == std::errc{} && std::string_view(end) == piece_end;
}

// Other programs call pieces so, too.
std::string objection_to_pieces(const std::string& path) {
  constexpr const char* objection = "it was not made by rondel";
  try {
    const FileBytes piece(path + "/" + piece_name(0));
    return piece.head().find(piece_maker) == std::string_view::npos ? objection : "";
  } catch (const FileError&) {
    return objection;
  }
}

constexpr FolderKind pieces_kind = {&is_piece, &objection_to_pieces};

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

// Runs of faces, each with its sites in the order in which its faces have them.
class Pieces {
 public:
  explicit Pieces(const MeshToWrite& mesh)
      : mesh_(mesh),
        faces_(mesh.triangulation.faces()),
        places_(mesh.table.sites.size(), no_index) {}

  [[nodiscard]] std::size_t size() const { return system::num_pieces(faces_.size(), most_faces); }

  void write(std::size_t i, AtomicFile& file) {
    const std::size_t first = faces_.size() * i / size();
    const std::size_t end = faces_.size() * (i + 1) / size();
    number(faces_.subspan(first, end - first));
    VtpMesh vtp;
    vtp.comment = piece_maker;
    vtp.num_points = sites_.size();
    vtp.num_polys = end - first;
    vtp.points = vtp_array<double>("Points", 3 * sites_.size(), [this](std::size_t k) {
      const Point& p = mesh_.table.sites[sites_[k / 3]];
      return k % 3 == 0 ? p.x : k % 3 == 1 ? p.y : p.z;
    });
    vtp.points.components = 3;
    vtp.connectivity = vtp_array<std::int64_t>("connectivity", corners_.size(),
                                               [this](std::size_t k) { return corners_[k]; });
    vtp.offsets =
        vtp_array<std::int64_t>("offsets", end - first, [](std::size_t k) { return 3 * (k + 1); });
    vtp.point_data = {vtp_array<std::int64_t>("site", sites_.size(),
                                              [this](std::size_t k) { return sites_[k]; })};
    vtp.cell_data = {vtp_array<std::uint8_t>("ghost", end - first, [&](std::size_t k) {
      return mesh_.triangulation.is_ghost(static_cast<Index>(first + k)) ? 1 : 0;
    })};
    write_vtp(file, vtp);
  }

 private:
  static constexpr std::size_t most_faces = std::size_t{1} << 20U;

  void number(std::span<const Triple> faces) {
    for (const Index site : sites_) places_[site] = no_index;
    sites_.clear();
    corners_.clear();
    for (const Triple& face : faces) {
      for (const Index site : face) {
        if (places_[site] == no_index) {
          places_[site] = static_cast<Index>(sites_.size());
          sites_.push_back(site);
        }
        corners_.push_back(places_[site]);
      }
    }
  }

  const MeshToWrite& mesh_;
  std::span<const Triple> faces_;
  std::vector<Index> places_;  // of all sites, in the piece
  std::vector<Index> sites_;
  std::vector<Index> corners_;
};

constexpr std::string_view pvtp_head = R"(<?xml version="1.0"?>
<VTKFile type="PPolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<PPolyData GhostLevel="0">
<PPointData>
<PDataArray type="Int64" Name="site" NumberOfComponents="1"/>
</PPointData>
<PCellData>
<PDataArray type="UInt8" Name="ghost" NumberOfComponents="1"/>
</PCellData>
<PPoints>
<PDataArray type="Float64" Name="Points" NumberOfComponents="3"/>
</PPoints>
)";

}  // namespace

void write_pvtp(const std::string& path, const MeshToWrite& mesh) {
  constexpr std::string_view dot_pvtp = ".pvtp";
  if (ending(path) != dot_pvtp || path.ends_with('/'))
    throw FileError(path + ": the name of such a file ends in .pvtp");
  const std::string folder_path = path.substr(0, path.size() - dot_pvtp.size());
  AtomicFile file(path);
  AtomicFolder folder(folder_path, pieces_kind);
  file.write(pvtp_head);
  Pieces pieces(mesh);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    system::obey_stop();
    system::announce(mesh.execution, "write", i, pieces.size());
    std::string name = path;
    AtomicFile piece(folder.make_file(piece_name(i)), std::move(name));
    pieces.write(i, piece);
    piece.commit();
    const std::string source =
        std::filesystem::path(folder_path).filename().string() + "/" + piece_name(i);
    file.write("<Piece Source=\"" + escaped(source) + "\"/>\n");
  }
  file.write("</PPolyData>\n</VTKFile>\n");
  folder.commit();
  file.commit();
}

}  // namespace rondel::io
