// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds which dimensions of a netCDF variable are those of the points.
//
// 1. Where longitudes and latitudes are known, the dimensions are theirs, in the order latitude,
//    longitude of axes, and else in that of the coordinates: a field stored as (time, lon, lat) is
//    that of (time, lat, lon). A variable with an attribute `coordinates` has the places that this
//    names, and no others.
// 2. All fields are at the same places: those that are wanted, or else those of the first variable
//    of which they are known for sure.
// 3. Else it is the dimension with as many entries as there are points, wherever it stands, or
//    dimensions that follow each other and multiply to that. Not so where the file has longitudes
//    and latitudes of as many points: then the variable is no field at them. All fields have the
//    same dimensions; where several fit, nothing says which, and that is an error.
// 4. Where the lengths of the points' grid are known and those of the dimensions are the same in
//    reverse, the order is reversed; where they are others, the variable is no field at the points.
//    Where both lengths are equal, names of dimensions and single axes decide
//    (field_orientation.cpp), and where these say nothing, a remark says so.
//
// in    a netCDF file, the number of points or their places, the shape of their grid
// out   for each variable which of its dimensions are those of the points, and in which order
// index positions of dimensions in the variable; variables and dimensions as the file numbers them
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "formats/cf_names.h"
#include "formats/coordinate_search.h"
#include "formats/field_formats.h"
#include "formats/place_list.h"
#include "io/bad_value.h"
#include "io/netcdf_reader.h"
#include "rondel/conventions.h"
#include "rondel/types.h"

namespace rondel::formats {

// The dimensions of one variable: those of its points, and the leading ones, such as times and
// levels.
struct FieldDimensions {
  // Positions of the dimensions that are not those of the points, in their order.
  std::vector<std::size_t> leading;
  // Positions of the points' dimensions, the one that varies fastest last.
  std::vector<std::size_t> points;
  // The places in degrees, by point; empty if the file has none for the variable, or several pairs.
  PlaceList places;
  // Indices of the points that have a place, if others are left out; `places` are theirs.
  std::vector<std::size_t> kept;
  // True if the lengths alone say that the order is reversed: no name or axis says it.
  bool is_reversed = false;
  std::string remark;  // a sentence on a choice that was made; else empty

  // Returns all dimensions in the order in which a FieldArray has its values.
  [[nodiscard]] std::vector<std::size_t> order() const;
};

// Variables have their points along different dimensions, and nothing says which are meant.
class SeveralReadings : public io::BadValue {
 public:
  using io::BadValue::BadValue;
};

// Answers for one file which dimensions of its variables are those of the points. The order in
// which variables are asked counts: by rule 3 the first one decides for those after it.
class FieldDimensionFinder {
 public:
  // `wanted` has the number of points, or 0 for those of the first variable whose places the file
  // says. `variables` are those that are read; they decide which places are meant.
  FieldDimensionFinder(const io::NetcdfReader& file, const FieldsToRead& wanted,
                       std::span<const io::VariableInFile* const> variables);

  // Returns the dimensions of a variable, or nothing if it is no field at the points. Throws
  // BadValue if it may be one in several ways.
  [[nodiscard]] std::optional<FieldDimensions> layout(const io::VariableInFile& variable);
  // Returns where the variable is for which layout() returned nothing, if that is known: "at lon_u
  // and lat, ...".
  [[nodiscard]] const std::string& why_not() const { return why_not_; }
  // Returns the coordinates of that variable, "lon_u and lat", if it has as many places as there
  // are points; otherwise an empty text.
  [[nodiscard]] const std::string& other_places() const { return other_places_; }
  // Returns the first of those places that is not the one that is wanted, "place 3 is at 5 40, not at
  // 5 41", if the caller wants places that no variable has; otherwise an empty text.
  [[nodiscard]] const std::string& first_other() const { return first_other_; }
  // Returns the coordinates of the points, "lon and lat"; an empty text if the file has none.
  [[nodiscard]] std::string names_of_places() const;
  // Returns a sentence on the other grids that variables have for which a layout was asked; an
  // empty text if there are none.
  [[nodiscard]] std::string remark_on_grids() const;
  // True if the variable is a coordinate, bounds, a part of a mesh or grid, or has the areas of its
  // cells: it is no field, unless it is named.
  [[nodiscard]] bool is_auxiliary(const io::VariableInFile& variable) const;
  // True for numbers along a dimension of their name that are no places: a time, a level.
  [[nodiscard]] bool is_plain_axis(const io::VariableInFile& variable) const;
  // True if the values of the variable depend on place, here or elsewhere (are_at_places()).
  [[nodiscard]] bool is_at_places(const io::VariableInFile& variable) const;
  // True if the variable has the areas or volumes of cells (are_measures_of_cells()).
  [[nodiscard]] bool is_measure_of_cells(const io::VariableInFile& variable) const;
  // True if the variable is a number or a text without dimensions, the bounds of another axis than
  // those of the points, or labels along a dimension of their name: these are no fields and no axes
  // of numbers.
  [[nodiscard]] bool is_lost(const io::VariableInFile& variable) const;

 private:
  // A pair of longitudes and latitudes that was read, in degrees.
  struct KnownPlaces {
    std::size_t lon;
    std::size_t lat;
    std::vector<std::size_t> dimensions;
    std::vector<std::uint64_t> shape;
    PlaceList places;
    std::size_t num_known;  // number of places with both coordinates present
  };
  // Places at which a variable may be, with the dimensions that follow from them.
  struct PossiblePlaces {
    std::size_t lon;
    std::size_t lat;
    FieldDimensions layout;
  };
  // The places of all fields.
  struct Anchor {
    std::size_t lon = CoordinatePair::none;  // none: the file has no such coordinates
    std::size_t lat = CoordinatePair::none;
    std::string variable;  // the variable that has them
    PlaceList places;
  };
  using DimensionSet = std::set<std::size_t>;
  // The dimensions, longer than 1, of all pairs of coordinates that are as many as the points.
  struct SetsOfPlaces {
    std::vector<DimensionSet> same;   // of coordinates that are those of the points
    std::vector<DimensionSet> other;  // of coordinates of as many other places
  };

  // Returns the places of two coordinates; each pair is read once.
  const KnownPlaces& places_of_pair(const CoordinatePair& pair);
  // Leaves out places without coordinates, if the wanted points are the others.
  void leave_out_missing(const KnownPlaces& known, FieldDimensions& layout) const;
  // Returns the dimensions of a variable at known places; `points` is empty if it is not at them.
  [[nodiscard]] FieldDimensions layout_along(const io::VariableInFile& variable,
                                             const KnownPlaces& known) const;
  // Returns the places that the variable's coordinates give, if these are as many as there are
  // points. Several results are different places of the same rank.
  [[nodiscard]] std::vector<PossiblePlaces> candidates(const io::VariableInFile& variable);
  // True if the places of two pairs are the same, up to the precision of their variables.
  [[nodiscard]] bool are_one_place(std::size_t lon_a, std::size_t lon_b, const PlaceList& a,
                                   const PlaceList& b) const;
  // True if the places of a candidate are those that all fields are at.
  [[nodiscard]] bool is_at_anchor(const PossiblePlaces& candidate) const;
  // Takes the variable with the numbers of pixels, if there is one. Throws BadValue if these are at
  // other places than those that are wanted.
  void take_pixels();
  // Sets the anchor, and with it the number of points if that is not given.
  void choose_places(std::span<const io::VariableInFile* const> variables);
  // Looks for a variable of the file that is at the wanted places, to name them in messages.
  void name_wanted_places();
  // Makes the places of a variable the anchor if they are those that are wanted.
  bool choose_wanted(const io::VariableInFile& variable);
  // Decides for the dimension that is called cells, if a variable has it.
  void choose_dimension_of_cells(std::span<const io::VariableInFile* const> variables);
  // These two functions implement rules 1 and 2, and rules 3 and 4.
  [[nodiscard]] std::optional<FieldDimensions> by_coordinates(const io::VariableInFile& variable);
  [[nodiscard]] std::optional<FieldDimensions> by_lengths(const io::VariableInFile& variable);
  // Returns the first of these places that is not the wanted one, in words.
  [[nodiscard]] std::string first_difference(const PlaceList& places) const;
  // These two functions return names of coordinates for messages, of one pair and of several.
  [[nodiscard]] std::string names_of(std::size_t lon, std::size_t lat) const;
  [[nodiscard]] std::string text_of_choice(const std::vector<PossiblePlaces>& found) const;
  // Returns the sets, which are found when they are first asked for.
  const SetsOfPlaces& sets_of_places();
  // True if `points`, positions of dimensions in the variable, may be those of the points although
  // no coordinates of the variable say so.
  [[nodiscard]] bool may_be_of_places(const io::VariableInFile& variable,
                                      std::span<const std::size_t> points);
  // True if these dimensions are those of the variables before. Throws SeveralReadings if nothing
  // says which of the two are meant.
  [[nodiscard]] bool has_same_dimensions(const io::VariableInFile& variable,
                                         std::span<const std::size_t> points);
  // Returns positions of dimensions that multiply to the number of points; empty if there are none.
  // Throws BadValue if several runs fit as well.
  [[nodiscard]] std::vector<std::size_t> run_of_points(const io::VariableInFile& variable) const;
  // True if a dimension counts times or heights.
  [[nodiscard]] bool is_other_axis(std::size_t dimension) const;

  // A dimension has the coordinate `kind`, if that is known, and the axis, if the file has one.
  struct NamedDirection {
    std::optional<CoordinateKind> kind;
    const io::VariableInFile* axis = nullptr;
  };
  // The functions below compare names and axes with the wanted places (field_orientation.cpp).
  // PlacesAlong is a dimension of the grid of places.
  struct PlacesAlong;
  [[nodiscard]] bool changes_along(const PlacesAlong& line, CoordinateKind kind) const;
  [[nodiscard]] std::optional<CoordinateKind> kind_of_rows(std::size_t rows,
                                                           std::size_t columns) const;
  [[nodiscard]] NamedDirection direction_of(std::size_t dimension) const;
  [[nodiscard]] bool fits_line(const NamedDirection& direction, const PlacesAlong& line) const;
  [[nodiscard]] std::string remark_on_order(const io::VariableInFile& variable, std::size_t rows,
                                            std::size_t columns) const;
  void orient_faces(const io::VariableInFile& variable, std::span<const std::size_t> places,
                    FieldDimensions& layout) const;
  // Puts the dimensions of a grid into the order of the points where names or axes say it. False if
  // an axis of the file has other coordinates than the points.
  [[nodiscard]] bool orient(const io::VariableInFile& variable, FieldDimensions& layout);

  const io::NetcdfReader& file_;
  std::uint64_t num_points_;
  // The lengths of the points' grid; empty if they are not known.
  std::vector<std::uint64_t> shape_;
  WantedPlaces wanted_;
  std::string list_of_pixels_;  // a variable; empty if there is none
  PlaceList wanted_places_;
  std::vector<VariableHeader> headers_;
  CoordinateSearch coordinates_;
  // The headers are by variable of the file, and so are these: true for parts of grids and meshes.
  std::vector<bool> parts_of_grids_;
  std::vector<bool> are_at_places_;
  std::vector<bool> are_measures_;
  // Places that were read. References to them stay valid when others are added.
  std::deque<KnownPlaces> known_;
  std::optional<SetsOfPlaces> sets_of_places_;
  std::optional<Anchor> anchor_;
  std::vector<std::string> other_pairs_;  // coordinates of variables that are not at the anchor
  // Dimensions that are longer than 1, of the first variable whose points were found by lengths,
  // and that variable.
  std::optional<DimensionSet> dimensions_of_points_;
  std::string first_by_lengths_;
  bool are_along_cells_ = false;  // the name of the points' dimension says that it counts cells
  // Answers to the last question, for why_not(), other_places() and first_other().
  std::string why_not_;
  std::string other_places_;
  std::string first_other_;
};

// Reverses the points' dimensions where the lengths of the grid are theirs in reverse; returns
// false if they are others. `points` are positions in the variable; `wanted` may be empty.
bool fit_lengths(std::span<const std::uint64_t> wanted, const io::VariableInFile& variable,
                 std::vector<std::size_t>& points);
// Makes the dimensions that are not those of the points the leading ones.
void take_other_dimensions(const io::VariableInFile& variable, FieldDimensions& layout);

}  // namespace rondel::formats
