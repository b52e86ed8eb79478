// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// globe_page, write_globe: any sites have a page, which carries the faces and the areas of the diagram; the
// file is the page.
#include <string>
#include <vector>

#include "fuzz/scratch_folder.h"
#include "fuzz/table_input.h"
#include "rondel/diagram.h"
#include "rondel/globe.h"
#include "support/page_reader.h"

namespace rondel::fuzz {
namespace {

// Bytes as they come: a title and a column need not be text.
std::string next_text(ByteSource& source) {
  std::string text;
  for (std::size_t left = source.below(12); left > 0; --left)
    text += static_cast<char>(source.byte());
  return text;
}

Column next_column(ByteSource& source, std::size_t num_sites) {
  Column column;
  column.name = next_text(source);
  for (std::size_t i = 0; i < num_sites; ++i) {
    column.text += next_text(source);
    column.ends.push_back(column.text.size());
  }
  return column;
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  static const fuzz::ScratchFolder folder;
  fuzz::ByteSource source(data, size);
  Options options;
  options.model = source.byte() % 2 == 0 ? Model::projected : Model::weighted;
  GlobeOptions globe;
  globe.title = fuzz::next_text(source);
  SiteTable table = fuzz::next_table(source, fuzz::next_limit(source, 30));
  table.columns.push_back(fuzz::next_column(source, table.sites.size()));
  const Triangulation t = delaunay(table.sites, options);
  const Diagram both = diagram(t);
  const std::string page = globe_page(table, t, both, globe);
  fuzz::require(test::array_of_page<double>(page, "areas") == both.areas, "the areas are carried");
  fuzz::require(test::array_of_page<Index>(page, "faces").size() == 3 * t.num_faces(),
                "the faces are carried");
  fuzz::require(test::about_of(page)["columns"].size() == 1, "the column is carried");
  fuzz::require(coast_lines().values.size() == coast_lines().offsets.back(), "coasts end");
  const std::string path = folder.file("globe.html");
  write_globe(path, table, t, both, globe);
  fuzz::require(fuzz::content(path) == page, "the file is the page");
  return 0;
}
