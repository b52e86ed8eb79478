// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "gdal.h"

#include <cstdlib>
#include <cstring>
#include <string>

#include "process.h"
#include "rondel/error.h"

namespace rondel::cli {
namespace {

// Tries the versions of GDAL from future ones down to 3.0.
void* open_gdal() {
  if (const char* const name = std::getenv("RONDEL_GDAL"); name != nullptr) {
    return open_library(name);
  }
  for (const char* const name : {"libgdal.so", "libgdal.dylib", "gdal.dll"}) {
    if (void* const library = open_library(name)) return library;
  }
  for (int version = 60; version >= 26; --version) {
    const std::string name = "libgdal.so." + std::to_string(version);
    if (void* const library = open_library(name.c_str())) return library;
  }
  return nullptr;
}

// Sets pointers to functions of a loaded library, and remembers whether all of them were found.
class SymbolLoader {
 public:
  explicit SymbolLoader(void* library) : library_(library) {}

  template <class Function>
  void get(Function& function, const char* name) {
    void* const address = symbol_of(library_, name);
    has_all_ = has_all_ && address != nullptr;
    std::memcpy(&function, &address, sizeof function);
  }
  [[nodiscard]] bool has_all() const { return has_all_; }

 private:
  void* library_;
  bool has_all_ = true;
};

// Sets all members by the names that GDAL's C interface gives them; false if one is missing.
bool load(void* library, Gdal& gdal) {
  SymbolLoader from(library);
  from.get(gdal.all_register, "GDALAllRegister");
  from.get(gdal.version_info, "GDALVersionInfo");
  from.get(gdal.push_error_handler, "CPLPushErrorHandler");
  from.get(gdal.quiet_error_handler, "CPLQuietErrorHandler");
  from.get(gdal.last_error, "CPLGetLastErrorMsg");
  from.get(gdal.set_config_option, "CPLSetConfigOption");
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
    void* const library = open_gdal();
    return library != nullptr && load(library, gdal);
  }();
  if (!is_loaded) {
    throw FileError(path +
                    ": such files are written by GDAL, which is not found: install libgdal, "
                    "name it by RONDEL_GDAL, or write .geojson for ogr2ogr");
  }
  // Drivers are registered once for the process. GDAL's own handler would print each error to
  // stderr.
  static const bool is_ready = [] {
    gdal.push_error_handler(gdal.quiet_error_handler);
    gdal.all_register();
    return true;
  }();
  (void)is_ready;
  return gdal;
}

}  // namespace rondel::cli
