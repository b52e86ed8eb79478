// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Regrids a file by several ranks: the work of regrid_file() with messages between ranks.

#include <cstdint>
#include <utility>
#include <vector>

#include "distributed/bsp_session.h"
#include "distributed/messages.h"
#include "formats/regrid_processes.h"
#include "rondel/regrid_ranks.h"
#include "system/job.h"

namespace rondel {

RegridFileReport regrid_file(Communicator& ranks, const FileName& in, const FileName& target,
                             const FileName& out, const RegridFileOptions& options,
                             const Execution& execution) {
  const system::Call call(execution);
  distributed::BspSession session(ranks);
  formats::RegridRanks messages;
  messages.rank = session.rank();
  messages.size = session.size();
  messages.gather = [&](formats::RegridRanks::Message mine) {
    std::vector<distributed::Bytes> sent(session.size());
    sent[0] = std::move(mine);
    std::vector<distributed::Bytes> received = session.exchange(std::move(sent));
    if (session.rank() != 0) received.clear();
    return received;
  };
  messages.number_of_first = [&](std::uint64_t number) {
    distributed::MessageWriter writer;
    writer.add_value(number);
    return distributed::MessageReader(session.all_gather(writer.take())[0]).value<std::uint64_t>();
  };
  return session.run([&] {
    session.begin("regrid");
    return formats::regrid_by_ranks(in, target, out, options, messages, execution);
  });
}

}  // namespace rondel
