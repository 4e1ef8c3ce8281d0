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
