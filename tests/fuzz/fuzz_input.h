// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Turns the bytes of a fuzzer into values that reach the geometry: sites that are likely to
// coincide, to be cocircular, to be one ulp apart or to differ by hundreds of orders of magnitude.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rondel/error.h"
#include "rondel/types.h"

namespace rondel::fuzz {

// Reads bytes from the front; zeros when there are none left.
class ByteSource {
 public:
  ByteSource(const std::uint8_t* data, std::size_t size) : bytes_(data, size) {}

  [[nodiscard]] bool is_empty() const { return bytes_.empty(); }
  std::uint8_t byte();
  // From -128 to 127.
  int small() {
    const int value = byte();
    return value < 128 ? value : value - 256;
  }
  std::size_t below(std::size_t bound) { return byte() % bound; }
  // Any bit pattern.
  double any_double();
  // Any finite double.
  double finite_double();

 private:
  std::span<const std::uint8_t> bytes_;
};

// How far apart the exponents of an input's coordinates may be. Numbers that are
// hundreds of orders of magnitude apart make exact arithmetic a thousand times slower, so that most
// inputs have none.
enum class Scales : std::uint8_t {
  near,  // exponents from -60 to 20
  all,   // any double
};

// One byte: of 8 inputs one has all scales. RONDEL_FUZZ_SCALES=near in the environment: none has,
// for many inputs in a short time.
Scales next_scales(ByteSource& source);

// The next site; it may refer to the earlier ones. Finite.
Point next_site(ByteSource& source, std::span<const Point> earlier, Scales scales);

// Until the bytes end, at most `limit`.
std::vector<Point> all_sites(ByteSource& source, std::size_t limit, Scales scales);
// Those among them that the model can have.
std::vector<Point> all_sites(ByteSource& source, std::size_t limit, Scales scales,
                             const Options& options);

// One byte: mostly 12, at times `most`. Small inputs are many inputs.
std::size_t next_limit(ByteSource& source, std::size_t most);

// Mostly the unit sphere.
Sphere next_sphere(ByteSource& source, Scales scales);

// Where the projected model cannot have a site: removes these.
void remove_center(std::vector<Point>& sites, const Sphere& sphere);

// Ends the program with a message when a law is broken; a fuzzer sees that as a crash.
void require(bool holds, const std::string& law);

// A call that is wrong is refused, and the first bad position is named.
template <class Call>
void refuse(std::size_t index, const Call& call) {
  try {
    static_cast<void>(call());
  } catch (const InvalidInput& error) {
    require(error.index() == index, "the first bad position is named");
    return;
  }
  require(false, "a wrong call is refused");
}

}  // namespace rondel::fuzz
