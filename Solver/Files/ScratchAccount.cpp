// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/ScratchAccount.h"

#include "Solver/Core/Text.h"

#include <algorithm>
#include <mutex>
#include <new>

namespace smg
{
namespace
{

using Accounts = std::unordered_map<std::string, std::weak_ptr<ScratchAccount>>;

/** Guards all accounts, which change together. */
std::mutex& guard()
{
  static std::mutex mutex;
  return mutex;
}

/** Those of the open folders, by their paths. */
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
  account->Around = accountOf(folder.parent_path());
  openAccounts()[folder.native()] = account;
  return account;
}

std::shared_ptr<ScratchAccount> ScratchAccount::of(const std::filesystem::path& folder)
{
  const std::lock_guard lock(guard());
  return accountOf(folder);
}

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
  std::int64_t* counted = nullptr;
  try
  {
    counted = this->IsOpen ? &this->Closed[path.native()] : nullptr;
  }
  catch (const std::bad_alloc&)
  {
    // As below.
  }
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
  for (ScratchAccount* account = this; account; account = account->outer())
  {
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

/** The accounts must be locked. */
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
