// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "module.h"

#include <exception>
#include <string>
#include <system_error>

#include "rondel/constrained.h"
#include "rondel/distributed.h"
#include "rondel/error.h"
#include "rondel/io.h"
#include "rondel/version.h"

namespace {

namespace nb = nanobind;

// Raises rondel.InvalidInput(message, index), a ValueError that the package defines.
void raise_invalid_input(const rondel::InvalidInput& error) {
  const nb::object type = nb::module_::import_("rondel._errors").attr("InvalidInput");
  const bool has_index = error.index() != rondel::InvalidInput::no_index;
  const nb::object value =
      type(error.what(), has_index ? nb::object(nb::int_(error.index())) : nb::none());
  PyErr_SetObject(type.ptr(), value.ptr());
}

// Raises rondel.CrossingConstraints(message, constraints, place), which is an InvalidInput.
void raise_crossing_constraints(const rondel::CrossingConstraints& error) {
  const nb::object type = nb::module_::import_("rondel._errors").attr("CrossingConstraints");
  const auto [first, second] = error.constraints();
  const rondel::LonLat& place = error.place();
  const nb::object value = type(error.what(), nb::make_tuple(first, second),
                                nb::make_tuple(place.lon_deg, place.lat_deg));
  PyErr_SetObject(type.ptr(), value.ptr());
}

// Raises OSError(errno, reason, file), which Python turns into FileNotFoundError and the like; or
// rondel.FileError, which is a ValueError, too, where not the system has refused the file.
void raise_os_error(const rondel::FileError& error) {
  if (error.code().category() != std::generic_category() || !error.code()) {
    const nb::object type = nb::module_::import_("rondel._errors").attr("FileError");
    PyErr_SetString(type.ptr(), error.what());
    return;
  }
  const std::string reason = error.code().message();
  const std::string text = error.what();
  const nb::str file(text.substr(0, text.size() - reason.size() - 2).c_str());
  const nb::object type = nb::borrow(PyExc_OSError);
  const nb::object value = type(error.code().value(), reason.c_str(), file);
  PyErr_SetObject(value.type().ptr(), value.ptr());
}

// Raises rondel.distributed.DistributedError(message, rank).
void raise_distributed_error(const rondel::DistributedError& error) {
  const nb::object type = nb::module_::import_("rondel.distributed").attr("DistributedError");
  const nb::object value = type(error.what(), error.rank());
  PyErr_SetObject(type.ptr(), value.ptr());
}

void translate(const std::exception_ptr& pointer, void* /*payload*/) {
  try {
    std::rethrow_exception(pointer);
  } catch (const rondel::CrossingConstraints& error) {
    raise_crossing_constraints(error);
  } catch (const rondel::InvalidInput& error) {
    raise_invalid_input(error);
  } catch (const rondel::FileError& error) {
    raise_os_error(error);
  } catch (const rondel::DistributedError& error) {
    raise_distributed_error(error);
  } catch (const rondel::Interrupted& /*error*/) {
    // The rank that was interrupted itself raises its own exception.
    PyErr_SetString(PyExc_KeyboardInterrupt, "another rank was interrupted");
  }
}

}  // namespace

NB_MODULE(_core, module) {
  module.doc() =
      "The C++ library behind the package rondel. Use that: arguments are not converted here.";
  module.attr("version") = rondel::version;
  nb::register_exception_translator(translate);
  // Libraries that hold an array, and threads that never end, may leak when the interpreter ends.
  nb::set_leak_warnings(false);
  module.def("set_netcdf_library", &rondel::set_netcdf_library, nb::arg("path"),
             "Names the file of the library netCDF-C, for netCDF-4.");
  rondel::python::add_triangulation(module);
  rondel::python::add_diagram(module);
  rondel::python::add_query(module);
  rondel::python::add_contours(module);
  rondel::python::add_arrow(module);
  rondel::python::add_cell_set(module);
  rondel::python::add_conventions(module);
  rondel::python::add_dynamic(module);
  rondel::python::add_files(module);
  rondel::python::add_globe(module);
  rondel::python::add_graphs(module);
  rondel::python::add_interpolation(module);
  rondel::python::add_mesh(module);
  rondel::python::add_mesh_make(module);
  rondel::python::add_mesh_parts(module);
  rondel::python::add_triangle_meshes(module);
  rondel::python::add_out_of_core(module);
  rondel::python::add_distributed(module);
  rondel::python::add_remap(module);
  rondel::python::add_polygons(module);
  rondel::python::add_regions(module);
  rondel::python::add_geometries(module);
  rondel::python::add_constrained(module);
  rondel::python::add_dynamic_constrained(module);
  rondel::python::add_native_weights(module);
  rondel::python::add_regrid_files(module);
  rondel::python::add_weight_checks(module);
  rondel::python::add_weight_files(module);
  rondel::python::add_zonal_statistics(module);
}
