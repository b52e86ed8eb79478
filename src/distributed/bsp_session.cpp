// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The first byte of each message is a status; a message of failure has the text of the exception
// behind it, up to 500 bytes. The members of Communicator and DistributedError are here, too.

#include "distributed/bsp_session.h"

#include <exception>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "rondel/error.h"
#include "system/parallel.h"

namespace rondel::distributed {
namespace {

// The values of the first byte of a message.
constexpr std::byte status_ok{0};
constexpr std::byte has_failed{1};
constexpr std::byte was_interrupted{2};

constexpr std::size_t max_text_bytes = 500;

// Writes a message of failure in one line. It allocates nothing, as the memory is reserved.
void describe(Bytes& message, std::byte kind, std::string_view text) noexcept {
  message.assign(1, kind);
  for (const char c : text.substr(0, max_text_bytes))
    message.push_back(std::byte(static_cast<unsigned char>(c == '\n' ? ' ' : c)));
}

}  // namespace

BspSession::BspSession(Communicator& ranks) noexcept
    : ranks_(ranks),
      rank_(static_cast<std::size_t>(ranks.rank())),
      size_(static_cast<std::size_t>(ranks.size())) {}

void BspSession::reserve_failure() { failure_.reserve(1 + max_text_bytes); }

void BspSession::begin(const char* phase) {
  phase_ = phase;
  ranks_.begin(phase);
  system::obey_stop();
}

std::vector<Bytes> BspSession::all_gather(Bytes mine) {
  peers_notified_ = true;  // if this call throws, the calls of the others throw too
  std::vector<Bytes> received = ranks_.all_gather(std::move(mine));
  rethrow_remote(received);
  peers_notified_ = false;
  return received;
}

std::vector<Bytes> BspSession::exchange(std::vector<Bytes> messages) {
  all_gather({});
  peers_notified_ = true;
  std::vector<Bytes> received = ranks_.exchange(std::move(messages));
  peers_notified_ = false;
  return received;
}

void BspSession::broadcast_failure() {
  describe_failure();
  all_gather(std::move(failure_));
}

void BspSession::describe_failure() noexcept {
  try {
    throw;
  } catch (const Interrupted&) {
    describe(failure_, was_interrupted, {});
  } catch (const std::exception& error) {
    describe(failure_, has_failed, error.what());
  } catch (...) {
    describe(failure_, has_failed, "an exception of unknown type");
  }
}

void BspSession::rethrow_remote(const std::vector<Bytes>& received) {
  for (std::size_t i = 0; i < received.size(); ++i) {
    const Bytes& message = received[i];
    if (message.empty() || message[0] == status_ok) continue;
    if (message[0] == was_interrupted) throw Interrupted();
    std::string text;
    for (const std::byte byte : std::span(message).subspan(1))
      text.push_back(static_cast<char>(byte));
    throw DistributedError(static_cast<int>(i), phase_, text);
  }
}

}  // namespace rondel::distributed

namespace rondel {

Communicator::~Communicator() = default;

void Communicator::begin(std::string_view /*phase*/) {}

DistributedError::DistributedError(int rank, const std::string& phase, const std::string& text)
    : std::runtime_error("rank " + std::to_string(rank) + ", " + phase + ": " + text),
      rank_(rank) {}

DistributedError::~DistributedError() = default;

}  // namespace rondel
