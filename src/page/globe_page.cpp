// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Assembles a globe page: the texts of page_text.h around the arrays of page_arrays.h.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "exact/angles.h"
#include "exact/vector.h"
#include "page/packed.h"
#include "page/page_arrays.h"
#include "page/page_input.h"
#include "page/page_text.h"
#include "rondel/globe.h"
#include "rondel/version.h"
#include "system/job.h"
#include "system/message_text.h"

namespace rondel {
namespace {

constexpr double degree = std::numbers::pi / 180;

// The initial view of the globe: the point in its middle, and the magnification relative to a view
// of the whole globe.
struct FirstView {
  LonLat middle;
  double closeness = 1;
};

// Returns a view that is filled by the sites if they are on one side of the globe, or else a view
// of the meridian of Greenwich from 20 degrees north.
FirstView view_of_sites(const std::vector<Point>& directions) {
  Point sum{};
  for (const Point& p : directions) sum = {sum.x + p.x, sum.y + p.y, sum.z + p.z};
  const double length = exact::length_of(sum);
  if (length <= 0.5 * static_cast<double>(directions.size()) || directions.empty())
    return {{0, 20}, 1};
  const Point middle{sum.x / length, sum.y / length, sum.z / length};
  double farthest = 0;
  for (const Point& p : directions) {
    farthest = std::max(farthest, exact::length_of(p - middle));
  }
  constexpr double smallest = 1e-11;  // a tenth of a millimetre on the earth
  const double height = std::sqrt(middle.x * middle.x + middle.y * middle.y);
  return {
      {exact::argument(middle.y, middle.x) / degree, exact::argument(middle.z, height) / degree},
      farthest > 0 ? std::max(1.0, 0.9 / std::max(farthest, smallest)) : 1.0};
}

// Returns the value as JSON in ASCII that cannot end the script element that contains it. Bytes
// that are not UTF-8 are replaced.
std::string script_json(const nlohmann::ordered_json& value) {
  std::string text;
  for (const char c : value.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace)) {
    if (c == '<') {
      text += R"(\u003c)";
    } else {
      text += c;
    }
  }
  return text;
}

// Returns the text with the characters that HTML reserves replaced by their names.
std::string html_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
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

// Returns the description of the page that the viewer reads first: counts, options, and the names
// and lengths of all arrays.
nlohmann::ordered_json about_page(const SiteTable& table, const Triangulation& triangulation,
                                  const GlobeOptions& options, const FirstView& view,
                                  const std::vector<page::PageArray>& arrays) {
  nlohmann::ordered_json about = {{"sites", triangulation.num_sites()},
                                  {"vertices", triangulation.num_vertices()},
                                  {"faces", triangulation.num_faces()},
                                  {"ghosts", triangulation.num_ghost_faces()},
                                  {"duplicates", triangulation.duplicates().size()},
                                  {"hidden", triangulation.hidden().size()},
                                  {"dimension", triangulation.dimension()},
                                  {"model", name_of(triangulation.model())},
                                  {"show", name_of(options.lines)},
                                  {"fill", name_of(options.fill)},
                                  {"showSites", options.show_sites},
                                  {"circles", options.show_circles},
                                  {"coast", options.show_coast},
                                  {"graticule", options.graticule_deg},
                                  {"view", {view.middle.lon_deg, view.middle.lat_deg}},
                                  {"closeness", view.closeness},
                                  {"up", options.up_deg},
                                  {"valueName", options.value_name},
                                  {"columns", nlohmann::ordered_json::array()},
                                  {"arrays", nlohmann::ordered_json::array()}};
  for (const Column& column : table.columns) {
    about["columns"].push_back({{"name", column.name}, {"isNumeric", column.is_numeric}});
  }
  for (const page::PageArray& array : arrays) {
    about["arrays"].push_back(
        {{"name", array.name}, {"kind", array.kind}, {"length", array.length}});
  }
  return about;
}

// Returns one script element for each array. The bytes of an array are freed when they have been
// packed.
std::string data_elements(std::vector<page::PageArray> arrays, const Execution& execution) {
  std::string text;
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    system::announce(execution, "page",
                     static_cast<double>(i) / static_cast<double>(arrays.size()));
    page::PageArray& array = arrays[i];
    const std::size_t width = array.kind == "f64" ? 8 : array.kind == "u32" ? 4 : 1;
    const std::string planes = page::in_planes(std::exchange(array.bytes, {}), width);
    text += R"(<script type="application/octet-stream" id="data-)" + array.name + R"(">)";
    text += page::base64(page::zlib_stream(planes, execution.threads));
    text += "</script>\n";
  }
  return text;
}

// Returns the template with each @NAME@ replaced by its text; the texts that were put in are not
// searched again.
std::string filled_in(std::string_view frame,
                      const std::vector<std::pair<std::string_view, std::string_view>>& places) {
  std::string page;
  std::size_t at = 0;
  for (std::size_t next = frame.find('@'); next != std::string_view::npos;
       next = frame.find('@', next)) {
    const auto place = std::ranges::find_if(
        places, [&](const auto& entry) { return frame.substr(next).starts_with(entry.first); });
    if (place == places.end()) {
      ++next;
      continue;
    }
    page += frame.substr(at, next - at);
    page += place->second;
    at = next += place->first.size();
  }
  page += frame.substr(at);
  return page;
}

}  // namespace

std::string_view name_of(GlobeLines lines) noexcept {
  return system::name_in({"delaunay", "voronoi", "both"}, lines);
}

std::string_view name_of(GlobeFill fill) noexcept {
  return system::name_in({"none", "area", "values"}, fill);
}

std::string globe_page(const SiteTable& table, const Triangulation& triangulation,
                       const Diagram& diagram, const GlobeOptions& options,
                       const Execution& execution) {
  const system::Call call(execution);
  page::require_input(table, triangulation, diagram, options);
  const std::vector<Point> directions = page::site_directions(triangulation);
  const FirstView view = options.view ? FirstView{*options.view} : view_of_sites(directions);
  std::vector<page::PageArray> arrays =
      page::page_arrays(table, triangulation, diagram, options, directions);
  std::ranges::move(page::column_arrays(table), std::back_inserter(arrays));
  const std::string_view coast = page::coast_text();
  arrays.push_back({"coast", "u8", std::string(coast), coast.size()});
  const std::string about = script_json(about_page(table, triangulation, options, view, arrays));
  const std::string data = data_elements(std::move(arrays), execution);
  const std::string title = html_text(options.title);
  return filled_in(page::frame_text(), {{"@TITLE@", title},
                                        {"@STYLE@", page::style_text()},
                                        {"@ABOUT@", about},
                                        {"@DATA@", data},
                                        {"@SCRIPT@", page::script_text()},
                                        {"@VERSION@", version}});
}

void write_globe(const FileName& file, const SiteTable& table, const Triangulation& triangulation,
                 const Diagram& diagram, const GlobeOptions& options, const Execution& execution) {
  write_file(file, globe_page(table, triangulation, diagram, options, execution));
}

}  // namespace rondel
