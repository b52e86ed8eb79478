// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds the variable with the numbers of the pixels of HEALPix that data are at: numbered_pixels() of
// rondel/conventions.h. CF 1.13 states it by a standard_name; files that are older, or of other tools,
// have a coordinate of the dimension or a variable with a usual name.
//
// in    headers of variables; their numbers, some at a time
// out   a variable and its numbers, or why they are no numbers of pixels
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "formats/cf_names.h"
#include "formats/coordinate_search.h"
#include "rondel/conventions.h"
#include "rondel/error.h"
#include "system/message_text.h"

namespace rondel {
namespace {

// Returns the words of a name in lower case, between characters that are no letters.
std::vector<std::string> words_of_name(std::string_view name) {
  std::vector<std::string> words(1);
  for (const char c : formats::lower_case(name)) {
    if (c >= 'a' && c <= 'z') {
      words.back() += c;
    } else if (!words.back().empty()) {
      words.emplace_back();
    }
  }
  return words;
}

// True for a name that tools give to the numbers of pixels: cell, cell_ids, ipix, hpx_index ...
bool is_name_of_pixels(const std::vector<std::string>& words) {
  std::string name;
  for (const std::string& word : words) name += word;
  constexpr std::array<std::string_view, 10> stems = {"healpix", "pixels", "pixel", "cells", "cell",
                                                      "hpix",    "ipix",   "pix",   "hpx",   "hp"};
  constexpr std::array<std::string_view, 10> endings = {
      "", "id", "ids", "index", "indices", "idx", "number", "numbers", "num", "indexes"};
  return name != "hp" && std::ranges::any_of(stems, [&](std::string_view stem) {
           if (!name.starts_with(stem)) return false;
           const std::string_view ending = std::string_view(name).substr(stem.size());
           return std::ranges::find(endings, ending) != endings.end();
         });
}

bool has_no_unit(const VariableHeader& variable) {
  const std::string units(formats::without_blanks(variable.text("units")));
  return units.empty() || units == "1";
}

bool is_coordinate(const VariableHeader& variable) {
  return variable.dimensions.size() == 1 && variable.dimensions.front() == variable.name;
}

// The numbers of a variable, and what is wrong with them.
class ListedNumbers {
 public:
  ListedNumbers(std::uint64_t size, std::uint64_t num_pixels)
      : num_pixels_(num_pixels), is_in_order_(size == num_pixels) {
    if (!is_in_order_) is_there_.assign(num_pixels, false);
  }

  // Adds a number; returns false for one that is not whole, after which there is nothing to know.
  bool add(double number) {
    are_whole = number == std::floor(number);
    if (!are_whole) return false;
    are_ascending = are_ascending && (count_ == 0 || number == before_ + 1);
    before_ = number;
    if (is_in_order_ && number != static_cast<double>(count_)) begin_list();
    ++count_;
    if (is_in_order_) return true;
    if (!(number >= 0) || number >= static_cast<double>(num_pixels_)) {
      if (!elsewhere) elsewhere = number;
      return true;
    }
    const auto pixel = static_cast<Index>(number);
    if (is_there_[pixel] && !repeated) repeated = number;
    is_there_[pixel] = true;
    if (are_good()) numbers.push_back(pixel);
    return true;
  }
  [[nodiscard]] bool are_good() const { return are_whole && !elsewhere && !repeated; }
  [[nodiscard]] bool are_in_order() const { return is_in_order_; }

  std::vector<Index> numbers;       // none if they are those of all pixels in order
  bool are_whole = true;            // none is a fraction or missing
  bool are_ascending = true;        // each is one more than the number before it
  std::optional<double> elsewhere;  // one that no pixel has
  std::optional<double> repeated;   // one that is there twice

 private:
  // The numbers so far, which took no memory, are those of the first pixels.
  void begin_list() {
    is_in_order_ = false;
    numbers.resize(count_);
    std::iota(numbers.begin(), numbers.end(), Index{0});
    is_there_.assign(num_pixels_, false);
    std::fill_n(is_there_.begin(), count_, true);
  }

  std::uint64_t num_pixels_;
  bool is_in_order_;
  std::uint64_t count_ = 0;
  double before_ = 0;
  std::vector<bool> is_there_;
};

// Reads the numbers of a variable, some at a time.
ListedNumbers listed_numbers(const VariableHeader& variable, std::size_t index,
                             const PixelQuery& query) {
  constexpr std::uint64_t at_once = std::uint64_t{1} << 16U;
  const std::uint64_t size = variable.shape.front();
  ListedNumbers found(size, query.num_pixels);
  std::vector<double> values;
  for (std::uint64_t begin = 0; begin < size; begin += at_once) {
    values.resize(std::min(at_once, size - begin));
    query.read(index, begin, values);
    for (const double number : values) {
      if (!found.add(number)) return found;
    }
  }
  return found;
}

// The marks by which a variable is the list, the surest one first.
enum class ListMark { stated, named, coordinate, unclear, none };

// Searches the list of pixels among the variables of a file.
class PixelSearch {
 public:
  PixelSearch(std::span<const VariableHeader> variables, const PixelQuery& query)
      : variables_(variables), query_(query) {
    find_data();
    find_dimension();
  }

  // Returns the list; throws InvalidInput where it is wrong, or nothing says which one it is.
  [[nodiscard]] std::optional<NumberedPixels> found() {
    for (const ListMark mark : {ListMark::stated, ListMark::named, ListMark::coordinate}) {
      std::optional<NumberedPixels> first;
      for (std::size_t v = 0; v < variables_.size(); ++v) {
        if (mark_of(v) != mark) continue;
        std::optional<NumberedPixels> list = read(v, mark);
        if (!list) continue;
        if (first && first->numbers != list->numbers) {
          throw InvalidInput("the variables '" + variables_[first->variable].name + "' and '" +
                                 variables_[v].name + "' have different numbers of pixels",
                             v);
        }
        if (!first) first = std::move(list);
      }
      if (first) return first;
    }
    if (has_places()) return std::nullopt;
    if (!why_not_.empty()) throw InvalidInput(why_not_, 0);
    refuse_suspects();
    return std::nullopt;
  }

 private:
  // The data are the variables that name the grid mapping, or else all but coordinates.
  void find_data() {
    const auto add_if = [&](auto is_of_data) {
      for (const VariableHeader& variable : variables_) {
        if (variable.is_number && !variable.dimensions.empty() && is_of_data(variable)) {
          data_.push_back(&variable);
        }
      }
    };
    add_if([&](const VariableHeader& variable) {
      const std::vector<std::string> words = formats::words_of(variable.text("grid_mapping"));
      return std::ranges::any_of(words, [&](const std::string& word) {
        return !query_.mapping.empty() && (word == query_.mapping || word == query_.mapping + ":");
      });
    });
    if (data_.empty()) add_if([](const VariableHeader& v) { return !is_coordinate(v); });
    if (data_.empty()) add_if([](const VariableHeader&) { return true; });
  }

  // The dimension of the pixels is as long as they are, or the only one of all data that nothing says
  // to be another axis.
  void find_dimension() {
    std::vector<std::string> others;
    for (const VariableHeader* const data : data_) {
      for (std::size_t d = 0; d < data->dimensions.size(); ++d) {
        const std::string& name = data->dimensions[d];
        if (data->shape[d] == query_.num_pixels) {
          dimension_ = name;
          is_whole_ = true;
          return;
        }
        if (std::ranges::count(others, name) == 0 && !is_other_axis(name)) others.push_back(name);
      }
    }
    if (others.size() == 1) dimension_ = others.front();
  }

  // True for the name of a time, and for an axis that has units, a standard_name or a direction.
  [[nodiscard]] bool is_other_axis(const std::string& dimension) const {
    if (is_name_of_time(dimension)) return true;
    return std::ranges::any_of(variables_, [&](const VariableHeader& variable) {
      const std::string standard_name = variable.text("standard_name");
      return variable.name == dimension && is_coordinate(variable) &&
             (!has_no_unit(variable) || !variable.text("axis").empty() ||
              !variable.text("positive").empty() ||
              (!standard_name.empty() && standard_name != "healpix_index"));
    });
  }

  // The coordinate of a dimension and unclear integers count along the dimension of pixels alone.
  [[nodiscard]] ListMark mark_of(std::size_t v) const {
    const VariableHeader& variable = variables_[v];
    const PixelList kind = pixel_list_of(variable, query_.grid.ends_with("ring"));
    if (kind == PixelList::none || variable.shape.front() == 0) return ListMark::none;
    if (kind == PixelList::stated) return ListMark::stated;
    const bool is_along = variable.dimensions.front() == dimension_;
    if (kind == PixelList::unclear) return is_along ? ListMark::unclear : ListMark::none;
    const bool is_named =
        !is_coordinate(variable) || is_name_of_pixels(words_of_name(variable.name));
    if (!is_named) return is_along ? ListMark::coordinate : ListMark::none;
    const bool is_of_data = std::ranges::any_of(data_, [&](const VariableHeader* data) {
      return std::ranges::count(data->dimensions, variable.dimensions.front()) != 0;
    });
    return is_of_data ? ListMark::named : ListMark::none;
  }

  // Returns the numbers of a list that is stated or named, nothing if they are other numbers.
  [[nodiscard]] std::optional<NumberedPixels> read(std::size_t v, ListMark mark) {
    const VariableHeader& variable = variables_[v];
    ListedNumbers list = listed_numbers(variable, v, query_);
    if (list.are_good()) return NumberedPixels{v, std::move(list.numbers)};
    const bool is_stated = mark == ListMark::stated;
    const bool is_of_pixels = is_whole_ && variable.dimensions.front() == dimension_;
    // Integers that count the pixels from 1 are in their order; fractions and floats are a field.
    if (!is_stated && is_of_pixels && list.are_whole && list.are_ascending) return std::nullopt;
    if (!is_stated && (!list.are_whole || !(variable.is_integer || is_coordinate(variable)))) {
      return std::nullopt;
    }
    std::string why = "variable '" + variable.name + "' has the number";
    if (!list.are_whole) {
      why += "s of pixels, but some are missing or no integers";
    } else if (list.elsewhere) {
      why += " " + system::shortest_text(*list.elsewhere) + ", which is not one of the " +
             std::to_string(query_.num_pixels) + " pixels of '" + query_.grid + "'";
    } else {
      why += " " + system::shortest_text(*list.repeated) + " of a pixel twice";
    }
    // A field of integers may have the name of a list, and then has equal ones.
    const bool is_field = is_of_pixels && list.repeated && !is_coordinate(variable);
    if (is_stated || (is_of_pixels && !is_field)) throw InvalidInput(why, v);
    if (!is_field && why_not_.empty()) why_not_ = why;
    return std::nullopt;
  }

  // Throws InvalidInput if integers whose meaning is unclear may be the numbers of pixels in another
  // order than that of the grid.
  void refuse_suspects() const {
    std::string names;
    for (std::size_t v = 0; v < variables_.size(); ++v) {
      if (mark_of(v) != ListMark::unclear) continue;
      const ListedNumbers list = listed_numbers(variables_[v], v, query_);
      if (!list.are_good() || list.are_in_order()) continue;
      names += (names.empty() ? "'" : " and '") + variables_[v].name + "'";
    }
    if (names.empty()) return;
    std::string why = names + " may have the numbers of the pixels of '" + query_.grid +
                      "' that the data are at, in another order; the standard_name healpix_index "
                      "says that a variable has them";
    if (is_whole_) {
      why += ", and '" + query_.grid +
             "' as the source that the values are in the order of the pixels";
    }
    throw InvalidInput(why, 0);
  }

  [[nodiscard]] bool has_places() {
    if (!has_places_) has_places_ = !find_coordinates(variables_).empty();
    return *has_places_;
  }

  std::span<const VariableHeader> variables_;
  const PixelQuery& query_;
  std::vector<const VariableHeader*> data_;
  std::string dimension_;  // of the pixels; empty if it is not known
  bool is_whole_ = false;  // it has all pixels
  std::string why_not_;    // what is wrong with the first list
  std::optional<bool> has_places_;
};

}  // namespace

PixelList pixel_list_of(const VariableHeader& variable, bool is_ring) {
  const std::string standard_name = variable.text("standard_name");
  if (!variable.is_number || variable.dimensions.size() != 1) return PixelList::none;
  if (standard_name == "healpix_index") return PixelList::stated;
  const bool has_flags = std::ranges::any_of(
      variable.texts, [](const auto& text) { return text.first.starts_with("flag_"); });
  if (!standard_name.empty() || has_flags || !has_no_unit(variable)) return PixelList::none;
  std::vector<std::string> words = words_of_name(variable.name);
  const auto is_order = [&](std::string_view order) {
    return std::ranges::any_of(words, [&](const std::string& word) {
      return word == order || (order == "nest" && word == "nested");
    });
  };
  if (is_order(is_ring ? "nest" : "ring")) return PixelList::none;
  const bool is_named =
      is_name_of_pixels(words) || (variable.is_integer && is_order(is_ring ? "ring" : "nest"));
  if (is_named || is_coordinate(variable)) return PixelList::named;
  // A variable with a grid mapping is a field.
  const bool is_unclear = variable.is_integer && variable.text("grid_mapping").empty();
  return is_unclear ? PixelList::unclear : PixelList::none;
}

std::optional<NumberedPixels> numbered_pixels(std::span<const VariableHeader> variables,
                                              const PixelQuery& query) {
  return PixelSearch(variables, query).found();
}

}  // namespace rondel
