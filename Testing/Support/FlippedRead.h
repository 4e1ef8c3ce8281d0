// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/SystemCalls.h"
#include "Testing/Support/ErrorMessage.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <cstddef>
#include <string>

namespace smg::testing
{

/** As long as it exists, one bit of what the n-th read of a file returns is wrong; n from 1. */
class FlippedRead
{
public:
  explicit FlippedRead(int nth)
  {
    Nth = nth;
    Reads = 0;
    systemCalls().pread = [](int file, void* bytes, std::size_t size, off_t offset)
    {
      const ssize_t done = Real.pread(file, bytes, size, offset);
      if (++Reads == Nth && done > 0)
      {
        static_cast<unsigned char*>(bytes)[done / 2] ^= 4;
      }
      return done;
    };
    // All reads are counted, whether their bytes are cached or not.
    systemCalls().preadv2 = [](int, const iovec*, int, off_t, int)
    {
      errno = EOPNOTSUPP;
      return ssize_t(-1);
    };
  }
  ~FlippedRead() { systemCalls() = Real; }
  FlippedRead(const FlippedRead&) = delete;
  FlippedRead& operator=(const FlippedRead&) = delete;

  int reads() const { return Reads; }

private:
  inline static const SystemCalls Real = systemCalls();
  inline static int Nth = 0, Reads = 0;
};

/** Requires that each flipped bit is an Error in an operation, which reads at least so often. */
template <class Operation>
void expectNoticedFlips(int minReads, const Operation& operate)
{
  for (int nth = 1;; ++nth)
  {
    const FlippedRead flip(nth);
    const std::string message = messageOf(operate);
    if (flip.reads() < nth)
    {
      EXPECT_EQ(message, "");
      EXPECT_GE(flip.reads(), minReads);
      return;
    }
    ASSERT_TRUE(contains(message, "differs from what was written"))
      << "read " << nth << ": " << message;
  }
}

} // namespace smg::testing
