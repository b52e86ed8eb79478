// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Geometries from and to Apache Arrow, through its C data interface: arrays of GeoArrow, which pandas,
/// Polars, DuckDB, R and GDAL exchange without a file (target rondel::geo).
#pragma once

#include <cstdint>

#include "rondel/export.h"
#include "rondel/geometries.h"
#include "rondel/polygon_files.h"

#ifndef ARROW_C_DATA_INTERFACE
#define ARROW_C_DATA_INTERFACE

// The interface itself: https://arrow.apache.org/docs/format/CDataInterface.html. Programs that
// use other libraries with it have these structs only once, by the name of the macro above. Names
// and types are those of the specification.
// NOLINTBEGIN(readability-identifier-naming)
extern "C" {

/// The type of an array.
struct ArrowSchema {
  const char* format;
  const char* name;
  const char* metadata;
  std::int64_t flags;
  std::int64_t n_children;
  ArrowSchema** children;
  ArrowSchema* dictionary;
  void (*release)(ArrowSchema*);
  void* private_data;
};

/// The values of an array.
struct ArrowArray {
  std::int64_t length;
  std::int64_t null_count;
  std::int64_t offset;
  std::int64_t n_buffers;
  std::int64_t n_children;
  const void** buffers;
  ArrowArray** children;
  ArrowArray* dictionary;
  void (*release)(ArrowArray*);
  void* private_data;
};

}  // extern "C"
// NOLINTEND(readability-identifier-naming)

#endif  // ARROW_C_DATA_INTERFACE

namespace rondel {

/// Copies polygons out of an array of the type geoarrow.polygon or geoarrow.multipolygon, whose
/// lists have offsets of 32 or 64 bits, and whose positions are interleaved or separated, with or
/// without further dimensions, which are left out. Element i becomes feature i; one that is null
/// has no polygons. Rings keep their last position, which is the first one again.
/// \param schema, array  stay with the caller, who releases them
/// \throws InvalidInput if the array has another type, or lists that do not fit; if it or its schema
///         was released; or if its type names another CRS than OGC:CRS84 or EPSG:4326, whose positions are longitudes and latitudes here
RONDEL_API LonLatMultiPolygons import_arrow(const ArrowSchema& schema, const ArrowArray& array);

/// Makes an array of the type geoarrow.multipolygon with interleaved positions and the CRS
/// OGC:CRS84, which says that edges are `spherical` if they are geodesic.
/// \param schema, array  get the type and the values; the caller calls their `release`, or gives
///         them to a library that does
/// \throws InvalidInput if offsets do not fit, or there are more than 2^31 - 1 positions
RONDEL_API void export_arrow(const LonLatMultiPolygons& features, PolygonEdges edges,
                             ArrowSchema& schema, ArrowArray& array);

/// Copies points, lines and polygons out of an array of one of the types geoarrow.point,
/// geoarrow.linestring, geoarrow.polygon, and those of several of them, as import_arrow() does. An
/// element that is null, and a point of NaN, has no part; a line of one position is a point.
/// \throws InvalidInput as import_arrow()
RONDEL_API LonLatGeometries import_arrow_geometries(const ArrowSchema& schema,
                                                    const ArrowArray& array);

/// The parts of geometries that an array of Arrow has.
enum class ArrowParts : std::uint8_t {
  points,    ///< the type geoarrow.multipoint: lines of one position
  lines,     ///< the type geoarrow.multilinestring: the other lines
  polygons,  ///< the type geoarrow.multipolygon
};

/// Makes an array of the points, the lines or the polygons of geometries, one element for each
/// geometry, as export_arrow() does for polygons alone.
/// \throws InvalidInput as export_arrow()
RONDEL_API void export_arrow(const LonLatGeometries& geometries, ArrowParts parts,
                             PolygonEdges edges, ArrowSchema& schema, ArrowArray& array);

}  // namespace rondel
