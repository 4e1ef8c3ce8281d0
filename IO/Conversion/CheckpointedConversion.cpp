// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/CheckpointedConversion.h"

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
constexpr std::int64_t StateMemory = std::int64_t(1) << 24;

/** What a complete conversion leaves beside the mesh. */
template <class State>
void exchange(State& state, ConversionReport& r, std::string& fingerprint)
{
  state.part("conversion");
  state(fingerprint, r.order, r.time_steps, r.partitions, r.vertices, r.cells, r.isolated_vertices,
    r.merged_points, r.degenerate_cells, r.duplicate_cells, r.dropped_cells,
    r.triangulated_polygons, r.split_cells, r.higher_order_cells, r.inverted_cells, r.components,
    r.boundary_edges, r.nonmanifold_edges, r.nonmanifold_vertices, r.keeps_numbers, r.width, r.span,
    r.mean_width, r.pool_bytes_peak, r.rss_bytes_peak, r.scratch_bytes_read,
    r.scratch_bytes_written, r.pages, r.page_loads, r.cpu_seconds, r.seconds, r.notes);
}

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
  std::string fingerprint;
  if (std::optional<StateReader> state = states.open(memory))
  {
    exchange(*state, converted.report, fingerprint);
    state->finish();
    if (VsmReader(converted.mesh).fingerprint() != fingerprint)
    {
      state->fail("since " + converted.mesh.string() + " is another mesh");
    }
    return converted;
  }
  removeIncomplete(folder);
  converted.report = convert(in, converted.mesh, options);
  fingerprint = VsmReader(converted.mesh).fingerprint();
  states.save(1, [&](StateWriter& state) { exchange(state, converted.report, fingerprint); });
  return converted;
}

} // namespace smg
