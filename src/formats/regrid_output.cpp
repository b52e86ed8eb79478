// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "formats/regrid_output.h"

#include <algorithm>
#include <cmath>

namespace rondel::formats {

void RegridOutput::keep(const std::string& path, const std::vector<JournalFact>& about) {
  journal_.emplace(path, about);
  num_kept_ = journal_->num_left();
}

bool RegridOutput::skip(std::size_t num_values) {
  if (num_values > num_kept_) {
    num_kept_ = 0;
    return false;
  }
  num_kept_ -= num_values;
  if (!writer_) return true;
  constexpr std::size_t most = std::size_t{1} << 20U;
  std::vector<double> values;
  for (std::size_t left = num_values; left > 0; left -= values.size()) {
    values.resize(std::min(left, most));
    journal_->read(values);
    pass_on(values);
  }
  return true;
}

std::size_t RegridOutput::skip_fields(std::size_t num_fields, std::size_t values_per_field) {
  const std::size_t whole =
      std::min<std::uint64_t>(num_fields, num_kept_ / std::max<std::size_t>(values_per_field, 1));
  skip(whole * values_per_field);
  return whole;
}

void RegridOutput::write(std::span<const double> values) {
  num_kept_ = 0;  // a part of a field, which has been computed again
  if (!writer_ || values.empty()) return;
  pass_on(values);
  if (journal_) journal_->append(values);
}

void RegridOutput::pass_on(std::span<const double> values) {
  num_missing_ += static_cast<std::size_t>(
      std::ranges::count_if(values, [](double value) { return std::isnan(value); }));
  writer_->write(values);
}

void RegridOutput::finish() {
  if (!writer_) return;
  writer_->finish();
  if (journal_) journal_->remove();
}

}  // namespace rondel::formats
