// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <sys/stat.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>

namespace smg::testing
{

/** The bytes of all files in a folder, and of the nameless ones that this process has open there.
 */
inline std::int64_t bytesBelow(const std::filesystem::path& folder)
{
  std::int64_t bytes = 0;
  std::error_code gone;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
  {
    bytes += entry.is_regular_file() ? static_cast<std::int64_t>(entry.file_size(gone)) : 0;
  }
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd"))
  {
    struct stat status = {};
    const std::string file = std::filesystem::read_symlink(entry, gone).string();
    if (file.starts_with(folder.string()) && ::stat(entry.path().c_str(), &status) == 0 &&
        S_ISREG(status.st_mode) && status.st_nlink == 0)
    {
      bytes += status.st_size;
    }
  }
  return bytes;
}

/**
 * Checks that the limit of scratch files holds for `run(options)`, whose result has `bytes`, the
 * most bytes of scratch files at once, and `same(other)`: the need passes with the same result,
 * less is an error with both figures, and the files never have more bytes than the limit.
 */
template <class Options>
void expectScratchLimitKept(Options options, const auto& run)
{
  const TemporaryFolder folder;
  options.scratch = folder.path();
  const auto whole = run(options);
  ASSERT_GT(whole.bytes, 0);

  std::int64_t observed = 0;
  options.progress = [&](double /*done*/)
  {
    observed = std::max(observed, bytesBelow(folder.path()));
    return true;
  };
  options.scratchLimit = whole.bytes;
  const auto limited = run(options);
  EXPECT_EQ(limited.bytes, whole.bytes);
  EXPECT_TRUE(limited.same(whole));
  EXPECT_LE(observed, whole.bytes);
  EXPECT_GE(observed, whole.bytes / 2) << "too few files were observed";

  for (const std::int64_t limit : { whole.bytes - 1, whole.bytes / 2, std::int64_t(1) })
  {
    observed = 0;
    options.scratchLimit = limit;
    const std::string sentence = messageOf([&] { run(options); });
    EXPECT_EQ(folder.entries(), 0);
    EXPECT_LE(observed, limit);
    EXPECT_TRUE(sentence.starts_with(folder.path().string() + ": the scratch files")) << sentence;
    EXPECT_NE(sentence.find('(' + std::to_string(limit) + " bytes)"), std::string::npos)
      << sentence;
    EXPECT_NE(sentence.find("--scratch-limit"), std::string::npos) << sentence;
    EXPECT_EQ(sentence.find('\n'), std::string::npos);
  }
}

} // namespace smg::testing
