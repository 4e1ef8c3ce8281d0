// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Core/Workers.h"
#include "smg/Error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace smg::testing
{
namespace
{

/** Work whose duration differs from number to number. */
std::uint64_t churn(int number)
{
  std::uint64_t state = static_cast<std::uint64_t>(number) + 1;
  for (int i = 0; i < (number * 7919) % 3000; ++i)
  {
    state = state * 6364136223846793005u + 1442695040888963407u;
  }
  return state;
}

struct Numbered
{
  int number = -1;
  std::uint64_t result = 0;
};

/** The threads do not cross a fork: a child runs all jobs itself, and does not wait for threads. */
TEST(Workers, OfAForkedChildRunJobsWithoutThreads)
{
  for (int round = 0; round < 20; ++round) // threads may sleep, spin, or hold the mutex
  {
    Workers workers(3);
    std::atomic<bool> isRunning{ false }, mayEnd{ false };
    Workers::Job longer(workers,
      [&]
      {
        isRunning = true;
        while (!mayEnd)
        {
        }
      });
    longer.submit();
    while (!isRunning)
    {
    }
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0)
    {
      alarm(60); // ends a child that hangs
      int done = 0;
      Workers::Job job(workers, [&done] { ++done; });
      job.submit();
      job.finish();
      bool isLost = false;
      try
      {
        longer.finish();
      }
      catch (const Error&)
      {
        isLost = true;
      }
      workers.~Workers();
      _exit(done == 1 && isLost ? 0 : 1);
    }
    mayEnd = true;
    longer.finish();
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
    EXPECT_EQ(WEXITSTATUS(status), 0);
  }
}

TEST(OrderedJobs, AreTakenInOrderByTheOwner)
{
  for (const int threads : { 1, 2, 3, 8, 16 })
  {
    for (const std::size_t most : { std::size_t(1), std::size_t(2), std::size_t(7) })
    {
      Workers workers(threads);
      std::vector<int> taken;
      std::atomic<int> running{ 0 }, maxRunning{ 0 };
      OrderedJobs<Numbered> jobs(
        workers, most,
        [&](Numbered& item)
        {
          const int now = ++running;
          for (int seen = maxRunning; seen < now && !maxRunning.compare_exchange_weak(seen, now);)
          {
          }
          item.result = churn(item.number);
          --running;
        },
        [&](Numbered& item)
        {
          EXPECT_FALSE(Workers::isCaller());
          EXPECT_EQ(item.result, churn(item.number));
          taken.push_back(item.number);
        });
      for (int number = 0; number < 500; ++number)
      {
        jobs.next().number = number;
        jobs.submit();
        EXPECT_LE(jobs.size(), most);
      }
      jobs.takeAll();
      ASSERT_EQ(taken.size(), 500u);
      EXPECT_TRUE(std::ranges::is_sorted(taken));
      EXPECT_LE(maxRunning, std::min(threads, static_cast<int>(most)));
    }
  }
}

TEST(OrderedJobs, TheFirstFailureInOrderIsThrown)
{
  for (const int threads : { 1, 2, 8 })
  {
    Workers workers(threads);
    int taken = 0;
    OrderedJobs<Numbered> jobs(
      workers, 8,
      [](Numbered& item)
      {
        if (item.number == 20)
        {
          churn(2999); // while the later ones fail
        }
        if (item.number >= 20)
        {
          throw Error("number " + std::to_string(item.number));
        }
      },
      [&taken](Numbered&) { ++taken; });
    try
    {
      for (int number = 0; number < 100; ++number)
      {
        jobs.next().number = number;
        jobs.submit();
      }
      FAIL();
    }
    catch (const Error& error)
    {
      EXPECT_STREQ(error.what(), "number 20");
    }
    EXPECT_EQ(taken, 20);
  } // the others are not waited for in vain
}

TEST(Workers, RunAllRunsEachTaskOnce)
{
  for (const int threads : { 1, 2, 3, 16 })
  {
    Workers workers(threads);
    EXPECT_EQ(workers.threads(), threads);
    for (const int count : { 0, 1, 2, 40 })
    {
      std::vector<int> runs(static_cast<std::size_t>(count));
      runAll(workers, count, [&runs](int task) { ++runs[static_cast<std::size_t>(task)]; });
      EXPECT_EQ(runs, std::vector<int>(static_cast<std::size_t>(count), 1));
    }
    EXPECT_THROW(runAll(workers, 5,
                   [](int task)
                   {
                     if (task == 3)
                     {
                       throw Error("three");
                     }
                   }),
      Error);
  }
}

} // namespace
} // namespace smg::testing
