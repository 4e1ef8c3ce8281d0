// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace smg
{

/**
 * Accounts for all block memory of a solve and keeps the promise of its limit: a request above it
 * is an Error that names the bytes needed, the bytes allowed and what to change.
 *
 * The pool counts; the memory itself comes from Ring and Buffer. Not thread safe: windows grow
 * on the thread that drives the stages.
 */
class Pool
{
public:
  /** `limit` in bytes. */
  explicit Pool(std::int64_t limit)
    : Limit(limit)
  {
  }

  /** Adds `bytes` to the memory in use. Throws Error, and adds nothing, above the limit. */
  void acquire(std::int64_t bytes);
  void release(std::int64_t bytes) { this->Used -= bytes; }

  std::int64_t used() const { return this->Used; }
  std::int64_t peak() const { return this->Peak; }
  std::int64_t limit() const { return this->Limit; }

private:
  std::int64_t Limit;
  std::int64_t Used = 0;
  std::int64_t Peak = 0;
};

/** "the solve needs ... MiB, ... MiB are allowed: ..." */
std::string memoryLimitSentence(std::int64_t needed, std::int64_t allowed);

} // namespace smg
