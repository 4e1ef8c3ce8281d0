// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/ConversionStages.h"

#include "IO/Conversion/Conversion.h"
#include "IO/Conversion/ConversionFields.h"
#include "IO/Conversion/KeptConversion.h"
#include "IO/External/Relabelling.h"
#include "IO/Mesh/GroupsJson.h"
#include "Solver/Checkpoint/Checkpoint.h"
#include "Solver/Core/FieldsJson.h"
#include "smg/Error.h"
#include "smg/VsmReader.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace smg
{
namespace
{

/** Saves or restores the scratch files of a mesh and a layout, one after the other, with numbers as
 * names. */
template <class State>
class StageFiles
{
public:
  StageFiles(State& state, Workspace& workspace, const ScratchFolder& folder)
    : Exchanged(state)
    , Space(workspace)
    , Folder(folder)
  {
  }

  void exchange(RawMesh& mesh)
  {
    ImportCounts& c = mesh.counts;
    this->Exchanged.part("mesh");
    this->Exchanged(mesh.cellType, mesh.doublePositions, mesh.vertices, mesh.cells,
      mesh.elementCount, c.triangulatedPolygons, c.splitCells, c.higherOrderCells, c.droppedCells,
      c.mergedPoints, c.timeSteps, c.partitions, c.droppedColumns, c.notes);
    this->require(mesh.cellType == CellType::Triangle || mesh.cellType == CellType::Tetrahedron);
    this->require(mesh.vertices >= 0 && mesh.vertices < NoIndex && mesh.cells >= 0 &&
                  mesh.cells < NoIndex && mesh.elementCount >= 0 && mesh.elementCount < NoIndex);
    this->exchange(mesh.positions);
    this->exchange(mesh.corners.bytes());
    this->exchange(mesh.elements.bytes());
    this->exchange(mesh.vertexColumns);
    this->exchange(mesh.elementColumns);
    this->exchange(mesh.groups);
    this->exchange(mesh.facets.corners.bytes());
    this->exchange(mesh.facets.sets.bytes());
  }

  void exchange(StreamLayout& layout)
  {
    this->Exchanged.part("layout");
    this->Exchanged(layout.vertexCount, layout.cellCount, layout.degenerateCells,
      layout.duplicateCells, layout.invertedCells, layout.facetsElsewhere);
    this->exchange(layout.groups);
    this->exchange(layout.vertices);
    for (BucketFile* file : { &layout.corners.bytes(), &layout.elements.bytes(),
           &layout.flags.bytes(), &layout.facetGroups.bytes(), &layout.blockVertices.bytes(),
           &layout.blockFinalized.bytes() })
    {
      this->exchange(*file);
    }
  }

private:
  static constexpr bool Saves = std::is_same_v<State, StateWriter>;

  void require(bool valid) const
  {
    if constexpr (!Saves)
    {
      this->Exchanged.require(valid);
    }
  }

  void exchange(BucketFile& file)
  {
    const std::filesystem::path path =
      this->Folder.pathOf("stage." + std::to_string(this->Files++));
    if constexpr (Saves)
    {
      file.save(this->Exchanged, path);
    }
    else
    {
      file.load(this->Exchanged, path);
    }
  }

  void exchange(MeshGroups& groups)
  {
    std::string text = textOf(groups);
    this->Exchanged(text);
    if constexpr (!Saves)
    {
      groups = groupsOfText(text);
    }
  }

  void exchange(std::vector<RawColumn>& columns)
  {
    std::uint64_t count = columns.size();
    this->Exchanged(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      if constexpr (!Saves)
      {
        columns.push_back({ {}, BucketFile(this->Space) });
      }
      ColumnSpec& spec = columns[i].spec;
      this->Exchanged(spec.name, spec.type, spec.components, spec.isolated);
      this->exchange(columns[i].tuples);
    }
  }

  State& Exchanged;
  Workspace& Space;
  const ScratchFolder& Folder;
  int Files = 0;
};

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

ConversionStages::ConversionStages(Conversion& conversion)
  : Owner(conversion)
{
  if (ScratchFolder* folder = conversion.kept())
  {
    this->States.emplace(
      *folder, std::vector<Checkpoint::Item>{ { "kind of task", "conversion" },
                 { "mesh file or option", originOf(conversion.in(), conversion.options()) } });
  }
}

template <class State>
void ConversionStages::exchange(State& state, Stage& stage, RawMesh& mesh, StreamLayout& layout)
{
  FieldsState<ConversionReport> reported{ this->Owner.report() };
  StageFiles<State> files(state, this->Owner.workspace(), *this->Owner.kept());
  state(stage, reported);
  files.exchange(mesh);
  if (stage == LaidOut)
  {
    files.exchange(layout);
  }
}

auto ConversionStages::load(RawMesh& mesh, StreamLayout& layout) -> Stage
{
  std::optional<StateReader> state =
    this->States ? this->States->open(this->Owner.workspace().pool()) : std::nullopt;
  if (!state)
  {
    return None;
  }
  Stage stage = None;
  this->exchange(*state, stage, mesh, layout);
  state->require(stage == Imported || stage == LaidOut);
  state->finish();
  ConversionReport& report = this->Owner.report();
  report.seconds = {}; // those of this program
  report.notes.push_back(stage == Imported ? "continued with the mesh that the checkpoint has"
                                           : "continued with the order that the checkpoint has");
  return stage;
}

void ConversionStages::save(Stage stage, RawMesh& mesh, StreamLayout& layout)
{
  if (this->States)
  {
    this->States->save(
      stage, [&](StateWriter& state) { this->exchange(state, stage, mesh, layout); });
  }
}

void ConversionStages::discard()
{
  if (this->States)
  {
    this->States->discard();
  }
}

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
  FieldsState<ConversionReport> reported{ converted.report };
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
