// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Conversion/Conversion.h"
#include "IO/Import/RawMesh.h"
#include "IO/Order/Assembly/StreamAssembly.h"
#include "Solver/Checkpoint/Checkpoint.h"
#include "Solver/Files/Folder.h"
#include "smg/Convert.h"

#include <filesystem>
#include <memory>
#include <optional>

namespace smg
{

/**
 * The stages of convertMesh() in the folder ConversionOptions::checkpoint. After a stage the
 * scratch files that the later ones read get names and are waited for; then the state is saved,
 * from which the same conversion continues. Without a checkpoint no stage is kept.
 */
class ConversionStages
{
public:
  enum Stage
  {
    None,
    Imported, ///< the mesh is complete, and merged points are merged
    LaidOut   ///< the layout is complete
  };

  explicit ConversionStages(Conversion& conversion);

  /** Restores the mesh and, if it is complete, the layout; both are empty. Returns the last stage
   * that is complete. Throws Error if the checkpoint is damaged or of another conversion. */
  Stage load(RawMesh& mesh, StreamLayout& layout);
  /** After a stage. */
  void save(Stage stage, RawMesh& mesh, StreamLayout& layout);
  /** When the result is complete: removes the checkpoint when the conversion ends. */
  void discard();

private:
  template <class State>
  void exchange(State& state, Stage& stage, RawMesh& mesh, StreamLayout& layout);

  Conversion& Owner;
  std::optional<Checkpoint> States;
};

/** A report on a conversion, for StateWriter and StateReader. */
struct ConversionReportState
{
  ConversionReport& report;

  template <class State>
  void exchange(State& state)
  {
    ConversionReport& r = this->report;
    state.part("report");
    state(r.order, r.time_steps, r.partitions, r.vertices, r.cells, r.isolated_vertices,
      r.merged_points, r.degenerate_cells, r.duplicate_cells, r.dropped_cells,
      r.triangulated_polygons, r.split_cells, r.higher_order_cells, r.inverted_cells, r.components,
      r.boundary_edges, r.nonmanifold_edges, r.nonmanifold_vertices, r.keeps_numbers, r.width,
      r.span, r.mean_width, r.pool_bytes_peak, r.rss_bytes_peak, r.scratch_bytes_read,
      r.scratch_bytes_written, r.pages, r.page_loads, r.cpu_seconds, r.seconds, r.notes);
  }
};

/** A mesh file converted in the folder of a checkpoint. */
struct CheckpointedConversion
{
  std::filesystem::path mesh;       ///< the .vsm file
  std::shared_ptr<FolderLock> lock; ///< of the folder, as long as the mesh is used
  ConversionReport report;
};

/**
 * Converts a mesh file to a .vsm file in the folder ConversionOptions::checkpoint, unless the same
 * conversion has been completed there. Throws Error as convert(), and if the folder has another
 * conversion or computation, other files, or is in use; then it is left as it is.
 */
CheckpointedConversion convertInCheckpoint(
  const std::filesystem::path& in, const ConversionOptions& options);

/** Throws Error if a folder has a conversion of convertInCheckpoint(), which another command is to
 * continue. */
void requireNoConversionIn(const std::filesystem::path& folder);

} // namespace smg
