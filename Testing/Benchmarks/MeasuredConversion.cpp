// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Benchmarks/MeasuredConversion.h"

#include "Testing/Benchmarks/ChildProcess.h"
#include "Testing/Benchmarks/ScratchSampler.h"
#include "Testing/Benchmarks/Usage.h"
#include "smg/Convert.h"
#include "smg/Error.h"

#include <sys/resource.h>

#include <chrono>

namespace smg::benchmark
{
namespace
{

/** Like `ulimit -v`. */
void limitAddressSpace(std::int64_t bytes)
{
  const rlimit limit = { static_cast<rlim_t>(bytes), static_cast<rlim_t>(bytes) };
  if (bytes > 0 && setrlimit(RLIMIT_AS, &limit) != 0)
  {
    throw Error("The address space cannot be limited to " + std::to_string(bytes) + " bytes.");
  }
}

nlohmann::json converted(const ConversionTask& task)
{
  limitAddressSpace(task.addressSpace);
  ConversionOptions options;
  options.order = streamOrder(task.order);
  options.memoryLimit = task.memory;
  options.scratch = task.scratch;

  const auto begin = std::chrono::steady_clock::now();
  ScratchSampler sampler(task.scratch);
  const ConversionReport report = convert(task.mesh, task.output, options);
  const ScratchSampler::Result scratch = sampler.finish();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;

  nlohmann::json result = nlohmann::json::parse(report.json());
  result["cpu_seconds"] = cpuSeconds() - scratch.cpuSeconds;
  result["wall_seconds"] = wall.count();
  result["peak_bytes"] = peakBytes();
  result["scratch_bytes_peak"] = scratch.largest;
  result["output_bytes"] = std::filesystem::file_size(task.output);
  return result;
}

} // namespace

nlohmann::json measureConversion(const ConversionTask& task)
{
  return runInChild([&] { return converted(task); });
}

} // namespace smg::benchmark
