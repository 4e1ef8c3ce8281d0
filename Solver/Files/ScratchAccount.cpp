// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/ScratchAccount.h"

#include "Solver/Core/Forks.h"
#include "Solver/Core/Text.h"

#include <algorithm>
#include <mutex>
#include <new>

// How many bytes the scratch files have. Accounts are nested: what a folder has also counts in the
// folder around it, and in the end in the account of the process, which carries the limit of a
// whole command (--scratch-limit).
//
// Invariant: no account exceeds its limit, because bytes are acquired before a file grows, for all
// accounts at once or for none. One mutex guards them all, since they change together; to take it
// costs little beside the write that it counts.

namespace smg
{
namespace
{

using Accounts = std::unordered_map<std::string, std::weak_ptr<ScratchAccount>>;

/** Guards all accounts, which change together. */
std::mutex& guard()
{
  static ForkedMutex mutex;
  return mutex;
}

/** The accounts of the open folders, by their paths: a file finds its account by the folder in
 * which it is created. */
Accounts& openAccounts()
{
  static Accounts accounts;
  return accounts;
}

std::shared_ptr<ScratchAccount> accountOf(const std::filesystem::path& folder)
{
  const auto place = openAccounts().find(folder.native());
  return place == openAccounts().end() ? nullptr : place->second.lock();
}

} // namespace

ScratchAccount& ScratchAccount::process()
{
  static ScratchAccount account;
  return account;
}

/** The account in which the bytes of this one count, too; null for the account of the process. */
const ScratchAccount* ScratchAccount::outer() const
{
  return this->Around ? this->Around.get() : this == &process() ? nullptr : &process();
}

ScratchAccount* ScratchAccount::outer()
{
  return const_cast<ScratchAccount*>(std::as_const(*this).outer());
}

std::shared_ptr<ScratchAccount> ScratchAccount::open(
  const std::filesystem::path& folder, std::int64_t limit)
{
  auto account = std::make_shared<ScratchAccount>();
  account->setLimit(limit);
  const std::lock_guard lock(guard());
  // A scratch folder may lie in another one.
  account->Around = accountOf(folder.parent_path());
  openAccounts()[folder.native()] = account;
  return account;
}

std::shared_ptr<ScratchAccount> ScratchAccount::of(const std::filesystem::path& folder)
{
  const std::lock_guard lock(guard());
  return accountOf(folder);
}

/** The files of the folder are about to be removed. Bytes of files that are still open remain
 * counted until their shares end, since the disk has them until then. */
void ScratchAccount::close(const std::filesystem::path& folder) noexcept
{
  const std::lock_guard lock(guard());
  for (const auto& [path, bytes] : this->Closed)
  {
    this->add(-bytes);
  }
  this->Closed.clear();
  this->IsOpen = false;
  openAccounts().erase(folder.native());
}

void ScratchAccount::keep(const std::filesystem::path& path, std::int64_t bytes) noexcept
{
  const std::lock_guard lock(guard());
  // Called while exceptions may be on their way and memory may be short. If the entry cannot be
  // made, the file exists uncounted: the limit is then kept less strictly, but the computation goes
  // on.
  std::int64_t* counted = nullptr;
  try
  {
    counted = this->IsOpen ? &this->Closed[path.native()] : nullptr;
  }
  catch (const std::bad_alloc&)
  {
    // The same as a closed account: nothing remembers the bytes, so they are released below.
  }
  // The bytes were counted while the file was open. Those of an older file of this name are
  // replaced; if the new ones are not remembered, they go.
  this->add(-(counted ? std::exchange(*counted, bytes) : bytes));
}

void ScratchAccount::remove(const std::filesystem::path& path) noexcept
{
  const std::lock_guard lock(guard());
  if (const auto place = this->Closed.find(path.native()); place != this->Closed.end())
  {
    this->add(-place->second);
    this->Closed.erase(place);
  }
}

bool ScratchAccount::acquire(std::int64_t bytes) noexcept
{
  const std::lock_guard lock(guard());
  // First all limits, then the bytes: a refusal must leave every account as it was.
  for (ScratchAccount* account = this; account; account = account->outer())
  {
    // Written as a difference, since the sum might overflow.
    if (bytes > account->Limit - account->Used)
    {
      account->Refused = account->Used + bytes;
      return false;
    }
  }
  this->add(bytes);
  return true;
}

void ScratchAccount::release(std::int64_t bytes) noexcept
{
  const std::lock_guard lock(guard());
  this->add(-bytes);
}

/** Adds to the account and to all around it. The caller holds the lock. */
void ScratchAccount::add(std::int64_t bytes) noexcept
{
  for (ScratchAccount* account = this; account; account = account->outer())
  {
    account->Used += bytes;
    account->Peak = std::max(account->Peak, account->Used);
  }
}

void ScratchAccount::setLimit(std::int64_t limit)
{
  const std::lock_guard lock(guard());
  this->Limit = limit > 0 ? limit : Unlimited;
}

std::int64_t ScratchAccount::used() const
{
  const std::lock_guard lock(guard());
  return this->Used;
}

std::int64_t ScratchAccount::peak() const
{
  const std::lock_guard lock(guard());
  return this->Peak;
}

std::string ScratchAccount::refusal() const
{
  const std::lock_guard lock(guard());
  // The innermost account that has refused something is the one whose limit the user has to raise.
  const ScratchAccount* account = this;
  while (account->Refused == 0 && account->outer())
  {
    account = account->outer();
  }
  return "the scratch files would take at least " + exactMebibytes(account->Refused) +
         " but their limit is " + exactMebibytes(account->Limit) +
         ": raise the limit of scratch files (option --scratch-limit, property ScratchLimit)";
}

} // namespace smg
