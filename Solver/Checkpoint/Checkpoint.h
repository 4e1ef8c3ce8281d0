// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/Checksum.h"
#include "Solver/Files/FileDescriptor.h"
#include "Solver/Files/ScratchFolder.h"
#include "Solver/Files/State.h"
#include "Solver/Memory/Pool.h"
#include "smg/Export.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{

/**
 * The states of a computation in a kept folder, from which a program continues what a killed one
 * has begun. A step saves its state when the scratch files that the state refers to are on the
 * disk; the next step does not modify what this state refers to.
 *
 * The files `state.0` and `state.1` (or with another name) hold the last two states. Each is
 * complete when it gets its name, and has checksums of its front and content; the content has those
 * of the scratch files. If one file is damaged, the other one is used, provided that the scratch
 * files still agree with it.
 */
class SMG_EXPORT Checkpoint
{
public:
  static constexpr const char* StateName = "state";

  /** Something that must be the same when a computation is continued. */
  struct Item
  {
    std::string what;  ///< for example "tolerance"
    std::string value; ///< any text

    template <class State>
    void exchange(State& state)
    {
      state(this->what, this->value);
    }
  };

  /** The states `name`.0 and `name`.1 in `folder`, of a computation with this subject and by this
   * version of the program. `name` begins with StateName. */
  Checkpoint(ScratchFolder& folder, std::vector<Item> subject, std::string name = StateName);

  /** The number of steps of the last of the states `name` in a folder; 0 if there is none. */
  static std::int64_t steps(
    const std::filesystem::path& folder, const std::string& name = StateName);

  /** The last state; none if the computation has to begin. Throws Error if it is damaged or of
   * another subject. */
  std::optional<StateReader> open(Pool& pool);
  /** Saves the state after `steps` steps, more than before; `write` writes it. */
  void save(std::int64_t steps, const std::function<void(StateWriter&)>& write);
  /** The computation is complete: removes the states. The folder is removed when it is closed. */
  void discard();

private:
  void compareSubject(StateReader& state) const;
  std::filesystem::path path(int slot) const;

  ScratchFolder& Folder;
  std::vector<Item> Subject;
  std::string Name;
  int Last = 1; // slot of the last state; the first one is written to slot 0
};

/** The first bytes of the file of a state. */
struct StateFront
{
  static constexpr std::string_view Magic = "SMGSTATE";
  static constexpr std::uint32_t OrderMark = 0x01020304;
  static constexpr std::uint32_t Version = 15;

  char magic[8];
  std::uint32_t version;
  std::uint32_t order;
  std::int64_t steps;
  std::int64_t bytes;
  std::uint64_t checksum;      ///< of the bytes
  std::uint64_t frontChecksum; ///< of all bytes before this one

  std::uint64_t expectedChecksum() const
  {
    return smg::checksum(
      std::as_bytes(std::span(this, 1)).first(offsetof(StateFront, frontChecksum)));
  }
};
static_assert(sizeof(StateFront) == 48);

} // namespace smg
