// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>

namespace smg
{

/**
 * Counts the bytes of the scratch files that exist, and enforces a limit. Each ScratchFolder has an
 * account; its bytes count in the account of a folder around it as well, and in that of the
 * process.
 *
 * The account only counts: FileDescriptor asks it before a file in a scratch folder grows. Any
 * thread may do so.
 */
class SMG_EXPORT ScratchAccount
{
public:
  /** The account of all scratch folders of this process. */
  static ScratchAccount& process();
  /** Opens the account of a folder. `limit` in bytes; 0: none. */
  static std::shared_ptr<ScratchAccount> open(
    const std::filesystem::path& folder, std::int64_t limit);
  /** The account of a folder, while it is open; else null. */
  static std::shared_ptr<ScratchAccount> of(const std::filesystem::path& folder);

  /** Closes the account of a folder that is removed with its files. Nameless files that are open
   * count until they are closed. */
  void close(const std::filesystem::path& folder) noexcept;
  /** Goes on counting a closed file until remove(); an older file `path` is replaced. If there is
   * no memory for the entry, or the account is closed, the bytes are released. */
  void keep(const std::filesystem::path& path, std::int64_t bytes) noexcept;
  void remove(const std::filesystem::path& path) noexcept;

  /** Adds `bytes`; returns false, and adds nothing, if a limit would be exceeded. */
  bool acquire(std::int64_t bytes) noexcept;
  void release(std::int64_t bytes) noexcept;

  /** `limit` in bytes; 0: none. */
  void setLimit(std::int64_t limit);
  std::int64_t used() const;
  /** The most bytes that existed at once. */
  std::int64_t peak() const;
  /** The text of the error after acquire() failed: both figures, and what to do. */
  std::string refusal() const;

private:
  static constexpr std::int64_t Unlimited = std::numeric_limits<std::int64_t>::max();

  const ScratchAccount* outer() const;
  ScratchAccount* outer();
  void add(std::int64_t bytes) noexcept;

  std::shared_ptr<ScratchAccount> Around; ///< of the folder around this one, or null
  std::int64_t Limit = Unlimited;
  bool IsOpen = true;
  std::int64_t Used = 0, Peak = 0;
  std::int64_t Refused = 0; ///< bytes that a refused request would have led to
  std::unordered_map<std::string, std::int64_t> Closed; ///< bytes of closed files by their paths
};

/** The bytes of an open file in an account. Any thread may extend it. */
class ScratchShare
{
public:
  explicit ScratchShare(std::shared_ptr<ScratchAccount> account)
    : Account(std::move(account))
  {
  }
  ~ScratchShare() { this->Account->release(this->Bytes); }
  ScratchShare(const ScratchShare&) = delete;
  ScratchShare& operator=(const ScratchShare&) = delete;

  /** The file is about to have at least `end` bytes. Returns false if a limit would be exceeded. */
  bool extend(std::int64_t end) noexcept
  {
    // Several threads may extend the file: each acquires what it has added, and none the same
    // bytes.
    std::int64_t before = this->Bytes;
    while (before < end && !this->Bytes.compare_exchange_weak(before, end))
    {
    }
    if (before >= end || this->Account->acquire(end - before))
    {
      return true;
    }
    this->Bytes -= end - before;
    return false;
  }
  /** The file is closed and stays under the name `path`. */
  void keep(const std::filesystem::path& path) noexcept
  {
    this->Account->keep(path, this->Bytes.exchange(0));
  }
  std::string refusal() const { return this->Account->refusal(); }

private:
  std::shared_ptr<ScratchAccount> Account;
  std::atomic<std::int64_t> Bytes{ 0 };
};

} // namespace smg
