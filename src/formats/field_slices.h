// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads the fields of a netCDF file slice by slice, in an amount of memory that does not depend on
// the size of the file.
//
// in    an open file, the names of the wanted fields (or all), the points
// out   names, dimensions and attributes; then the values of any range of fields
// index arrays in the order of fields().arrays; fields of an array, the last leading dimension
//       fastest
#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "formats/cf_values.h"
#include "formats/field_blocks.h"
#include "formats/field_formats.h"
#include "formats/field_layout.h"
#include "io/netcdf_reader.h"
#include "rondel/fields.h"

namespace rondel::formats {

// The fields of a netCDF file. The file must live as long as this object.
class FieldSlices {
 public:
  // Throws BadValue if a named variable is missing or is no field at the points.
  FieldSlices(const io::NetcdfReader& file, const FieldsToRead& wanted,
              std::size_t max_per_block = usual_block);

  // Returns the arrays without their values; only coordinates along axes have values here.
  [[nodiscard]] const FieldSet& fields() const { return fields_; }
  // Returns the array that a name means, like FieldFile::find().
  [[nodiscard]] std::optional<std::size_t> find(const std::string& name) const;
  // Sets how many bytes of chunks are kept for each array, like FieldFile::keep_chunks().
  void keep_chunks(std::size_t bytes);
  // Returns how many bytes read() takes beside its result, like FieldFile::bytes_beside().
  [[nodiscard]] std::uint64_t bytes_beside() const;
  // Reads fields `first` ... of an array into `out`, as many as fit, like FieldFile::read().
  void read(std::size_t array, std::size_t first, std::span<double> out, unsigned threads) const;
  // Reads points `first_point` ... of one field, like FieldFile::read_points().
  void read_points(std::size_t array, std::size_t field, std::size_t first_point,
                   std::span<double> out) const;

 private:
  // A variable with what is needed to read its fields.
  struct SlicedVariable {
    const io::VariableInFile* variable;
    std::size_t num_points;  // with the points that are left out
    FieldDimensions layout;
    FieldBlocks blocks;
    ValueRules rules;
    std::size_t first;  // first field: the only one, if one of several is chosen by its indices
  };

  // Adds a variable; returns false if it is no field at the points.
  bool add(const io::VariableInFile& variable);
  // Adds one field of a variable, "tas[3]" for example; returns false if the name means none.
  bool add_one_of_several(const std::string& name);
  // Adds a variable whose dimensions are known; the first one with places sets those of the set.
  void add_with_layout(const io::VariableInFile& variable, FieldDimensions layout);
  // Adds all fields of the file, with remarks on the variables that are left out.
  void add_all();
  // A variable that is no field at the points. It may not be kept if it is at other places.
  struct ApartVariable {
    const io::VariableInFile* variable;
    bool may_be_kept;
  };
  // Adds to `others` what does not depend on place, with remarks on the rest.
  void keep_others(std::span<const ApartVariable> apart);
  // True if the variable has a dimension of the points, or of any other places.
  [[nodiscard]] bool depends_on_place(const io::VariableInFile& variable) const;
  // Returns a dimension of the variable of which nothing says what it counts, or an empty text.
  [[nodiscard]] std::string unknown_dimension(const io::VariableInFile& variable) const;
  // Returns the dimension of the variable whose index says that places are gathered in it (CF 8.2), or
  // an empty text.
  [[nodiscard]] std::string gathered_dimension(const io::VariableInFile& variable) const;
  // Adds a variable that has no points to `others`, and the axes along its dimensions; returns false if it is left out.
  bool keep_other(const io::VariableInFile& variable);
  // Adds a remark on each attribute that is left out as its integers are no doubles; `whose` is what has
  // them.
  void tell_of_attributes(std::span<const io::NetcdfAttribute> attributes,
                          const std::string& whose);
  // Adds a remark on integers of 64 bits.
  void tell_of_rounding(const io::VariableInFile& variable);
  // Does the same as keep_other() for a text.
  bool keep_text(const io::VariableInFile& variable);
  // True if the variable has texts along a leading dimension of the fields, such as names of regions.
  [[nodiscard]] bool is_label(const io::VariableInFile& variable) const;
  // Adds to `others` the bounds of axes, and what the fields name as coordinates without places.
  void keep_named();
  // Throws BadValue if two of the names, by which the fields were read, mean the same field.
  void require_distinct(std::span<const std::string> names) const;
  // Adds the attributes that name variables which are kept, such as the bounds of an axis and the
  // height of a field.
  void name_variables();
  // Adds to `axes` the coordinates along some dimensions of a variable.
  void add_axes(const io::VariableInFile& variable, const std::vector<std::size_t>& dimensions,
                std::vector<FieldArray>& axes);
  // Reads fields `first` ... of a variable, as many as fit, with the points that are left out.
  void read_all_points(const SlicedVariable& source, std::size_t first, std::span<double> out,
                       unsigned threads) const;
  // Reads a whole block of fields into `out`, which has its size.
  void read_block(const SlicedVariable& source, const FieldBlock& block, std::span<double> out,
                  unsigned threads) const;
  // Converts the numbers of the file in place: missing ones become NaN, packed ones are unpacked.
  void unpack(const SlicedVariable& source, std::span<double> values, std::size_t first_point,
              unsigned threads) const;
  // Reads a block into block_, unless it is there.
  void keep_block(const SlicedVariable& source, const FieldBlock& block, unsigned threads) const;

  const io::NetcdfReader& file_;
  FieldExtras extras_;
  std::size_t max_per_block_;
  bool are_all_wanted_;  // no names were given
  FieldDimensionFinder layouts_;
  FieldSet fields_;
  std::string first_elsewhere_;  // the first place of a variable that is not where it is wanted
  std::vector<SlicedVariable> sources_;  // by array
  // Dimensions of the sources, by their numbers in the file: those of points with a length above 1,
  // the leading ones, and all.
  std::set<std::size_t> dimensions_of_points_;
  std::set<std::size_t> leading_dimensions_;
  std::set<std::size_t> dimensions_of_fields_;
  std::size_t bytes_kept_ = 0;  // of chunks, for each array
  // The values of the last block of which a part was read.
  mutable std::vector<double> block_;
  mutable const SlicedVariable* source_of_block_ = nullptr;
  mutable std::size_t first_of_block_ = 0;
  // The last field that read_points() had to read as a whole.
  mutable std::vector<double> whole_;
  mutable std::size_t array_of_whole_ = 0;
  mutable std::size_t field_of_whole_ = 0;
};

}  // namespace rondel::formats
