// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Mesh/Columns.h"
#include "IO/Arrays/MeshBlocks.h"
#include "IO/Arrays/ReadColumn.h"
#include "IO/Files/PartialProgress.h"
#include "Python/C/Call.h"
#include "Python/C/Field.h"
#include "Python/C/Options.h"
#include "smg/VsmReader.h"

#include <algorithm>
#include <limits>
#include <utility>

/** A mesh or a field, block after block. */
struct smg_blocks
{
  std::shared_ptr<smg::SharedMesh> shared; ///< whose file is read, unless it is that of a field
  std::shared_ptr<const smg::ScratchFolder> scratch; ///< with the file of a field
  std::unique_ptr<smg::MeshBlocks> blocks;
  bool isAtBlock = false;
};

namespace smg
{
namespace
{

/** Reads a column that is the solution of a field, or components of it; returns whether it is. */
bool readSolutionOf(
  smg_field& field, const std::string& name, std::byte* values, const ProgressFunction& progress)
{
  int first = 0;
  for (const ColumnSpec& column : field.job->solutionColumns(field.stored().info()))
  {
    if (column.name == name)
    {
      readSolution(field.stored(), *field.shared->order(progress), field.added.get(),
        *field.solution, first, column, values, progress);
      return true;
    }
    first += column.components;
  }
  return false;
}

/** Whether a column of a field is another one than that of its mesh. */
bool isOfResult(const smg_field& field, bool ofCells, const std::string& name)
{
  const StreamInfo& mesh = field.stored().info();
  const AddedValues added = field.job->addedTo(mesh);
  const std::vector<ColumnSpec>& specs = ofCells ? added.ofCells : added.ofVertices;
  return std::ranges::find(specs, name, &ColumnSpec::name) != specs.end() ||
         (added.movesVertices && isNormals(columnOf(mesh, ofCells, name)));
}

void readOf(smg_field& field, bool ofCells, const std::string& name, std::byte* values,
  const ProgressFunction& progress)
{
  columnOf(field.info(), ofCells, name);
  if (!ofCells && readSolutionOf(field, name, values, progress))
  {
    // The program has the result: no other needs to continue.
    field.solution->removeCheckpoint();
    return;
  }
  const std::shared_ptr<const OriginalOrder> order = field.shared->order(progress);
  if (isOfResult(field, ofCells, name))
  {
    readColumn(VsmReader(field.file(progress)), *order, nullptr, ofCells, name, values, progress);
    if (!ofCells)
    {
      fillMerged(*order, columnOf(field.info(), ofCells, name), values);
    }
    return;
  }
  readColumn(field.stored(), *order, field.added.get(), ofCells, name, values, progress);
}

MeshBlocksOptions blocksOptions(const char* text)
{
  const nlohmann::json json = optionsText(text, "options");
  return argument(
    [&]
    {
      const JsonNode node(json, "options");
      node.requireObject({ "points", "columns", "cell_columns" });
      MeshBlocksOptions options;
      if (node.has("points"))
      {
        options.points = node.member("points").integer(4, std::numeric_limits<std::int64_t>::max());
      }
      const auto names = [&node](const char* key, std::optional<std::vector<std::string>>& chosen)
      {
        if (node.has(key))
        {
          chosen.emplace();
          for (const JsonNode& name : node.member(key).elements())
          {
            chosen->push_back(name.columnName());
          }
        }
      };
      names("columns", options.vertexColumns);
      names("cell_columns", options.cellColumns);
      return options;
    });
}

/** An array of the block, by a function of the blocks. */
template <class Function>
smg_status arrayOf(const smg_blocks* blocks, smg_array* array, const Function& function)
{
  return guarded(
    [&]
    {
      const smg_blocks& given = required(blocks, "blocks");
      if (!given.isAtBlock)
      {
        throw ArgumentError("blocks: there is no block here: call smg_next_block() before.");
      }
      const ArrayView view = function(*given.blocks);
      required(array, "array") = { view.data, static_cast<smg_type>(view.type), view.rows,
        view.columns, view.rowStride, view.columnStride };
    });
}

} // namespace
} // namespace smg

smg_status smg_read(smg_mesh* mesh, smg_field* field, const char* name, int cells,
  smg_progress progress, void* user, void* values)
{
  return smg::guarded(
    [&]
    {
      const std::string column = &smg::required(name, "name");
      auto* const room = &smg::required(static_cast<std::byte*>(values), "values");
      const smg::ProgressFunction reported = smg::progressOf(progress, user);
      if (field)
      {
        smg::readOf(*field, cells != 0, column, room, reported);
        return;
      }
      const smg_mesh given = smg::required(mesh, "mesh and field").withoutArguments();
      const auto order = given.shared->order(reported);
      smg::readColumn(
        given.stored(), *order, given.added.get(), cells != 0, column, room, reported);
      const bool isAdded = given.added && given.added->find(false, column);
      if (cells == 0 && given.shared->isResult(column) && !isAdded)
      {
        smg::fillMerged(*order, smg::columnOf(given.stored().info(), false, column), room);
      }
    });
}

smg_status smg_open_blocks(smg_mesh* mesh, smg_field* field, const char* options,
  smg_progress progress, void* user, smg_blocks** blocks)
{
  return smg::guarded(
    [&]
    {
      smg::required(blocks, "blocks") = nullptr;
      smg::MeshBlocksOptions given = smg::blocksOptions(options);
      const smg::ProgressFunction reported = smg::progressOf(progress, user);
      auto made = std::make_unique<smg_blocks>();
      if (field)
      {
        made->shared = field->shared;
        const std::filesystem::path& file = field->file(smg::partOf(reported, 0.0, 0.9));
        made->scratch = field->scratch();
        made->blocks = std::make_unique<smg::MeshBlocks>(
          file, field->shared->order(smg::partOf(reported, 0.9, 1.0)), nullptr, given);
      }
      else
      {
        const smg_mesh of = smg::required(mesh, "mesh and field").withoutArguments();
        made->shared = of.shared;
        given.fingerprint = of.stored().fileFingerprint();
        made->blocks = std::make_unique<smg::MeshBlocks>(
          of.stored().file(), of.shared->order(reported), of.added, given);
      }
      *blocks = made.release();
    });
}

smg_status smg_next_block(smg_blocks* blocks, int64_t* vertices, int64_t* cells)
{
  return smg::guarded(
    [&]
    {
      smg_blocks& given = smg::required(blocks, "blocks");
      int64_t& ofVertices = smg::required(vertices, "vertices");
      int64_t& ofCells = smg::required(cells, "cells");
      given.isAtBlock = given.blocks->next();
      ofVertices = given.isAtBlock ? given.blocks->vertices() : 0;
      ofCells = given.isAtBlock ? given.blocks->cells() : 0;
    });
}

smg_status smg_block_array(smg_blocks* blocks, const char* name, int cells, smg_array* array)
{
  return smg::arrayOf(blocks, array,
    [&](const smg::MeshBlocks& of) { return of.array(cells != 0, &smg::required(name, "name")); });
}

smg_status smg_block_rows(smg_blocks* blocks, int cells, smg_array* rows)
{
  return smg::arrayOf(
    blocks, rows, [cells](const smg::MeshBlocks& of) { return of.rows(cells != 0); });
}

smg_status smg_block_ghosts(smg_blocks* blocks, smg_array* ghosts)
{
  return smg::arrayOf(blocks, ghosts, [](const smg::MeshBlocks& of) { return of.ghosts(); });
}

void smg_close_blocks(smg_blocks* blocks)
{
  delete blocks;
}
