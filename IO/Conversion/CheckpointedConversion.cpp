// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/CheckpointedConversion.h"

#include "IO/Conversion/Conversion.h"
#include "IO/Conversion/ConversionReportState.h"
#include "IO/Conversion/KeptConversion.h"
#include "Solver/Checkpoint/Checkpoint.h"
#include "smg/Error.h"
#include "smg/VsmReader.h"

#include <string>

namespace smg
{
namespace
{

constexpr const char* MeshName = "mesh.vsm";
constexpr const char* StagesName = "stages";
constexpr const char* StateName = "state-conversion";
constexpr std::int64_t StateMemory = std::int64_t(1) << 24;

/** Converts with a checkpoint of its own in the folder, which remains with that. */
ConversionReport convertInStages(const std::filesystem::path& in, const std::filesystem::path& out,
  ConversionOptions options, ScratchFolder& folder)
{
  options.checkpoint.clear();
  if (Conversion::hasStages(in, options))
  {
    options.checkpoint = folder / StagesName;
  }
  try
  {
    return convert(in, out, options);
  }
  catch (...)
  {
    if (std::filesystem::exists(folder / StagesName))
    {
      folder.retain();
    }
    throw;
  }
}

[[noreturn]] void failOther(const std::filesystem::path& folder)
{
  throw Error(folder.string() +
              ": is the checkpoint of a computation on another mesh file: repeat its command to "
              "continue it, or remove the folder to begin anew.");
}

} // namespace

void requireNoConversionIn(const std::filesystem::path& folder)
{
  if (Checkpoint::steps(folder, StateName) > 0 || std::filesystem::exists(folder / StagesName))
  {
    failOther(folder);
  }
}

CheckpointedConversion convertInCheckpoint(
  const std::filesystem::path& in, const ConversionOptions& options)
{
  if (!std::filesystem::is_regular_file(in))
  {
    throw Error(in.string() + ": there is no such file to convert.");
  }
  ScratchFolder folder{ KeptFolder(options.checkpoint) };
  Checkpoint states(folder, { { "mesh file", originOf(in, options) } }, StateName);
  Pool memory(StateMemory);
  CheckpointedConversion converted{ folder.pathOf(MeshName), folder.lock(), {} };
  ConversionReportState reported{ converted.report };
  std::string fingerprint;
  if (std::optional<StateReader> state = states.open(memory))
  {
    (*state)(fingerprint, reported);
    state->finish();
    if (VsmReader(converted.mesh).fingerprint() != fingerprint)
    {
      state->fail("since " + converted.mesh.string() + " is another mesh");
    }
    return converted;
  }
  if (Checkpoint::steps(folder.path()) > 0)
  {
    failOther(folder.path());
  }
  converted.report = convertInStages(in, converted.mesh, options, folder);
  fingerprint = VsmReader(converted.mesh).fingerprint();
  states.save(1, [&](StateWriter& state) { state(fingerprint, reported); });
  return converted;
}

} // namespace smg
