// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Loads GDAL at run time and looks up the functions of its C interface by name. The library stays
// loaded until the process ends; load_gdal() may be called by several threads.
#include "formats/gdal.h"

#include <string>

#include "rondel/error.h"
#include "system/dynamic_library.h"

namespace rondel::formats {
namespace {

// Sets the members that both directions need, and those of writing, by the names that GDAL's C
// interface gives them.
void load_writing(system::SymbolLoader& from, Gdal& gdal) {
  from.get(gdal.all_register, "GDALAllRegister");
  from.get(gdal.version_info, "GDALVersionInfo");
  from.get(gdal.push_error_handler, "CPLPushErrorHandler");
  from.get(gdal.pop_error_handler, "CPLPopErrorHandler");
  from.get(gdal.quiet_error_handler, "CPLQuietErrorHandler");
  from.get(gdal.last_error, "CPLGetLastErrorMsg");
  from.get(gdal.last_error_type, "CPLGetLastErrorType");
  from.get(gdal.reset_error, "CPLErrorReset");
  from.get(gdal.config_option, "CPLGetThreadLocalConfigOption");
  from.get(gdal.set_config_option, "CPLSetThreadLocalConfigOption");
  from.get(gdal.driver_by_name, "GDALGetDriverByName");
  from.get(gdal.create, "GDALCreate");
  from.get(gdal.start_transaction, "GDALDatasetStartTransaction");
  from.get(gdal.commit_transaction, "GDALDatasetCommitTransaction");
  from.get(gdal.close, "GDALClose");
  from.get(gdal.new_reference, "OSRNewSpatialReference");
  from.get(gdal.set_well_known_reference, "OSRSetWellKnownGeogCS");
  from.get(gdal.set_axis_mapping, "OSRSetAxisMappingStrategy");
  from.get(gdal.destroy_reference, "OSRDestroySpatialReference");
  from.get(gdal.create_layer, "GDALDatasetCreateLayer");
  from.get(gdal.create_field, "OGR_Fld_Create");
  from.get(gdal.add_field, "OGR_L_CreateField");
  from.get(gdal.destroy_field, "OGR_Fld_Destroy");
  from.get(gdal.definition, "OGR_L_GetLayerDefn");
  from.get(gdal.create_feature, "OGR_F_Create");
  from.get(gdal.set_integer, "OGR_F_SetFieldInteger64");
  from.get(gdal.set_double, "OGR_F_SetFieldDouble");
  from.get(gdal.set_text, "OGR_F_SetFieldString");
  from.get(gdal.geometry_of_wkb, "OGR_G_CreateFromWkb");
  from.get(gdal.give_geometry, "OGR_F_SetGeometryDirectly");
  from.get(gdal.add_feature, "OGR_L_CreateFeature");
  from.get(gdal.destroy_feature, "OGR_F_Destroy");
  from.get(gdal.take_bytes, "VSIGetMemFileBuffer");
  from.get(gdal.free_bytes, "VSIFree");
}

// Sets the members of reading.
void load_reading(system::SymbolLoader& from, Gdal& gdal) {
  from.get(gdal.open, "GDALOpenEx");
  from.get(gdal.num_layers, "GDALDatasetGetLayerCount");
  from.get(gdal.layer, "GDALDatasetGetLayer");
  from.get(gdal.layer_name, "OGR_L_GetName");
  from.get(gdal.layer_reference, "OGR_L_GetSpatialRef");
  from.get(gdal.num_features, "OGR_L_GetFeatureCount");
  from.get(gdal.reset_reading, "OGR_L_ResetReading");
  from.get(gdal.next_feature, "OGR_L_GetNextFeature");
  from.get(gdal.num_fields, "OGR_FD_GetFieldCount");
  from.get(gdal.field, "OGR_FD_GetFieldDefn");
  from.get(gdal.field_name, "OGR_Fld_GetNameRef");
  from.get(gdal.field_type, "OGR_Fld_GetType");
  from.get(gdal.is_set, "OGR_F_IsFieldSetAndNotNull");
  from.get(gdal.real, "OGR_F_GetFieldAsDouble");
  from.get(gdal.integer, "OGR_F_GetFieldAsInteger64");
  from.get(gdal.text, "OGR_F_GetFieldAsString");
  from.get(gdal.geometry, "OGR_F_GetGeometryRef");
  from.get(gdal.geometry_type, "OGR_G_GetGeometryType");
  from.get(gdal.flat_type, "OGR_GT_Flatten");
  from.get(gdal.is_empty, "OGR_G_IsEmpty");
  from.get(gdal.num_parts, "OGR_G_GetGeometryCount");
  from.get(gdal.part, "OGR_G_GetGeometryRef");
  from.get(gdal.num_points, "OGR_G_GetPointCount");
  from.get(gdal.x, "OGR_G_GetX");
  from.get(gdal.y, "OGR_G_GetY");
  from.get(gdal.is_geographic, "OSRIsGeographic");
  from.get(gdal.is_local, "OSRIsLocal");
  from.get(gdal.angular_units, "OSRGetAngularUnits");
  from.get(gdal.prime_meridian, "OSRGetPrimeMeridian");
  from.get(gdal.reference_name, "OSRGetName");
  from.get(gdal.place_file, "VSIFileFromMemBuffer");
  from.get(gdal.close_file, "VSIFCloseL");
  from.get(gdal.remove_file, "VSIUnlink");
}

// Sets all members; false if the library lacks one.
bool load_symbols(void* library, Gdal& gdal) {
  system::SymbolLoader from(library);
  load_writing(from, gdal);
  load_reading(from, gdal);
  return from.has_all();
}

}  // namespace

system::Mutex& gdal_lock() {
  static system::Mutex lock;
  return lock;
}

const Gdal& load_gdal(const std::string& path, GdalUse use) {
  static Gdal gdal{};
  static const bool is_loaded = [] {
    void* const library =
        system::find_library({.variable = "RONDEL_GDAL",
                              .soname = "libgdal.so.",
                              .newest = 60,
                              .oldest = 26,  // GDAL 3.0
                              .others = {"libgdal.so", "libgdal.dylib", "gdal.dll"}});
    return library != nullptr && load_symbols(library, gdal);
  }();
  if (!is_loaded) {
    const bool is_read = use == GdalUse::reading;
    throw FileError(path + ": such files are " + (is_read ? "read" : "written") +
                    " by GDAL, which is not found: install libgdal, name it by RONDEL_GDAL, or " +
                    (is_read ? "convert it to .geojson by ogr2ogr" : "write .geojson for ogr2ogr"));
  }
  // Drivers are registered once for the process.
  static const bool is_ready = [] {
    const QuietGdal quiet(gdal);
    gdal.all_register();
    return true;
  }();
  (void)is_ready;
  return gdal;
}

}  // namespace rondel::formats
