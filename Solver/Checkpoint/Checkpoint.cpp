// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Checkpoint/Checkpoint.h"

#include "Solver/Core/SystemCalls.h"
#include "Solver/Files/Folder.h"
#include "smg/Error.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <string_view>

namespace smg
{
namespace
{

std::filesystem::path stateIn(
  const std::filesystem::path& folder, const std::string& name, int slot)
{
  return folder / (name + '.' + std::to_string(slot));
}

/** The front of a file, if it is one. */
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

/** What the first items with different values are of; "": all values agree. */
std::string otherItem(
  const std::vector<Checkpoint::Item>& items, const std::vector<Checkpoint::Item>& others)
{
  const auto isSame = [](const Checkpoint::Item& a, const Checkpoint::Item& b)
  { return a.value == b.value; };
  const auto place = std::ranges::mismatch(items, others, isSame).in1;
  return place == items.end() ? std::string() : place->what;
}

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
      // Another program has removed it meanwhile.
    }
  }
  return most;
}

std::optional<StateReader> Checkpoint::open(Pool& pool)
{
  std::optional<StateReader> last;
  std::int64_t most = -1;
  std::optional<Error> damage;
  for (int slot = 0; slot < 2; ++slot)
  {
    if (!isThere(this->path(slot)))
    {
      continue;
    }
    FileDescriptor file = FileDescriptor::openForReading(this->path(slot));
    const std::optional<StateFront> front = frontOf(file);
    if (front && (front->version != StateFront::Version || front->order != StateFront::OrderMark))
    {
      throw Error(this->path(slot).string() +
                  ": is of another version of this program: continue with that one, or remove the "
                  "folder to begin anew.");
    }
    try
    {
      StateReader state(std::move(file), sizeof(StateFront), front ? front->bytes : -1, pool);
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
  const int slot = 1 - this->Last;
  FileDescriptor file = FileDescriptor::createBeside(this->path(slot));
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
  // itself comes first: most file systems write its folder with it.
  file.sync();
  FileDescriptor::syncPath(this->Folder.path(), this->path(slot));
  file.renameTo(this->path(slot));
  this->Last = slot;
  this->Folder.retain();
}

void Checkpoint::discard()
{
  // The last state refers to files that are complete: it goes last.
  systemCalls().unlink(this->path(1 - this->Last).c_str());
  systemCalls().unlink(this->path(this->Last).c_str());
  // Also after a power cut it refers to nothing that is removed next.
  FileDescriptor::trySync(this->Folder.lock()->folder());
  this->Folder.discard();
}

} // namespace smg
