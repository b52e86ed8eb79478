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

// Sets all members by the names that GDAL's C interface gives them; false if one is missing.
bool load_symbols(void* library, Gdal& gdal) {
  system::SymbolLoader from(library);
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
  return from.has_all();
}

}  // namespace

const Gdal& load_gdal(const std::string& path) {
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
    throw FileError(path +
                    ": such files are written by GDAL, which is not found: install libgdal, "
                    "name it by RONDEL_GDAL, or write .geojson for ogr2ogr");
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
