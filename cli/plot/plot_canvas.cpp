// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "plot_canvas.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

#include <cstring>
#include <new>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace rondel::cli {

// Cairo counts references; each object here is released when its owner goes.
struct Release {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_pattern_t* pattern) const { cairo_pattern_destroy(pattern); }
};
template <typename Object>
using Owned = std::unique_ptr<Object, Release>;

namespace {

constexpr double margin = 0.02;  // share of the side, on each of the four sides

// Turns an error of Cairo into an exception.
void require(cairo_status_t status) {
  if (status == CAIRO_STATUS_NO_MEMORY) throw std::bad_alloc();
  if (status != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(std::string("drawing failed: ") + cairo_status_to_string(status));
  }
}

// Cairo calls this function from C, so no exception may leave it.
cairo_status_t append(void* bytes, const unsigned char* data, unsigned length) noexcept {
  try {
    static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
  } catch (...) {
    return CAIRO_STATUS_NO_MEMORY;
  }
}

// Makes the surface of a format; svg and pdf write their bytes to `bytes` while they are drawn.
cairo_surface_t* make_surface(FigureFormat format, int size, int height, std::string& bytes) {
  switch (format) {
    case FigureFormat::svg:
      return cairo_svg_surface_create_for_stream(append, &bytes, size, height);
    case FigureFormat::pdf: {
      cairo_surface_t* surface = cairo_pdf_surface_create_for_stream(append, &bytes, size, height);
      // An empty date writes no date; otherwise each run would write its own.
      cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "");
      return surface;
    }
    case FigureFormat::png:
      break;
  }
  return cairo_image_surface_create(CAIRO_FORMAT_RGB24, size, height);
}

// Removes the number of the surface: Cairo numbers the surfaces of a process and writes the number
// into the drawing.
void drop_surface_number(std::string& svg) {
  constexpr std::string_view id = "<g id=\"surface";
  const std::size_t start = svg.find(id);
  if (start == std::string::npos) return;
  const std::size_t digits = start + id.size();
  svg.erase(digits, svg.find('"', digits) - digits);
}

// Renumbers the images in the drawing from 0 on, for the same reason.
void number_images(std::string& svg) {
  for (const std::string word : {"image", "source-"}) {  // versions of Cairo differ
    const std::string id = "id=\"" + word;
    std::size_t count = 0;
    for (std::size_t at = svg.find(id); at != std::string::npos; at = svg.find(id, at + 1)) {
      const std::size_t digits = at + id.size();
      const std::string number = svg.substr(digits, svg.find('"', digits) - digits);
      const std::string ours = std::to_string(count++);
      svg.replace(digits, number.size(), ours);
      const std::string link = "href=\"#" + word;
      std::string use = link;
      use.append(number).append(1, '"');
      std::string our_use = link;
      our_use.append(ours).append(1, '"');
      for (std::size_t k = svg.find(use, at); k != std::string::npos; k = svg.find(use, k + 1)) {
        svg.replace(k, use.size(), our_use);
      }
    }
  }
}

// Sets the color of what is painted next.
void set_source(cairo_t* context, const Color& c) {
  cairo_set_source_rgba(context, c.red, c.green, c.blue, c.alpha);
}

}  // namespace

// The picture's y axis points down, that of the unit disc up.
struct Canvas::State {
  FigureFormat format;
  int size;
  double center, radius;
  std::string bytes;  // outlives the surface, which writes to it
  Owned<cairo_surface_t> surface;
  Owned<cairo_t> context;

  [[nodiscard]] double x(Spot p) const { return center + radius * p.x; }
  [[nodiscard]] double y(Spot p) const { return center - radius * p.y; }
};

Canvas::Canvas(FigureFormat format, int size, int below) : state_(std::make_unique<State>()) {
  state_->format = format;
  state_->size = size;
  state_->center = size / 2.0;
  state_->radius = radius_of(size);
  state_->surface.reset(make_surface(format, size, size + below, state_->bytes));
  state_->context.reset(cairo_create(state_->surface.get()));
  require(cairo_status(state_->context.get()));
  set_source(state_->context.get(), {1, 1, 1});
  cairo_paint(state_->context.get());
}

Canvas::~Canvas() = default;

double Canvas::radius() const noexcept { return state_->radius; }

double Canvas::radius_of(int size) noexcept { return size * (0.5 - margin); }

void Canvas::move_to(Spot to) {
  cairo_move_to(state_->context.get(), state_->x(to), state_->y(to));
}

void Canvas::line_to(Spot to) {
  cairo_line_to(state_->context.get(), state_->x(to), state_->y(to));
}

void Canvas::curve_to(Spot control1, Spot control2, Spot to) {
  cairo_curve_to(state_->context.get(), state_->x(control1), state_->y(control1),
                 state_->x(control2), state_->y(control2), state_->x(to), state_->y(to));
}

void Canvas::dot(Spot center, double radius) {
  cairo_new_sub_path(state_->context.get());
  cairo_arc(state_->context.get(), state_->x(center), state_->y(center), radius, 0,
            2 * std::numbers::pi);
}

void Canvas::globe() {
  cairo_arc(state_->context.get(), state_->center, state_->center, state_->radius, 0,
            2 * std::numbers::pi);
}

void Canvas::box(double left, double top, double width, double height) {
  cairo_rectangle(state_->context.get(), left, top, width, height);
}

void Canvas::text(const std::string& utf8, double x, double base, double letter_size,
                  TextAlign align, const Color& color) {
  cairo_t* context = state_->context.get();
  cairo_select_font_face(context, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, letter_size);
  cairo_text_extents_t extents;
  cairo_text_extents(context, utf8.c_str(), &extents);
  const double share = align == TextAlign::left ? 0 : align == TextAlign::center ? 0.5 : 1;
  set_source(context, color);
  cairo_move_to(context, x - share * extents.x_advance, base);
  cairo_show_text(context, utf8.c_str());
  cairo_new_path(context);
}

void Canvas::stroke(const Color& color, double width) {
  cairo_t* context = state_->context.get();
  set_source(context, color);
  cairo_set_line_width(context, width);
  // The ends of thin lines are smaller than a pixel, and round ones take most of the time.
  cairo_set_line_cap(context, width < 1 ? CAIRO_LINE_CAP_BUTT : CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  cairo_stroke(context);
}

void Canvas::fill(const Color& color) {
  set_source(state_->context.get(), color);
  cairo_fill(state_->context.get());
}

void Canvas::paint(std::span<const std::uint32_t> argb) {
  const int size = state_->size;
  const Owned<cairo_surface_t> image(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, size, size));
  require(cairo_surface_status(image.get()));
  const auto side = static_cast<std::size_t>(size);
  unsigned char* row = cairo_image_surface_get_data(image.get());
  for (std::size_t y = 0; y < side; ++y) {
    std::memcpy(row, argb.data() + y * side, side * sizeof(std::uint32_t));
    row += cairo_image_surface_get_stride(image.get());
  }
  cairo_surface_mark_dirty(image.get());
  cairo_set_source_surface(state_->context.get(), image.get(), 0, 0);
  cairo_paint(state_->context.get());
}

void Canvas::shade(const Color& inner, const Color& outer) {
  const double c = state_->center, r = state_->radius;
  const Owned<cairo_pattern_t> light(
      cairo_pattern_create_radial(c - 0.35 * r, c - 0.40 * r, 0.1 * r, c, c, r));
  cairo_pattern_add_color_stop_rgba(light.get(), 0, inner.red, inner.green, inner.blue,
                                    inner.alpha);
  cairo_pattern_add_color_stop_rgba(light.get(), 1, outer.red, outer.green, outer.blue,
                                    outer.alpha);
  cairo_set_source(state_->context.get(), light.get());
  cairo_fill(state_->context.get());
}

void Canvas::fill_to_seam(const Color& color) {
  set_source(state_->context.get(), color);
  cairo_fill_preserve(state_->context.get());
  stroke(color, seam_width);
}

std::string Canvas::finish() {
  require(cairo_status(state_->context.get()));
  if (state_->format == FigureFormat::png) {
    require(cairo_surface_write_to_png_stream(state_->surface.get(), append, &state_->bytes));
  }
  cairo_surface_finish(state_->surface.get());
  require(cairo_surface_status(state_->surface.get()));
  if (state_->format == FigureFormat::svg) {
    drop_surface_number(state_->bytes);
    number_images(state_->bytes);
  }
  return std::move(state_->bytes);
}

}  // namespace rondel::cli
