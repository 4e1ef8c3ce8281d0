// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/CheckpointedConversion.h"

#include "IO/Conversion/ConversionReportState.h"
#include "IO/Conversion/KeptConversion.h"
#include "Solver/Storage/Checkpoint.h"
#include "smg/Error.h"
#include "smg/VsmReader.h"

#include <string>
#include <system_error>
#include <utility>

namespace smg
{
namespace
{

constexpr const char* MeshName = "mesh.vsm";
constexpr const char* StagesName = "stages";
constexpr std::int64_t StateMemory = std::int64_t(1) << 24;

/** Removes meshes that were not complete when their program was killed. */
void removeIncomplete(const ScratchFolder& folder)
{
  std::error_code ignored;
  for (std::filesystem::directory_iterator entry(folder.path(), ignored), end; entry != end;
       entry.increment(ignored))
  {
    if (entry->path().filename().string().starts_with(std::string(MeshName) + '.'))
    {
      std::filesystem::remove(entry->path(), ignored);
    }
  }
}

/** Converts with a checkpoint of its own in the folder, which remains with that. */
ConversionReport convertInStages(const std::filesystem::path& in, const std::filesystem::path& out,
  ConversionOptions options, ScratchFolder& folder)
{
  options.checkpoint = folder / StagesName;
  try
  {
    return convert(in, out, options);
  }
  catch (...)
  {
    folder.keep(std::filesystem::exists(options.checkpoint));
    throw;
  }
}

} // namespace

CheckpointedConversion convertInCheckpoint(
  const std::filesystem::path& in, const ConversionOptions& options)
{
  if (!std::filesystem::is_regular_file(in))
  {
    throw Error(in.string() + ": there is no such file to convert.");
  }
  ScratchFolder folder{ KeptFolder(options.checkpoint) };
  Checkpoint states(folder, { { "mesh file", originOf(in, options) } }, "conversion");
  Pool memory(StateMemory);
  CheckpointedConversion converted{ folder / MeshName, {} };
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
  removeIncomplete(folder);
  converted.report = convertInStages(in, converted.mesh, options, folder);
  fingerprint = VsmReader(converted.mesh).fingerprint();
  states.save(1, [&](StateWriter& state) { state(fingerprint, reported); });
  return converted;
}

} // namespace smg
