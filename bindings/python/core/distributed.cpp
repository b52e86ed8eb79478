// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Ranks in Python. Functions written in Python are called by the thread that works, with the lock
// of the interpreter, while the calling thread waits. Signal handlers run in the main thread only,
// so that Ctrl-C does not end a call for which all other ranks wait.

#include "rondel/distributed.h"

#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "arrays.h"
#include "interrupt.h"
#include "module.h"
#include "rondel/error.h"
#include "rondel/regrid_ranks.h"

namespace rondel::python {
namespace {

// The ranks of rondel.distributed. All functions are called without the lock, which the calls into
// Python take.
class PythonRanks final : public Communicator {
 public:
  explicit PythonRanks(const nb::object& ranks)
      : ranks_(ranks),
        rank_(nb::cast<int>(ranks.attr("rank"))),
        size_(nb::cast<int>(ranks.attr("size"))) {}

  [[nodiscard]] int rank() const override { return rank_; }
  [[nodiscard]] int size() const override { return size_; }

  // Returns the number of threads of this rank, when all ranks have what they need to begin.
  unsigned meet() {
    const nb::gil_scoped_acquire locked;
    return nb::cast<unsigned>(ranks_.attr("meet")());
  }
  // The last call of all ranks. Throws if one of them has raised an exception.
  void agree(bool has_raised) {
    for (const Bytes& message : all_gather(Bytes(1, std::byte{has_raised}))) {
      if (message != Bytes(1, std::byte{0})) throw Interrupted();
    }
  }
  std::vector<Bytes> all_gather(Bytes mine) override {
    const nb::gil_scoped_acquire locked;
    const nb::bytes sent = to_python(mine);
    return from_python("allgather", ranks_.attr("allgather")(sent));
  }
  std::vector<Bytes> exchange(std::vector<Bytes> messages) override {
    const nb::gil_scoped_acquire locked;
    nb::list sent;
    for (Bytes& message : messages) {
      sent.append(to_python(message));
      message = {};
    }
    return from_python("alltoall", ranks_.attr("alltoall")(std::move(sent)));
  }

 private:
  static nb::bytes to_python(const Bytes& message) {
    return nb::bytes(message.data(), message.size());
  }

  [[nodiscard]] std::vector<Bytes> from_python(const char* call, const nb::object& answer) const {
    std::vector<Bytes> messages;
    for (const nb::handle message : answer) messages.push_back(bytes_of(message));
    if (messages.size() == static_cast<std::size_t>(size_)) return messages;
    const std::string text = std::string(call) + " returned " + std::to_string(messages.size()) +
                             " messages of " + std::to_string(size_) + " ranks";
    throw nb::value_error(text.c_str());
  }

  static Bytes bytes_of(nb::handle message) {
    Py_buffer view;
    if (PyObject_GetBuffer(message.ptr(), &view, PyBUF_SIMPLE) != 0) throw nb::python_error();
    struct Release {
      void operator()(Py_buffer* buffer) const { PyBuffer_Release(buffer); }
    };
    const std::unique_ptr<Py_buffer, Release> held(&view);
    const auto* first = static_cast<const std::byte*>(view.buf);
    return {first, first + view.len};
  }

  nb::handle ranks_;  // owned by the caller
  int rank_;
  int size_;
};

// Runs work on all ranks, which is always watched, since any of them may be late. If one of them
// raises an exception after all have done their work, no other rank has a result.
template <class Work>
auto on_ranks(const nb::object& python_ranks, const nb::object& listener, const Work& work) {
  PythonRanks ranks(python_ranks);
  std::optional<std::invoke_result_t<Work, Communicator&, const Execution&>> result;
  const auto run = [&](const Execution& watching, const std::function<bool()>& ask) {
    // Python sees one thread, whatever it calls there.
    const nb::gil_scoped_acquire attached;
    const nb::gil_scoped_release released;
    Execution execution = watching;
    execution.threads = ranks.meet();
    result.emplace(work(ranks, execution));
    ranks.agree(ask());
  };
  run_watched_until_asked(0, listener, run);
  return std::move(*result);
}

DistributedTriangulation build_on_ranks(const nb::object& ranks, const PointsIn& points,
                                        bool is_weighted, const std::array<double, 3>& center,
                                        double squared_radius, std::uint64_t max_bucket_sites,
                                        bool keep_points, const nb::object& listener) {
  return on_ranks(ranks, listener, [&](Communicator& communicator, const Execution& execution) {
    return delaunay(communicator, points_of(points),
                    {.max_bucket_sites = max_bucket_sites, .keep_points = keep_points},
                    make_options(is_weighted, center, squared_radius), execution);
  });
}

DistributedTriangulation build_files_on_ranks(const nb::object& ranks, const std::string& sites,
                                              const std::array<std::string, 5>& files, bool radians,
                                              bool is_weighted, const std::array<double, 3>& center,
                                              double squared_radius, std::uint64_t max_bucket_sites,
                                              const nb::object& listener) {
  return on_ranks(ranks, listener, [&](Communicator& communicator, const Execution& execution) {
    const DistributedFiles names = {files[0], files[1], files[2], files[3], files[4], radians};
    return delaunay_file(communicator, sites, names, {.max_bucket_sites = max_bucket_sites},
                         make_options(is_weighted, center, squared_radius), execution);
  });
}

RegridFileReport regrid_on_ranks(const nb::object& ranks, const std::string& in,
                                 const std::string& target, const std::string& out,
                                 const RegridFileOptions& options, const nb::object& listener) {
  return on_ranks(ranks, listener, [&](Communicator& communicator, const Execution& execution) {
    return regrid_file(communicator, {in, {}}, {target, {}}, {out, {}}, options, execution);
  });
}

using Rows = std::function<void(std::span<const GlobalTriple>)>;

// Returns the rows that one of the two visits shows, as an array.
template <void (DistributedTriangulation::*visit)(const Rows&) const>
ArrayOut<std::int64_t> rows_out(const DistributedTriangulation& t) {
  return to_array<std::int64_t>(unlocked([&] {
    std::vector<GlobalTriple> rows;
    rows.reserve(t.num_own_faces());
    (t.*visit)([&](std::span<const GlobalTriple> some) {
      rows.insert(rows.end(), some.begin(), some.end());
    });
    return rows;
  }));
}

ArrayOut<double> areas_of_ranks(const nb::object& ranks, const DistributedTriangulation& t,
                                const nb::object& listener) {
  return to_array<double>(
      on_ranks(ranks, listener, [&](Communicator& communicator, const Execution& execution) {
        return areas(communicator, t, execution);
      }));
}

ArrayOut<double> circumcenters_of(const DistributedTriangulation& t, unsigned threads) {
  return points_out(watched_quietly(t.num_own_faces(), threads, [&](const Execution& execution) {
    std::vector<Point> points;
    points.reserve(t.num_own_faces());
    const auto add = [&](std::span<const Point> some) {
      points.insert(points.end(), some.begin(), some.end());
    };
    t.visit_circumcenters(add, execution);
    return points;
  }));
}

// Returns a getter of an array of the object `self`.
template <auto get>
auto list_getter() {
  return [](const nb::object& self) {
    return array_of<std::int64_t>(self, (nb::cast<const DistributedTriangulation&>(self).*get)());
  };
}

}  // namespace

void add_distributed(nb::module_& module) {
  using T = DistributedTriangulation;
  nb::class_<T>(module, "DistributedTriangulation")
      .def_prop_ro("dimension", &T::dimension)
      .def_prop_ro("num_sites", &T::num_sites)
      .def_prop_ro("num_vertices", &T::num_vertices)
      .def_prop_ro("num_faces", &T::num_faces)
      .def_prop_ro("num_ghost_faces", &T::num_ghost_faces)
      .def_prop_ro("num_duplicates", &T::num_duplicates)
      .def_prop_ro("num_hidden", &T::num_hidden)
      .def_prop_ro("num_open_sites", &T::num_open_sites)
      .def_prop_ro("first_face", &T::first_face)
      .def_prop_ro("num_own_faces", &T::num_own_faces)
      .def("faces", &rows_out<&T::visit_faces>)
      .def("neighbors", &rows_out<&T::visit_neighbors>)
      .def("circumcenters", &circumcenters_of, nb::arg("threads"))
      .def_prop_ro("ghost_faces", list_getter<&T::ghost_faces>())
      .def_prop_ro("owned_sites", list_getter<&T::owned_sites>())
      .def_prop_ro("ring", list_getter<&T::ring>())
      .def_prop_ro("duplicates", list_getter<&T::duplicates>())
      .def_prop_ro("hidden", list_getter<&T::hidden>());
  module.def("delaunay_of_ranks", &build_on_ranks, nb::arg("ranks"), nb::arg("points").noconvert(),
             nb::arg("is_weighted"), nb::arg("center"), nb::arg("squared_radius"),
             nb::arg("max_bucket_sites"), nb::arg("keep_points"), nb::arg("progress").none());
  module.def("areas_of_ranks", &areas_of_ranks, nb::arg("ranks"), nb::arg("triangulation"),
             nb::arg("progress").none());
  module.def("regrid_file_of_ranks", &regrid_on_ranks, nb::arg("ranks"), nb::arg("path"),
             nb::arg("target"), nb::arg("out"), nb::arg("options"), nb::arg("progress").none());
  module.def("delaunay_file_of_ranks", &build_files_on_ranks, nb::arg("ranks"), nb::arg("sites"),
             nb::arg("files"), nb::arg("radians"), nb::arg("is_weighted"), nb::arg("center"),
             nb::arg("squared_radius"), nb::arg("max_bucket_sites"), nb::arg("progress").none());
}

}  // namespace rondel::python
