// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Checkpoint/Checkpoint.h"

#include "Solver/Core/SystemCalls.h"
#include "Solver/Files/Folder.h"
#include "smg/Error.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <string_view>

// States of a computation in a kept folder, by which a killed program is continued.
//
// Order of events, on the disk as well: the scratch files of a step, then the new state under a
// temporary name, then the names in the folder, then the name of the state. The two last states
// have names in turn, `state.0` and `state.1`, so the older one is replaced. At any moment at least
// one state is complete, and everything that it refers to is on the disk: the next step does not
// touch what the last state refers to (ScratchStream).
//
// At the end the states are removed first, and their removal is made durable before the files go. A
// state has checksums of its front and of its content; its subject says which computation it is of.

namespace smg
{
namespace
{

std::filesystem::path stateIn(
  const std::filesystem::path& folder, const std::string& name, int slot)
{
  return folder / (name + '.' + std::to_string(slot));
}

/** The front of the file of a state; none if it is damaged, or the file something else. */
std::optional<StateFront> frontOf(const FileDescriptor& file)
{
  StateFront front{};
  if (file.readSome(0, std::as_writable_bytes(std::span(&front, 1))) != sizeof(front) ||
      std::string_view(front.magic, sizeof(front.magic)) != StateFront::Magic ||
      front.frontChecksum != front.expectedChecksum())
  {
    return std::nullopt;
  }
  return front;
}

/** The name of the first item whose values differ; empty if all agree. */
std::string otherItem(
  const std::vector<Checkpoint::Item>& items, const std::vector<Checkpoint::Item>& others)
{
  const auto isSame = [](const Checkpoint::Item& a, const Checkpoint::Item& b)
  { return a.value == b.value; };
  const auto place = std::ranges::mismatch(items, others, isSame).in1;
  return place == items.end() ? std::string() : place->what;
}

/** A link does not count: a state has been written by a checkpoint under this very name. */
bool isThere(const std::filesystem::path& path)
{
  std::error_code ignored;
  return std::filesystem::is_regular_file(std::filesystem::symlink_status(path, ignored));
}

} // namespace

Checkpoint::Checkpoint(ScratchFolder& folder, std::vector<Item> subject, std::string name)
  : Folder(folder)
  , Subject(std::move(subject))
  , Name(std::move(name))
{
  // States of another version may have another content, also where their format is the same.
  this->Subject.insert(this->Subject.begin(), Item{ "version of the program", SMG_VERSION });
}

std::filesystem::path Checkpoint::path(int slot) const
{
  return stateIn(this->Folder.path(), this->Name, slot);
}

std::int64_t Checkpoint::steps(const std::filesystem::path& folder, const std::string& name)
{
  std::int64_t most = 0;
  for (int slot = 0; slot < 2; ++slot)
  {
    try
    {
      if (const std::filesystem::path path = stateIn(folder, name, slot); isThere(path))
      {
        const std::optional<StateFront> front = frontOf(FileDescriptor::openForReading(path));
        most = front ? std::max(most, front->steps) : most;
      }
    }
    catch (const Error&)
    {
      // Another program has removed it meanwhile: this is only a question, asked without the lock.
    }
  }
  return most;
}

std::optional<StateReader> Checkpoint::open(Pool& pool)
{
  std::optional<StateReader> last;
  std::int64_t most = -1;
  // The state of the last step is preferred. If it is damaged, the one before it is used: the
  // caller finds out whether the scratch files still agree with that. Only without any good state
  // is damage an error, since starting from the beginning would throw the checkpoint away without a
  // word.
  std::optional<Error> damage;
  for (int slot = 0; slot < 2; ++slot)
  {
    if (!isThere(this->path(slot)))
    {
      continue;
    }
    FileDescriptor file = FileDescriptor::openForReading(this->path(slot));
    const std::optional<StateFront> front = frontOf(file);
    // Not damage but a mistake, for which there is a remedy: it is reported even if the other state
    // is good.
    if (front && (front->version != StateFront::Version || front->order != StateFront::OrderMark))
    {
      throw Error(this->path(slot).string() +
                  ": is of another version of this program: continue with that one, or remove the "
                  "folder to begin anew.");
    }
    try
    {
      // Without a valid front the size is -1, which the reader refuses.
      StateReader state(std::move(file), sizeof(StateFront), front ? front->bytes : -1, pool);
      // The whole state is read once here; the values are checked against the same sums when they
      // are restored.
      if (state.checksum() != front->checksum)
      {
        state.fail("its checksum is wrong");
      }
      if (front->steps > most)
      {
        most = front->steps;
        last = std::move(state);
        this->Last = slot;
      }
    }
    catch (const Error& error)
    {
      damage = error;
    }
  }
  if (!last && damage)
  {
    throw *damage;
  }
  if (last)
  {
    this->compareSubject(*last);
  }
  return last;
}

void Checkpoint::compareSubject(StateReader& state) const
{
  // Another list of items means another kind of computation, for instance a deformation instead of
  // a solve, or one more option.
  std::vector<Item> items;
  state(items);
  const auto isSame = [](const Item& a, const Item& b) { return a.what == b.what; };
  const std::string other = !std::ranges::equal(items, this->Subject, isSame)
                              ? "kind of computation"
                              : otherItem(items, this->Subject);
  if (!other.empty())
  {
    throw Error(this->Folder.path().string() +
                ": is the checkpoint of a computation with another " + other +
                ": repeat its command to continue it, or remove the folder to begin anew.");
  }
}

void Checkpoint::save(std::int64_t steps, const std::function<void(StateWriter&)>& write)
{
  // The last state stays as it is until the new one has its name.
  const int slot = 1 - this->Last;
  FileDescriptor file = FileDescriptor::createBeside(this->path(slot));
  // The content is written first, since the front has its size and checksum.
  StateWriter state(file, sizeof(StateFront));
  state(this->Subject);
  write(state);
  state.finish();
  StateFront front{};
  std::memcpy(front.magic, StateFront::Magic.data(), sizeof(front.magic));
  front.version = StateFront::Version;
  front.order = StateFront::OrderMark;
  front.steps = steps;
  front.bytes = state.bytes();
  front.checksum = state.checksum();
  front.frontChecksum = front.expectedChecksum();
  file.write(0, std::as_bytes(std::span(&front, 1)));
  // A state gets its name when the names of the files that it refers to are durable. The file
  // itself is synchronised first: most file systems write its folder with it, which makes the
  // second call cheap.
  file.sync();
  FileDescriptor::syncPath(this->Folder.path(), this->path(slot));
  file.renameTo(this->path(slot));
  this->Last = slot;
  // From here on there is something to continue from.
  this->Folder.retain();
}

void Checkpoint::discard()
{
  // The last state refers to complete files, so it goes last: a kill in between leaves it.
  systemCalls().unlink(this->path(1 - this->Last).c_str());
  systemCalls().unlink(this->path(this->Last).c_str());
  // The files go next. Even after a power cut no state may be left that refers to them.
  FileDescriptor::trySync(this->Folder.lock()->folder());
  this->Folder.discard();
}

} // namespace smg
