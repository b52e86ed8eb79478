// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// GDAL, which is loaded when a file is to be read or written that only GDAL knows; Rondel is built
// and runs without it. The members are functions of its C interface, whose binary form is the same
// since GDAL 3.0.
//
// in    a library on this machine
// out   pointers to its functions
#pragma once

#include <optional>
#include <string>

#include "system/mutex.h"

namespace rondel::formats {

// GDAL's opaque handles; its documentation says which function takes which handle.
using GdalHandle = void*;

// The functions of GDAL that are called. Prefixes of GDAL's names: GDAL (datasets and drivers), OSR
// (spatial references), OGR (layers L, fields Fld, features F, geometries G), CPL (errors and
// settings), VSI (files, here in memory); load_symbols() in gdal.cpp says which member has which
// name.
struct Gdal {
  void (*all_register)();
  const char* (*version_info)(const char*);
  void (*push_error_handler)(void*);
  void (*pop_error_handler)();
  void* quiet_error_handler;
  const char* (*last_error)();
  int (*last_error_type)();  // 3 and more are failures
  void (*reset_error)();
  const char* (*config_option)(const char*, const char*);
  void (*set_config_option)(const char*, const char*);
  GdalHandle (*driver_by_name)(const char*);
  GdalHandle (*create)(GdalHandle, const char*, int, int, int, int, char**);
  int (*start_transaction)(GdalHandle, int);
  int (*commit_transaction)(GdalHandle);
  void (*close)(GdalHandle);
  GdalHandle (*new_reference)(const char*);
  int (*set_well_known_reference)(GdalHandle, const char*);
  void (*set_axis_mapping)(GdalHandle, int);
  void (*destroy_reference)(GdalHandle);
  GdalHandle (*create_layer)(GdalHandle, const char*, GdalHandle, int, char**);
  GdalHandle (*create_field)(const char*, int);
  int (*add_field)(GdalHandle, GdalHandle, int);
  void (*destroy_field)(GdalHandle);
  GdalHandle (*definition)(GdalHandle);
  GdalHandle (*create_feature)(GdalHandle);
  void (*set_integer)(GdalHandle, int, long long);
  void (*set_double)(GdalHandle, int, double);
  void (*set_text)(GdalHandle, int, const char*);
  int (*geometry_of_wkb)(const void*, GdalHandle, GdalHandle*, int);
  int (*give_geometry)(GdalHandle, GdalHandle);
  int (*add_feature)(GdalHandle, GdalHandle);
  void (*destroy_feature)(GdalHandle);
  GdalHandle (*open)(const char*, unsigned, const char* const*, const char* const*,
                     const char* const*);
  int (*num_layers)(GdalHandle);
  GdalHandle (*layer)(GdalHandle, int);
  const char* (*layer_name)(GdalHandle);
  GdalHandle (*layer_reference)(GdalHandle);
  long long (*num_features)(GdalHandle, int);
  void (*reset_reading)(GdalHandle);
  GdalHandle (*next_feature)(GdalHandle);
  int (*num_fields)(GdalHandle);
  GdalHandle (*field)(GdalHandle, int);
  const char* (*field_name)(GdalHandle);
  int (*field_type)(GdalHandle);
  int (*is_set)(GdalHandle, int);
  double (*real)(GdalHandle, int);
  long long (*integer)(GdalHandle, int);
  const char* (*text)(GdalHandle, int);
  GdalHandle (*geometry)(GdalHandle);
  int (*geometry_type)(GdalHandle);
  int (*flat_type)(int);
  int (*is_empty)(GdalHandle);
  int (*num_parts)(GdalHandle);
  GdalHandle (*part)(GdalHandle, int);
  int (*num_points)(GdalHandle);
  double (*x)(GdalHandle, int);
  double (*y)(GdalHandle, int);
  int (*is_geographic)(GdalHandle);
  int (*is_local)(GdalHandle);
  double (*angular_units)(GdalHandle, char**);
  double (*prime_meridian)(GdalHandle, char**);
  const char* (*reference_name)(GdalHandle);
  GdalHandle (*place_file)(const char*, unsigned char*, unsigned long long, int);
  int (*close_file)(GdalHandle);
  int (*remove_file)(const char*);
  unsigned char* (*take_bytes)(const char*, unsigned long long*, int);
  void (*free_bytes)(void*);
};

// What GDAL is wanted for, which an error says.
enum class GdalUse { writing, reading };

// Returns the library that the environment variable RONDEL_GDAL names, or else the newest that the
// system finds, with its drivers registered. Throws FileError, which begins with `path`, if there
// is no GDAL.
const Gdal& load_gdal(const std::string& path, GdalUse use = GdalUse::writing);

// Returns the lock for files in GDAL's memory, which have one name in the process.
system::Mutex& gdal_lock();

// While this object exists, GDAL does not print the errors of this thread; last_error() returns
// them.
class QuietGdal {
 public:
  // Silences GDAL. `gdal` must live as long as this object.
  explicit QuietGdal(const Gdal& gdal) : gdal_(gdal) {
    gdal_.push_error_handler(gdal_.quiet_error_handler);
  }
  ~QuietGdal() { gdal_.pop_error_handler(); }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;

 private:
  const Gdal& gdal_;
};

// While this object exists, GDAL dates what this thread writes 1970-01-01, so that files have equal
// bytes in every run.
class FixedDate {
 public:
  // Sets the date. `gdal` must live as long as this object.
  explicit FixedDate(const Gdal& gdal) : gdal_(gdal) {
    if (const char* const before = gdal_.config_option(name, nullptr)) before_ = before;
    gdal_.set_config_option(name, "1970-01-01T00:00:00.000Z");
  }
  // Gives GDAL the date back that its user had set, if any.
  ~FixedDate() { gdal_.set_config_option(name, before_ ? before_->c_str() : nullptr); }
  FixedDate(const FixedDate&) = delete;
  FixedDate& operator=(const FixedDate&) = delete;

 private:
  static constexpr const char* name = "OGR_CURRENT_DATE";
  const Gdal& gdal_;
  std::optional<std::string> before_;
};

}  // namespace rondel::formats
