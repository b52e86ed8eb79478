/* SPDX-FileCopyrightText: The Rondel authors
 * SPDX-License-Identifier: Apache-2.0 */

/**
 * \file
 * The C interface of Rondel: the functions of rondel/rondel.h, and those on polygons, for C and for every language that
 * can call C.
 *
 * 1. Functions that can fail return a status, 0 for success. After another status rondel_error_message() and
 *    rondel_error_index() say more; the content of output arrays is unspecified, and an output handle is NULL.
 *    A change of a rondel_dynamic that fails changes nothing.
 * 2. Handles are made by a function whose last argument is where to put them, and freed by the rondel_..._free() of
 *    their type, which takes NULL, too. Handles share what they need of each other and may be freed in any order.
 *    Functions that return no status take handles that are not NULL.
 * 3. Arrays that are passed are copied. Arrays that are returned belong to their handle, are never changed, and end
 *    with it. An array of no elements may be NULL, given or returned.
 * 4. Points are three doubles, x y z, so that n points are 3n doubles. Indices are 32 bits, RONDEL_NO_INDEX is none.
 *    Angles are radians unless their name ends in _deg. The numbering, the order and the meaning of all results are
 *    those of the C++ headers that are named below: the same bytes on every machine, for every number of threads.
 * 5. Handles that are const may be used by several threads at once.
 * 6. This interface grows by new functions only: what is declared here stays as it is while RONDEL_C_ABI is 1. The
 *    structs tell their size, so that they can grow at their ends: initialize them by their macros or functions.
 */
#ifndef RONDEL_C_H
#define RONDEL_C_H
/* NOLINTBEGIN(modernize-*,readability-identifier-naming): this is C */

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32) && defined(RONDEL_C_BUILD)
#define RONDEL_C_API __declspec(dllexport)
#elif defined(_WIN32)
#define RONDEL_C_API __declspec(dllimport)
#else
#define RONDEL_C_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define RONDEL_C_ABI 1
#define RONDEL_NO_INDEX UINT32_MAX

/* ---- Versions and errors ---- */

/** Returns the version of the running library, such as "0.1.0"; it may be newer than this header. */
RONDEL_C_API const char* rondel_version_string(void);

typedef int32_t rondel_status;
enum {
  RONDEL_OK = 0,
  RONDEL_INVALID_INPUT =
      1, /**< an argument breaks its contract; rondel_error_index() says which element */
  RONDEL_INTERRUPTED = 2, /**< a stop was requested, or a progress function returned non-zero */
  RONDEL_OUT_OF_MEMORY = 3,
  RONDEL_FAILED = 4 /**< anything else, such as threads that the system refuses */
};

/** Returns one line about the last failed call of this thread, or "". Valid until this thread calls again. */
RONDEL_C_API const char* rondel_error_message(void);
/** Returns the first offending position of the array that the message names; 0 if there is none. */
RONDEL_C_API size_t rondel_error_index(void);

/* ---- Options ---- */

enum {
  RONDEL_PROJECTED = 0, /**< a site is its exact projection on the sphere: Delaunay, Voronoi */
  RONDEL_WEIGHTED = 1   /**< a site is the circle whose pole it is: regular triangulation */
};

/** rondel/types.h: Options. NULL stands for the default: RONDEL_PROJECTED on the unit sphere around the origin. */
typedef struct rondel_options {
  size_t size; /**< sizeof(rondel_options) */
  int32_t model;
  double center[3];
  double squared_radius;
} rondel_options;

RONDEL_C_API void rondel_options_init(rondel_options* options);

/** A request to stop, which any thread may make. */
typedef struct rondel_stop rondel_stop;
RONDEL_C_API rondel_status rondel_stop_create(rondel_stop** stop);
/** Ends all work that was given this stop soon, with RONDEL_INTERRUPTED. A signal handler may call it. */
RONDEL_C_API void rondel_stop_request(rondel_stop* stop);
RONDEL_C_API void rondel_stop_free(rondel_stop* stop);

/** A function that is called now and then with the fraction of a stage that is done, by one of the working threads
 *  at a time. If it returns anything but 0, the work ends with RONDEL_INTERRUPTED, without further calls. */
typedef int32_t (*rondel_progress)(void* context, const char* stage, double fraction);

/** rondel/types.h: Execution. NULL stands for the default: a thread for each core, no progress, no stop. It changes no
 *  result. */
typedef struct rondel_execution {
  size_t size;      /**< sizeof(rondel_execution) */
  uint32_t threads; /**< at most; 0: one for each core */
  rondel_progress progress;
  void* context; /**< for `progress` */
  const rondel_stop* stop;
} rondel_execution;

RONDEL_C_API void rondel_execution_init(rondel_execution* execution);

/* ---- Sites (rondel/delaunay.h) ---- */

/** Writes the unit vectors, shape (n, 3), of n positions: longitude and latitude in degrees, shape (n, 2). */
RONDEL_C_API rondel_status rondel_unit_vectors(const double* lonlat_deg, size_t n, double* points);

/** Writes the weighted sites, shape (n, 3), of n circles: centers as above, angular radii in [0, 90) degrees. */
RONDEL_C_API rondel_status rondel_polar_points(const double* lonlat_deg, const double* radii_deg,
                                               size_t n, double* points);

/* ---- Triangulations (rondel/delaunay.h, triangulation.h, hull.h, check.h) ---- */

typedef struct rondel_triangulation rondel_triangulation;

/** Makes the Delaunay or regular triangulation of n points.
 *  RONDEL_INVALID_INPUT: a coordinate is not finite, a projected site is the center, the sphere is not valid. */
RONDEL_C_API rondel_status rondel_delaunay(const double* points, size_t n,
                                           const rondel_options* options,
                                           const rondel_execution* execution,
                                           rondel_triangulation** triangulation);

/** Makes the convex hull of n points in space. */
RONDEL_C_API rondel_status rondel_convex_hull(const double* points, size_t n,
                                              const rondel_execution* execution,
                                              rondel_triangulation** hull);

RONDEL_C_API void rondel_triangulation_free(rondel_triangulation* triangulation);

/** Returns -1 without sites; 0: one vertex; 1: all on one great circle, in rondel_ring(); 2: a closed surface of faces. */
RONDEL_C_API int32_t rondel_dimension(const rondel_triangulation* triangulation);
/** Returns RONDEL_PROJECTED or RONDEL_WEIGHTED. */
RONDEL_C_API int32_t rondel_model(const rondel_triangulation* triangulation);
/** Writes the center of the sphere; for a hull, the center that was chosen. */
RONDEL_C_API void rondel_center(const rondel_triangulation* triangulation, double center[3]);
/** Returns "ring", "incremental", "sphere", "blocks", or "given" for a snapshot. */
RONDEL_C_API const char* rondel_builder(const rondel_triangulation* triangulation);

RONDEL_C_API size_t rondel_num_sites(const rondel_triangulation* triangulation);
RONDEL_C_API size_t rondel_num_vertices(const rondel_triangulation* triangulation);
RONDEL_C_API size_t rondel_num_faces(const rondel_triangulation* triangulation);
RONDEL_C_API size_t rondel_num_ghost_faces(const rondel_triangulation* triangulation);
RONDEL_C_API size_t rondel_num_ring(const rondel_triangulation* triangulation);
RONDEL_C_API size_t rondel_num_duplicates(const rondel_triangulation* triangulation);
RONDEL_C_API size_t rondel_num_hidden(const rondel_triangulation* triangulation);

/** The sites, shape (num_sites, 3). */
RONDEL_C_API const double* rondel_points(const rondel_triangulation* triangulation);
/** Corners of the faces, counterclockwise seen from outside, shape (num_faces, 3). */
RONDEL_C_API const uint32_t* rondel_faces(const rondel_triangulation* triangulation);
/** The face across the edge opposite to each corner, shape (num_faces, 3). */
RONDEL_C_API const uint32_t* rondel_neighbors(const rondel_triangulation* triangulation);
/** The faces that the center does not see from inside, increasing, shape (num_ghost_faces,). */
RONDEL_C_API const uint32_t* rondel_ghost_faces(const rondel_triangulation* triangulation);
/** Below dimension 2: the vertices in their order around the great circle, shape (num_ring,). */
RONDEL_C_API const uint32_t* rondel_ring(const rondel_triangulation* triangulation);
/** Pairs of a site and the lowest one in the same place, increasing, shape (num_duplicates, 2). */
RONDEL_C_API const uint32_t* rondel_duplicates(const rondel_triangulation* triangulation);
/** Pairs of a site that is no vertex and a face below which it lies, increasing, shape (num_hidden, 2). */
RONDEL_C_API const uint32_t* rondel_hidden(const rondel_triangulation* triangulation);

/** Proves or refutes that m triangles, shape (m, 3), are the faces of the triangulation of n points. Returns RONDEL_OK
 *  and writes 1 or 0; after 0, rondel_error_message() says what is wrong. */
RONDEL_C_API rondel_status rondel_check(const double* points, size_t n, const uint32_t* triangles,
                                        size_t m, const rondel_options* options,
                                        const rondel_execution* execution, int32_t* is_valid);

/** Writes volume and surface area of a triangulation that rondel_convex_hull() made.
 *  RONDEL_INVALID_INPUT: the sites are projected, or the center is outside of their hull. */
RONDEL_C_API rondel_status rondel_size_of_hull(const rondel_triangulation* hull, double* volume,
                                               double* area);

/* ---- Duals (rondel/diagram.h) ----
 *
 * Areas, centroids and diagrams are those of Delaunay faces: RONDEL_INVALID_INPUT for a triangulation with constraints
 * (rondel_constrained_triangulation()) that has others. Circumcenters, edges and facets are those of any faces. */

/** Circumcenters or power centers, unit vectors, shape (num_faces, 3). */
RONDEL_C_API rondel_status rondel_circumcenters(const rondel_triangulation* triangulation,
                                                const rondel_execution* execution, double* centers);
/** Areas of the cells in steradians, shape (num_sites,). */
RONDEL_C_API rondel_status rondel_areas(const rondel_triangulation* triangulation,
                                        const rondel_execution* execution, double* areas);
/** Directions of the cells' centers of mass, unit vectors, shape (num_sites, 3). */
RONDEL_C_API rondel_status rondel_centroids(const rondel_triangulation* triangulation,
                                            const rondel_execution* execution, double* centroids);
/** Writes at most `capacity` edges, shape (capacity, 2), lower index first, in lexicographic order, and their whole
 *  number. */
RONDEL_C_API rondel_status rondel_edges(const rondel_triangulation* triangulation, uint32_t* edges,
                                        size_t capacity, size_t* num_edges);

/** The cells of all sites and their areas. */
typedef struct rondel_diagram rondel_diagram;
RONDEL_C_API rondel_status rondel_diagram_create(const rondel_triangulation* triangulation,
                                                 const rondel_execution* execution,
                                                 rondel_diagram** diagram);
RONDEL_C_API void rondel_diagram_free(rondel_diagram* diagram);
/** The ring of site i is rings[offsets[i]] ... rings[offsets[i + 1] - 1]; shape (num_sites + 1,). */
RONDEL_C_API const uint64_t* rondel_cell_offsets(const rondel_diagram* diagram);
/** Positions in rondel_cell_points(), counterclockwise seen from outside. */
RONDEL_C_API const uint32_t* rondel_cell_rings(const rondel_diagram* diagram);
/** Unit vectors, shape (num_cell_points, 3); first the circumcenters of all faces. */
RONDEL_C_API const double* rondel_cell_points(const rondel_diagram* diagram);
RONDEL_C_API size_t rondel_num_cell_points(const rondel_diagram* diagram);
/** Steradians, shape (num_sites,). */
RONDEL_C_API const double* rondel_cell_areas(const rondel_diagram* diagram);

/** Lists of indices in compressed rows. */
typedef struct rondel_lists rondel_lists;
RONDEL_C_API void rondel_lists_free(rondel_lists* lists);
RONDEL_C_API size_t rondel_num_lists(const rondel_lists* lists);
/** List i is items[offsets[i]] ... items[offsets[i + 1] - 1]; shape (num_lists + 1,). */
RONDEL_C_API const uint64_t* rondel_list_offsets(const rondel_lists* lists);
RONDEL_C_API const uint32_t* rondel_list_items(const rondel_lists* lists);

/** The facets with their cocircular sites, as lists of corners. */
RONDEL_C_API rondel_status rondel_merge_cocircular(const rondel_triangulation* triangulation,
                                                   const rondel_execution* execution,
                                                   rondel_lists** facets);

/* ---- Queries (rondel/query.h) ---- */

typedef struct rondel_dynamic rondel_dynamic;
typedef struct rondel_locator rondel_locator;

RONDEL_C_API rondel_status rondel_locator_create(const rondel_triangulation* triangulation,
                                                 rondel_locator** locator);
/** Makes a locator whose sites are ids. After the next change of `dynamic` its queries return RONDEL_INVALID_INPUT. */
RONDEL_C_API rondel_status rondel_locator_create_dynamic(const rondel_dynamic* dynamic,
                                                         rondel_locator** locator);
RONDEL_C_API void rondel_locator_free(rondel_locator* locator);

/** Writes the nearest vertex of each of n points, shape (n,); of several the lowest. */
RONDEL_C_API rondel_status rondel_nearest(const rondel_locator* locator, const double* points,
                                          size_t n, const rondel_execution* execution,
                                          uint32_t* sites);
/** Writes the k nearest vertices of each of n points in order of distance, shape (n, k), filled up with RONDEL_NO_INDEX. */
RONDEL_C_API rondel_status rondel_k_nearest(const rondel_locator* locator, const double* points,
                                            size_t n, size_t k, const rondel_execution* execution,
                                            uint32_t* sites);
/** Finds the vertices within an angle in radians of each of n points, as lists in increasing order. */
RONDEL_C_API rondel_status rondel_within(const rondel_locator* locator, const double* points,
                                         size_t n, double angle, const rondel_execution* execution,
                                         rondel_lists** sites);

enum { RONDEL_VERTEX = 0, RONDEL_EDGE = 1, RONDEL_FACE = 2, RONDEL_OUTSIDE = 3 };
/** Finds the vertex, edge or face that the ray through each of n points meets: its kind `where`, shape (n,); a face that
 *  contains it, shape (n,); its one, two or three sites, filled up with RONDEL_NO_INDEX, shape (n, 3). */
RONDEL_C_API rondel_status rondel_locate(const rondel_locator* locator, const double* points,
                                         size_t n, const rondel_execution* execution,
                                         int32_t* where, uint32_t* faces, uint32_t* sites);
/** Writes the distance in radians between one point and a site. */
RONDEL_C_API rondel_status rondel_distance(const rondel_locator* locator, const double point[3],
                                           uint32_t site, double* distance);

/* ---- Changes (rondel/dynamic.h) ---- */

/** Makes a dynamic triangulation with n sites, whose ids are 0 ... n-1. */
RONDEL_C_API rondel_status rondel_dynamic_create(const double* points, size_t n,
                                                 const rondel_options* options,
                                                 const rondel_execution* execution,
                                                 rondel_dynamic** dynamic);
RONDEL_C_API void rondel_dynamic_free(rondel_dynamic* dynamic);

/** Adds n sites and writes their ids, shape (n,). */
RONDEL_C_API rondel_status rondel_insert(rondel_dynamic* dynamic, const double* points, size_t n,
                                         const rondel_execution* execution, uint32_t* ids);
RONDEL_C_API rondel_status rondel_remove(rondel_dynamic* dynamic, const uint32_t* ids, size_t n,
                                         const rondel_execution* execution);
/** Moves site ids[i] to point i. */
RONDEL_C_API rondel_status rondel_move(rondel_dynamic* dynamic, const uint32_t* ids,
                                       const double* points, size_t n,
                                       const rondel_execution* execution);

/** Moves all sites at once, the i-th of rondel_dynamic_ids() to point i: by flips where that takes less
 *  time than a build. n is rondel_dynamic_num_sites(). */
RONDEL_C_API rondel_status rondel_move_all(rondel_dynamic* dynamic, const double* points, size_t n,
                                           const rondel_execution* execution);

RONDEL_C_API size_t rondel_dynamic_num_sites(const rondel_dynamic* dynamic);
/** Writes the ids in use, increasing, shape (dynamic_num_sites,). */
RONDEL_C_API rondel_status rondel_dynamic_ids(const rondel_dynamic* dynamic, uint32_t* ids);
/** Finds the vertices adjacent to a vertex, counterclockwise from the lowest: one list. */
RONDEL_C_API rondel_status rondel_dynamic_neighbors(const rondel_dynamic* dynamic, uint32_t id,
                                                    rondel_lists** ids);
/** Makes a copy of the current triangulation; its site i is the i-th of rondel_dynamic_ids(). */
RONDEL_C_API rondel_status rondel_dynamic_snapshot(const rondel_dynamic* dynamic,
                                                   rondel_triangulation** snapshot);

/* ---- Polygons (rondel/polygon_files.h, cell_rings.h) ---- */

/* A library that is built without polygons (RONDEL_BUILD_POLYGONS=OFF) lacks this section and those that follow up to
 * "Predicates". */

#ifndef ARROW_C_DATA_INTERFACE
#define ARROW_C_DATA_INTERFACE

/* https://arrow.apache.org/docs/format/CDataInterface.html: the structs as they stand there. */
struct ArrowSchema {
  const char* format;
  const char* name;
  const char* metadata;
  int64_t flags;
  int64_t n_children;
  struct ArrowSchema** children;
  struct ArrowSchema* dictionary;
  void (*release)(struct ArrowSchema*);
  void* private_data;
};

struct ArrowArray {
  int64_t length;
  int64_t null_count;
  int64_t offset;
  int64_t n_buffers;
  int64_t n_children;
  const void** buffers;
  struct ArrowArray** children;
  struct ArrowArray* dictionary;
  void (*release)(struct ArrowArray*);
  void* private_data;
};

#endif /* ARROW_C_DATA_INTERFACE */

/** Multipolygons in longitude and latitude, as files and other programs have them. They need not be valid. */
typedef struct rondel_features rondel_features;

/** Makes n features. Feature i has the polygons features[i] ... features[i + 1] - 1, polygon p the rings polygons[p] ...
 *  polygons[p + 1] - 1, the outer one first, and ring r the positions rings[r] ... rings[r + 1] - 1, of which the last
 *  one is the first one again. All three arrays begin with 0 and have one element more than there are features,
 *  polygons and rings.
 *  `lonlat_deg` has longitude and latitude of each position in degrees, shape (number of positions, 2).
 *  RONDEL_INVALID_INPUT: an array does not begin with 0, or decreases (the index of the element). */
RONDEL_C_API rondel_status rondel_features_create(const uint64_t* features, size_t n,
                                                  const uint64_t* polygons, const uint64_t* rings,
                                                  const double* lonlat_deg, rondel_features** made);
/** Copies the polygons out of an array of the type geoarrow.polygon or geoarrow.multipolygon, one feature for each
 *  element (rondel/arrow.h). Schema and array stay with the caller, who releases them.
 *  RONDEL_INVALID_INPUT: another type, lists that do not fit, or another CRS than OGC:CRS84 or EPSG:4326. */
RONDEL_C_API rondel_status rondel_features_import_arrow(const struct ArrowSchema* schema,
                                                        const struct ArrowArray* array,
                                                        rondel_features** made);
/** Writes an array of the type geoarrow.multipolygon, one element for each feature, and its type. The caller calls
 *  their `release`, or gives them to a library that does; they need the features no longer.
 *  `edges` is what the type says of edges: RONDEL_LONLAT or RONDEL_GEODESIC.
 *  RONDEL_INVALID_INPUT: more than 2^31 - 1 positions. */
RONDEL_C_API rondel_status rondel_features_export_arrow(const rondel_features* features,
                                                        int32_t edges, struct ArrowSchema* schema,
                                                        struct ArrowArray* array);
RONDEL_C_API void rondel_features_free(rondel_features* features);

RONDEL_C_API size_t rondel_num_features(const rondel_features* features);
/** The arrays of rondel_features_create(), shapes (num_features + 1,), (number of polygons + 1,) and (number of rings +
 *  1,). The last element of an array is the number of elements that it counts. */
RONDEL_C_API const uint64_t* rondel_feature_polygons(const rondel_features* features);
RONDEL_C_API const uint64_t* rondel_feature_rings(const rondel_features* features);
RONDEL_C_API const uint64_t* rondel_feature_positions(const rondel_features* features);
/** Longitudes and latitudes in degrees, shape (number of positions, 2). */
RONDEL_C_API const double* rondel_feature_lonlat(const rondel_features* features);

enum {
  RONDEL_LONLAT =
      0, /**< lines between positions are straight in longitude and latitude (RFC 7946) */
  RONDEL_GEODESIC = 1 /**< they are the shorter arcs of great circles */
};
enum {
  RONDEL_REFUSE = 0, /**< a feature that is not valid is an error */
  RONDEL_REPAIR =
      1 /**< it gets the places that an odd number of its rings' sides divides from the outside */
};

/** rondel/polygon_files.h: PolygonOptions. NULL stands for the default: RONDEL_LONLAT, RONDEL_REFUSE, 1e-4. */
typedef struct rondel_reading {
  size_t size; /**< sizeof(rondel_reading) */
  int32_t edges;
  int32_t invalid;
  double
      tolerance_deg; /**< how far arcs may be from the straight lines that they stand for; positive */
} rondel_reading;

RONDEL_C_API void rondel_reading_init(rondel_reading* reading);

/** Texts, each of which ends with a zero. */
typedef struct rondel_texts rondel_texts;
RONDEL_C_API void rondel_texts_free(rondel_texts* texts);
RONDEL_C_API size_t rondel_num_texts(const rondel_texts* texts);
/** Returns text i; i < num_texts. */
RONDEL_C_API const char* rondel_text(const rondel_texts* texts, size_t i);

/** Finds out which features are not valid: text i is what is wrong with feature i, with ring and place, and empty if it
 *  is valid. `invalid` of the options has no effect.
 *  RONDEL_INVALID_INPUT: the index of a feature with a position that is no longitude and latitude. */
RONDEL_C_API rondel_status rondel_feature_faults(const rondel_features* features,
                                                 const rondel_reading* reading,
                                                 const rondel_execution* execution,
                                                 rondel_texts** faults);

/** Polygons whose sides are the shorter arcs of great circles between corners, which are doubles. Each has any number of
 *  rings, with the interior to their left; a polygon without rings is empty, or the whole sphere. */
typedef struct rondel_polygons rondel_polygons;

/** Makes features into polygons: polygon i is feature i. Features are read together, so that they have the same corners
 *  along sides that they share.
 *  RONDEL_INVALID_INPUT: the index of a feature that is not valid, unless features are repaired. */
RONDEL_C_API rondel_status rondel_polygons_of_features(const rondel_features* features,
                                                       const rondel_reading* reading,
                                                       const rondel_execution* execution,
                                                       rondel_polygons** made);
/** Makes n polygons of unit vectors. Polygon i has the rings polygons[i] ... polygons[i + 1] - 1, and ring r the corners
 *  rings[r] ... rings[r + 1] - 1, of which the first one is not repeated. Both arrays begin with 0. Rings may cross and
 *  repeat each other; rondel_repair() makes such polygons valid. A ring without corners adds nothing to its polygon.
 *  `corners` are unit vectors, shape (number of corners, 3). `whole` has the polygons that are the whole sphere,
 *  increasing, shape (num_whole,); they have no rings.
 *  RONDEL_INVALID_INPUT: an array does not fit, or the index of a corner that is no unit vector. */
RONDEL_C_API rondel_status rondel_polygons_create(const uint64_t* polygons, size_t n,
                                                  const uint64_t* rings, const double* corners,
                                                  const uint32_t* whole, size_t num_whole,
                                                  rondel_polygons** made);
RONDEL_C_API void rondel_polygons_free(rondel_polygons* polygons);

RONDEL_C_API size_t rondel_num_polygons(const rondel_polygons* polygons);
/** The arrays of rondel_polygons_create(), shapes (num_polygons + 1,) and (number of rings + 1,). */
RONDEL_C_API const uint64_t* rondel_polygon_rings(const rondel_polygons* polygons);
RONDEL_C_API const uint64_t* rondel_polygon_corners(const rondel_polygons* polygons);
/** Unit vectors, shape (number of corners, 3). */
RONDEL_C_API const double* rondel_polygon_points(const rondel_polygons* polygons);
RONDEL_C_API const uint32_t* rondel_whole_polygons(const rondel_polygons* polygons);
RONDEL_C_API size_t rondel_num_whole_polygons(const rondel_polygons* polygons);

/** Makes polygons into valid features within [-180, 180] x [-90, 90], cut at the antimeridian and the poles
 *  (rondel/regions.h: region_polygons(), CellDrawing::apart): feature i is polygon i, without a polygon if that is empty.
 *  `tolerance_deg` is how far straight lines may be from arcs in degrees; positive. 0.01 is usual. */
RONDEL_C_API rondel_status rondel_features_of_polygons(const rondel_polygons* polygons,
                                                       double tolerance_deg,
                                                       const rondel_execution* execution,
                                                       rondel_features** made);

/** Writes the area of each polygon in steradians, shape (num_polygons,). A polygon that crosses or overlaps itself has
 *  none; rondel_repair() makes it valid. */
RONDEL_C_API rondel_status rondel_polygon_areas(const rondel_polygons* polygons, double* areas);
/** Writes the length of each border in radians, shape (num_polygons,). */
RONDEL_C_API rondel_status rondel_polygon_lengths(const rondel_polygons* polygons, double* lengths);

/* ---- Set operations, relations and buffers (rondel/set_operations.h, relate.h, buffer.h) ---- */

enum {
  RONDEL_UNION = 0,                /**< what is in A or in B */
  RONDEL_INTERSECTION = 1,         /**< what is in both */
  RONDEL_DIFFERENCE = 2,           /**< what is in A and not in B */
  RONDEL_SYMMETRIC_DIFFERENCE = 3, /**< what is in one of the two alone */
  RONDEL_IDENTITY = 4              /**< what is in A, divided by B */
};

/** Computes a set operation on two regions, of which each is the union of some polygons; the result is one polygon. Places
 *  where sides cross are rounded to doubles, all else is exact, and results can be operands again.
 *  RONDEL_INVALID_INPUT: the index of a side, counted by its first corner, that leads to the opposite point. */
RONDEL_C_API rondel_status rondel_combine(const rondel_polygons* a, const rondel_polygons* b,
                                          int32_t operation, const rondel_execution* execution,
                                          rondel_polygons** made);
/** Computes the union of all polygons: one polygon. */
RONDEL_C_API rondel_status rondel_unite(const rondel_polygons* polygons,
                                        const rondel_execution* execution, rondel_polygons** made);
/** Computes a set operation on n pairs of a polygon of A and one of B, shape (n, 2): polygon k is that of pair k.
 *  RONDEL_INVALID_INPUT: the index of a pair with a polygon that does not exist, or that rondel_combine() refuses. */
RONDEL_C_API rondel_status rondel_combine_pairs(const rondel_polygons* a, const rondel_polygons* b,
                                                const uint32_t* pairs, size_t n, int32_t operation,
                                                const rondel_execution* execution,
                                                rondel_polygons** made);
/** Makes each polygon valid, without a change of its places: those that an odd number of its rings' sides divides from
 *  the outside. */
RONDEL_C_API rondel_status rondel_repair(const rondel_polygons* polygons,
                                         const rondel_execution* execution, rondel_polygons** made);

/** The length of a relation with the zero at its end. */
#define RONDEL_RELATION_SIZE 10

/** Writes how polygon i of A lies to polygon i of B, for each i: nine characters of 2 1 0 F, the DE-9IM matrix, and a zero;
 *  shape (n, RONDEL_RELATION_SIZE). If one of A and B has one polygon, n is the number of the other one's.
 *  RONDEL_INVALID_INPUT: numbers do not fit; the index of a polygon that is not valid (rondel_repair()) or has a side that
 *  leads to the opposite point. */
RONDEL_C_API rondel_status rondel_relate(const rondel_polygons* a, const rondel_polygons* b,
                                         const rondel_execution* execution, char* relations);
/** Writes the relations of n pairs of a polygon of A and one of B, shape (n, 2). */
RONDEL_C_API rondel_status rondel_relate_pairs(const rondel_polygons* a, const rondel_polygons* b,
                                               const uint32_t* pairs, size_t n,
                                               const rondel_execution* execution, char* relations);
/** Writes 1 if a relation fits to a pattern of nine characters T (not F), F, 0, 1, 2 or * (anything), else 0. */
RONDEL_C_API rondel_status rondel_relation_matches(const char* relation, const char* pattern,
                                                   int32_t* matches);
/** Finds the pairs of polygons that have a place in common and whose relation fits to a pattern; NULL stands for any. List
 *  i has the polygons of B, increasing, that are so related to polygon i of A. */
RONDEL_C_API rondel_status rondel_related(const rondel_polygons* a, const rondel_polygons* b,
                                          const char* pattern, const rondel_execution* execution,
                                          rondel_lists** related);

/** Computes the places within a distance of each polygon, or, if it is negative, those that remain without the places so
 *  near to the border. Both in radians.
 *  `tolerance` is how far the border may be from the places at the distance; 0 stands for a thousandth of it. */
RONDEL_C_API rondel_status rondel_buffer(const rondel_polygons* polygons, double distance,
                                         double tolerance, const rondel_execution* execution,
                                         rondel_polygons** made);
/** Computes a disk around each of n unit vectors, shape (n, 3). */
RONDEL_C_API rondel_status rondel_buffer_points(const double* points, size_t n, double distance,
                                                double tolerance, const rondel_execution* execution,
                                                rondel_polygons** made);

/* ---- Points, lines and polygons (rondel/geometries.h, arrow.h) ---- */

/** Geometries in longitude and latitude, each of any points, lines and polygons, as files and other programs have them.
 *  A line of one position is a point. They need not be valid. */
typedef struct rondel_lonlat_geometries rondel_lonlat_geometries;

/** Makes n geometries. Geometry i has the lines groups[i] ... groups[i + 1] - 1, and line k the positions lines[k] ...
 *  lines[k + 1] - 1. Both arrays begin with 0 and have one element more than there are geometries and lines.
 *  `lonlat_deg` has longitude and latitude of each position in degrees, shape (number of positions, 2).
 *  `polygons` has a feature for each geometry; NULL: no geometry has polygons.
 *  RONDEL_INVALID_INPUT: an array does not begin with 0, or decreases (the index of the element); the number of features
 *  is not n. */
RONDEL_C_API rondel_status rondel_lonlat_geometries_create(const uint64_t* groups, size_t n,
                                                           const uint64_t* lines,
                                                           const double* lonlat_deg,
                                                           const rondel_features* polygons,
                                                           rondel_lonlat_geometries** made);
/** Copies geometries out of an array of one of the types geoarrow.point, linestring, polygon, multipoint,
 *  multilinestring and multipolygon, one for each element. Schema and array stay with the caller, who releases them.
 *  RONDEL_INVALID_INPUT: as rondel_features_import_arrow(). */
RONDEL_C_API rondel_status rondel_lonlat_geometries_import_arrow(const struct ArrowSchema* schema,
                                                                 const struct ArrowArray* array,
                                                                 rondel_lonlat_geometries** made);
enum {
  RONDEL_POINT_PARTS = 0,  /**< lines of one position, as geoarrow.multipoint */
  RONDEL_LINE_PARTS = 1,   /**< the other lines, as geoarrow.multilinestring */
  RONDEL_POLYGON_PARTS = 2 /**< polygons, as geoarrow.multipolygon */
};
/** Writes an array of one kind of parts, one element for each geometry, and its type, as
 *  rondel_features_export_arrow() does. */
RONDEL_C_API rondel_status rondel_lonlat_geometries_export_arrow(
    const rondel_lonlat_geometries* geometries, int32_t parts, int32_t edges,
    struct ArrowSchema* schema, struct ArrowArray* array);
RONDEL_C_API void rondel_lonlat_geometries_free(rondel_lonlat_geometries* geometries);

RONDEL_C_API size_t rondel_num_lonlat_geometries(const rondel_lonlat_geometries* geometries);
/** The arrays of rondel_lonlat_geometries_create(), shapes (num_lonlat_geometries + 1,) and (number of lines + 1,). */
RONDEL_C_API const uint64_t* rondel_lonlat_line_groups(const rondel_lonlat_geometries* geometries);
RONDEL_C_API const uint64_t* rondel_lonlat_lines(const rondel_lonlat_geometries* geometries);
/** Longitudes and latitudes in degrees, shape (number of positions, 2). */
RONDEL_C_API const double* rondel_lonlat_line_positions(const rondel_lonlat_geometries* geometries);
/** Returns the polygons, which belong to the geometries. */
RONDEL_C_API const rondel_features* rondel_lonlat_polygons(
    const rondel_lonlat_geometries* geometries);

/** Geometries of points, lines and polygons on the sphere, whose lines and sides are shorter arcs of great circles. */
typedef struct rondel_geometries rondel_geometries;

/** Makes sets of geometries into geometries on the sphere, one handle for each set. Sets are read together, so that what
 *  meets there meets on the sphere, too, and their geometries can be operands of each other.
 *  `made` gets the handles, shape (num_sets,).
 *  RONDEL_INVALID_INPUT: the index, counted over all sets, of a geometry that is not valid, unless they are repaired; of a
 *  line that jumps by more than 180 degrees of longitude or leads to the opposite place. */
RONDEL_C_API rondel_status rondel_geometries_of_lonlat(const rondel_lonlat_geometries* const* sets,
                                                       size_t num_sets,
                                                       const rondel_reading* reading,
                                                       const rondel_execution* execution,
                                                       rondel_geometries** made);
/** Makes n geometries: as rondel_lonlat_geometries_create(), of unit vectors, shape (number of points, 3), and polygons of
 *  arcs, of which there are n or, NULL, none.
 *  RONDEL_INVALID_INPUT: an array does not fit, or the index of a point that is no unit vector. */
RONDEL_C_API rondel_status rondel_geometries_create(const uint64_t* groups, size_t n,
                                                    const uint64_t* lines, const double* points,
                                                    const rondel_polygons* polygons,
                                                    rondel_geometries** made);
RONDEL_C_API void rondel_geometries_free(rondel_geometries* geometries);

RONDEL_C_API size_t rondel_num_geometries(const rondel_geometries* geometries);
/** The arrays of rondel_geometries_create(), shapes (num_geometries + 1,) and (number of lines + 1,). */
RONDEL_C_API const uint64_t* rondel_line_groups(const rondel_geometries* geometries);
RONDEL_C_API const uint64_t* rondel_lines(const rondel_geometries* geometries);
/** Unit vectors, shape (number of points, 3). */
RONDEL_C_API const double* rondel_line_points(const rondel_geometries* geometries);
/** Returns the polygons, one for each geometry, which belong to the geometries. */
RONDEL_C_API const rondel_polygons* rondel_geometry_polygons(const rondel_geometries* geometries);
/** Writes the length of each geometry's lines in radians, shape (num_geometries,). */
RONDEL_C_API rondel_status rondel_line_lengths(const rondel_geometries* geometries,
                                               double* lengths);

/** Makes geometries into valid ones within [-180, 180] x [-90, 90], cut at the antimeridian and the poles, as
 *  rondel_features_of_polygons() does for polygons. */
RONDEL_C_API rondel_status rondel_lonlat_of_geometries(const rondel_geometries* geometries,
                                                       double tolerance_deg,
                                                       const rondel_execution* execution,
                                                       rondel_lonlat_geometries** made);

/** Computes a set operation on two sets of geometries, of which each counts as its union; the result is one geometry: the
 *  polygon, the lines that are not in it, and the points that are in neither (rondel/geometries.h: combine()).
 *  RONDEL_INVALID_INPUT: the index of a geometry, those of B after those of A, that leads to the opposite point or has a
 *  line without points. */
RONDEL_C_API rondel_status rondel_combine_geometries(const rondel_geometries* a,
                                                     const rondel_geometries* b, int32_t operation,
                                                     const rondel_execution* execution,
                                                     rondel_geometries** made);
/** Computes the union of all geometries: one geometry. */
RONDEL_C_API rondel_status rondel_unite_geometries(const rondel_geometries* geometries,
                                                   const rondel_execution* execution,
                                                   rondel_geometries** made);
/** Computes a set operation on n pairs of a geometry of A and one of B, shape (n, 2): geometry k is that of pair k.
 *  RONDEL_INVALID_INPUT: the index of a pair with a geometry that does not exist, or that is refused as above. */
RONDEL_C_API rondel_status rondel_combine_geometry_pairs(
    const rondel_geometries* a, const rondel_geometries* b, const uint32_t* pairs, size_t n,
    int32_t operation, const rondel_execution* execution, rondel_geometries** made);

/** The pieces into which two sets divide each other, sorted by their two owners. */
typedef struct rondel_pieces rondel_pieces;

/** Divides polygons of A and of B by each other: into what one of each has in common, and what is in one set alone. The
 *  operation says which of these are wanted: what is in common unless it is a difference; what is in A alone unless it is
 *  the intersection; what is in B alone for the union and the symmetric difference.
 *  RONDEL_INVALID_INPUT: as rondel_combine(). */
RONDEL_C_API rondel_status rondel_overlay_pieces(const rondel_polygons* a, const rondel_polygons* b,
                                                 int32_t operation,
                                                 const rondel_execution* execution,
                                                 rondel_pieces** made);
/** Divides geometries of A and of B by each other. Unless `keeps_touching` is 0, there are pieces, too, in which two
 *  geometries only touch or cross, such as the point in which a river meets a border.
 *  RONDEL_INVALID_INPUT: as rondel_combine_geometries(). */
RONDEL_C_API rondel_status rondel_overlay_geometry_pieces(const rondel_geometries* a,
                                                          const rondel_geometries* b,
                                                          int32_t operation, int32_t keeps_touching,
                                                          const rondel_execution* execution,
                                                          rondel_pieces** made);
RONDEL_C_API void rondel_pieces_free(rondel_pieces* pieces);

RONDEL_C_API size_t rondel_num_pieces(const rondel_pieces* pieces);
/** The polygon or geometry of A and that of B of each piece, RONDEL_NO_INDEX for none; shape (num_pieces,). */
RONDEL_C_API const uint32_t* rondel_piece_owners_in_a(const rondel_pieces* pieces);
RONDEL_C_API const uint32_t* rondel_piece_owners_in_b(const rondel_pieces* pieces);
/** Returns the pieces as geometries, which belong to them. */
RONDEL_C_API const rondel_geometries* rondel_piece_geometries(const rondel_pieces* pieces);

/* ---- Triangles of polygons (rondel/polygon_triangles.h) ---- */

typedef struct rondel_triangles rondel_triangles;

/** Triangulates polygons together, exactly and never outside of them. `spacing_deg` is the length of the longest sides of
 *  triangles in degrees, about; 0: no points are added for the sake of it. Corners of triangles are those of polygons, places where
 *  sides cross, and, where polygons need them, points of the axes.
 *  RONDEL_INVALID_INPUT: the spacing is negative, not finite or too small; the index of a polygon that has a side
 *  that leads to the opposite point, or whose sides do not close rings that have the interior on one side. */
RONDEL_C_API rondel_status rondel_triangulate_polygons(const rondel_polygons* polygons,
                                                       double spacing_deg,
                                                       const rondel_execution* execution,
                                                       rondel_triangles** made);
RONDEL_C_API void rondel_triangles_free(rondel_triangles* triangles);

RONDEL_C_API size_t rondel_num_triangle_points(const rondel_triangles* triangles);
/** Unit vectors, shape (num_triangle_points, 3). */
RONDEL_C_API const double* rondel_triangle_points(const rondel_triangles* triangles);
/** Polygon i has the triangles offsets[i] ... offsets[i + 1] - 1; shape (num_polygons + 1,). */
RONDEL_C_API const uint64_t* rondel_triangle_offsets(const rondel_triangles* triangles);
/** Positions in rondel_triangle_points(), counterclockwise seen from outside, shape (number of triangles, 3). */
RONDEL_C_API const uint32_t* rondel_triangle_corners(const rondel_triangles* triangles);

/* ---- Triangulations with given edges (rondel/constrained.h) ---- */

/** A triangulation in which given arcs, the constraints, are chains of edges; all other edges are locally Delaunay. */
typedef struct rondel_constrained rondel_constrained;

/** What becomes of constraints that cross each other in the inside of both. */
enum {
  RONDEL_REFUSE_CROSSINGS = 0, /**< RONDEL_INVALID_INPUT, whose message names both and the place */
  RONDEL_SPLIT_CROSSINGS =
      1 /**< each crossing, rounded to doubles, becomes a site behind the others */
};

/** Makes the constrained Delaunay triangulation of n points and of constraints, pairs of positions of points, shape
 *  (num_constraints, 2). Constraints may be repeated, overlap, and have points on them. The model is RONDEL_PROJECTED.
 *  RONDEL_INVALID_INPUT: as rondel_delaunay() (the index of the point); an end of a constraint is no point, or both ends are
 *  in one place or opposite to each other (the index of the constraint); two constraints cross (the larger index) and are
 *  not split; they are split, and the points are no unit vectors. */
RONDEL_C_API rondel_status rondel_constrained_delaunay(
    const double* points, size_t n, const uint32_t* constraints, size_t num_constraints,
    const rondel_options* options, int32_t crossings, const rondel_execution* execution,
    rondel_constrained** constrained);
RONDEL_C_API void rondel_constrained_free(rondel_constrained* constrained);

/** Makes a handle of its points and faces, which shares their arrays. What relies on Delaunay faces refuses it,
 *  unless all its faces are: rondel_locator_create(), rondel_areas(), rondel_centroids() and rondel_diagram_create(). */
RONDEL_C_API rondel_status rondel_constrained_triangulation(const rondel_constrained* constrained,
                                                            rondel_triangulation** triangulation);

RONDEL_C_API size_t rondel_num_constrained_edges(const rondel_constrained* constrained);
/** The edges that are parts of constraints, the lower index first, sorted; shape (num_constrained_edges, 2). */
RONDEL_C_API const uint32_t* rondel_constrained_edges(const rondel_constrained* constrained);
/** Edge i is a part of the constraints sources[offsets[i]] ... sources[offsets[i + 1] - 1], ascending; shape
 *  (num_constrained_edges + 1,). */
RONDEL_C_API const uint64_t* rondel_constrained_source_offsets(
    const rondel_constrained* constrained);
RONDEL_C_API const uint32_t* rondel_constrained_sources(const rondel_constrained* constrained);
/** For each face, bit i is set if the edge opposite to its corner i is a part of a constraint; shape (num_faces,). */
RONDEL_C_API const uint8_t* rondel_constrained_sides(const rondel_constrained* constrained);

/* ---- Predicates (rondel/predicates.h), exact ---- */

/** Writes -1, 0 or 1: the sign of det(a - o, b - o, c - o), o the center of the sphere. */
RONDEL_C_API rondel_status rondel_orientation(const double a[3], const double b[3],
                                              const double c[3], const rondel_options* options,
                                              int32_t* sign);
/** Writes 1 if p is in conflict with the face a, b, c: outside its plane; 0 if all four are in one. */
RONDEL_C_API rondel_status rondel_side_of_circle(const double a[3], const double b[3],
                                                 const double c[3], const double p[3],
                                                 const rondel_options* options, int32_t* sign);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-*,readability-identifier-naming) */
#endif /* RONDEL_C_H */
