// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/FileNames.h"
#include "IO/Formats/Vtk/VtkArrayReader.h"
#include "IO/Formats/Vtk/VtkAttributes.h"
#include "IO/Formats/Vtk/VtkCell.h"
#include "IO/Formats/Vtk/VtkCellReader.h"
#include "IO/Formats/Vtk/VtkLayout.h"
#include "IO/Import/ImportColumn.h"
#include "IO/Import/RawMeshBuilder.h"
#include "IO/Mesh/Columns.h"
#include "IO/Mesh/GroupsJson.h"
#include "Solver/Memory/Pool.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace smg
{

namespace
{

const VtkArray* find(const std::vector<VtkArray>& arrays, const std::string& name)
{
  const auto found = std::ranges::find(arrays, name, &VtkArray::name);
  return found == arrays.end() ? nullptr : &*found;
}

bool isSame(const VtkArray& a, const VtkArray& b)
{
  return a.columnType == b.columnType && a.components == b.components;
}

/** Which cells of a piece belong to it alone, in their order. */
class OwnCells
{
public:
  /** All do. */
  OwnCells() = default;
  /** Those from cell `first` on, by their ghost types. */
  OwnCells(InputFile& file, const VtkArray& ghostTypes, std::int64_t first, Workspace& workspace)
    : GhostTypes(std::make_unique<VtkIndexReader>(file, ghostTypes, workspace))
  {
    this->GhostTypes->skip(first);
  }

  bool areAll() const { return !this->GhostTypes; }
  /** Whether the next one does. */
  bool next() { return this->areAll() || isOwnVtkCell(this->GhostTypes->next()); }

private:
  std::unique_ptr<VtkIndexReader> GhostTypes;
};

/** The groups of cells, by their labels; 0 is no group. */
class CellLabels
{
public:
  /** There are none. */
  CellLabels() = default;
  /** Those from cell `first` on. */
  CellLabels(InputFile& file, const VtkArray& labels, std::int64_t first, RawMeshBuilder& builder)
    : Labels(std::make_unique<VtkIndexReader>(file, labels, builder.workspace()))
    , Builder(&builder)
  {
    this->Labels->skip(first);
  }

  bool exist() const { return this->Labels != nullptr; }
  /** The next cell, of VTK's type `type`, is added with its groups. */
  void begin(int type)
  {
    if (this->exist())
    {
      const std::int64_t label = this->Labels->next();
      this->Builder->setGroups(label == 0
                                 ? GroupTable::None
                                 : this->Builder->groups().numbered(dimensionOfVtk(type), label));
    }
  }

private:
  std::unique_ptr<VtkIndexReader> Labels;
  RawMeshBuilder* Builder = nullptr;
};

class MeshReader
{
public:
  MeshReader(VtkFiles& files, const VtkLayout& layout, RawMeshBuilder& builder)
    : Files(files)
    , Layout(layout)
    , Builder(builder)
    , Space(builder.workspace())
  {
  }

  void read()
  {
    this->readGroups();
    if (this->Builder.looks())
    {
      this->look();
      return;
    }
    if (VtkPointMerger::applies(this->Layout))
    {
      this->Merger = std::make_unique<VtkPointMerger>(this->Files, this->Layout, this->Builder);
    }
    this->readPoints();
    this->readCells();
    this->readColumns(&VtkPiece::pointArrays);
    this->readColumns(&VtkPiece::cellArrays);
    noteArrays(this->Builder, this->Layout.otherArrays, this->Layout.repeatedArrays);
    noteFields(this->Builder, this->Layout.fields);
    // Ghost cells of several pieces belong to others of them; those of a lone piece are missing.
    if (this->Layout.pieces.size() == 1 && !this->Layout.isPart)
    {
      noteGhosts(this->Builder, this->Ghosts);
    }
  }

private:
  /** The groups of a mesh that this library has written, in a text. */
  void readGroups()
  {
    std::string text = this->Layout.groupsText;
    if (this->Layout.groupsArray)
    {
      constexpr std::size_t Longest = MaxGroupTextBytes, AtOnce = std::size_t(1) << 20;
      VtkArrayReader reader(
        this->Files.open(0, VtkFiles::Main), *this->Layout.groupsArray, this->Space);
      for (auto some = reader.some(AtOnce); !some.empty() && text.size() < Longest;
           some = reader.some(AtOnce))
      {
        text.append(reinterpret_cast<const char*>(some.data()), some.size());
      }
      text.resize(std::min(text.find('\0'), text.size()));
    }
    if (text.empty())
    {
      return;
    }
    try
    {
      this->Groups = groupsOfText(text);
      this->Builder.setGroups(this->Groups);
    }
    catch (const MeshError& error)
    {
      this->Builder.note(
        "The groups of the file are left out: it " + std::string(error.what()) + '.');
    }
  }

  /** Whether an array is one of groups that goes with those of the file. */
  bool isOfGroups(const VtkArray& array, bool ofPoints) const
  {
    const ColumnSpec spec{ array.name, array.columnType, array.components };
    return !this->Groups.empty() &&
           (MeshGroups::isOfMesh(spec, ofPoints, 3) || MeshGroups::isOfMesh(spec, ofPoints, 4));
  }

  /** Passes the tuples on; those of groups must be sets that there are. */
  void append(ImportColumn& column, bool areGroups, std::span<const std::byte> tuples) const
  {
    for (std::size_t i = 0; areGroups && i + sizeof(GroupSet) <= tuples.size();
         i += sizeof(GroupSet))
    {
      GroupSet set = 0;
      std::memcpy(&set, &tuples[i], sizeof(set));
      if (set >= this->Groups.sets.size())
      {
        throw MeshError("an array has a set of groups, number " + std::to_string(set) +
                        ", that the file does not have");
      }
    }
    column.append(tuples);
  }

  /** Declares the columns, and passes cells until one ends that. */
  void look()
  {
    this->declarePrecision();
    this->readColumns(&VtkPiece::pointArrays);
    this->readColumns(&VtkPiece::cellArrays);
    this->readCells();
  }

  std::size_t lists() const
  {
    return this->Layout.pieces.empty() ? 0 : this->Layout.pieces.front().lists.size();
  }

  /** Reports the end of a step of a piece. */
  void advance()
  {
    // The number of columns is unknown yet; each takes less time than points and cells.
    ++this->Steps;
    this->Files.progress(1.0 - 1.0 / (1.0 + static_cast<double>(this->Steps) /
                                              static_cast<double>(this->Layout.pieces.size())));
  }

  InputFile& open(const VtkPiece& piece) { return this->Files.open(piece.file, VtkFiles::Main); }

  [[noreturn]] void failAt(
    const VtkPiece& piece, const char* what, std::int64_t number, const char* sentence)
  {
    const std::string text = std::string(what) + ' ' + std::to_string(number) +
                             (this->Layout.pieces.size() > 1 ? " of its piece" : "") + ": " +
                             sentence;
    throw Error(this->open(piece).name() + ", " + text + '.');
  }

  void declarePrecision()
  {
    const bool isDouble = std::ranges::any_of(this->Layout.pieces, [](const VtkPiece& piece)
      { return piece.points > 0 && piece.positions->type != ScalarType::Float32; });
    if (!isDouble)
    {
      this->Builder.useSinglePrecision();
    }
  }

  void readPoints()
  {
    this->declarePrecision();
    std::optional<VtkPointMerger::Walk> walk;
    if (this->Merger)
    {
      walk.emplace(*this->Merger);
    }
    for (const VtkPiece& piece : this->Layout.pieces)
    {
      if (piece.points > 0)
      {
        this->readPoints(piece, walk ? &*walk : nullptr);
      }
      this->advance();
    }
  }

  void readPoints(const VtkPiece& piece, VtkPointMerger::Walk* walk)
  {
    VtkArray array = *piece.positions;
    array.columnType = ScalarType::Float64;
    VtkArrayReader reader(this->open(piece), array, this->Space);
    std::int64_t point = 0;
    copyVtkTuples(
      reader, piece.points, [] { return true; }, true,
      [&](std::span<const std::byte> bytes)
      {
        const auto* p = reinterpret_cast<const double*>(bytes.data());
        for (std::size_t i = 0; i < bytes.size() / 24; ++i, ++point, p += 3)
        {
          if (walk && !walk->next())
          {
            continue;
          }
          try
          {
            this->Builder.vertex(p[0], p[1], p[2]);
          }
          catch (const MeshError& error)
          {
            this->failAt(piece, "point", point, error.what());
          }
        }
      });
  }

  OwnCells ownCells(const VtkPiece& piece, std::int64_t first)
  {
    const VtkArray* array = find(piece.cellArrays, GhostTypeName);
    return array && array->components == 1
             ? OwnCells(this->Files.open(piece.file, VtkFiles::Ghosts), *array, first, this->Space)
             : OwnCells();
  }

  CellLabels labels(const VtkPiece& piece, std::int64_t first)
  {
    for (const std::string_view name : VtkLabelNames)
    {
      if (!this->Groups.empty())
      {
        break;
      }
      const VtkArray* array = find(piece.cellArrays, std::string(name));
      if (array && array->components == 1 && !isReal(array->type) && !this->Builder.looks())
      {
        return CellLabels(
          this->Files.open(piece.file, VtkFiles::Labels), *array, first, this->Builder);
      }
    }
    return {};
  }

  /** Cells of a piece in the lists before `list`. */
  static std::int64_t cellsBefore(const VtkPiece& piece, std::size_t list)
  {
    std::int64_t cells = 0;
    for (std::size_t i = 0; i < list; ++i)
    {
      cells += piece.lists[i].cells;
    }
    return cells;
  }

  void readCells()
  {
    for (std::size_t list = 0; list < this->lists(); ++list)
    {
      std::int64_t base = 0;
      for (const VtkPiece& piece : this->Layout.pieces)
      {
        this->readCells(piece, list, base);
        base += piece.points;
        this->advance();
      }
    }
  }

  void readCells(const VtkPiece& piece, std::size_t list, std::int64_t base)
  {
    const VtkCellList& cells = piece.lists[list];
    const bool cannotEndIt = this->Builder.looks() && !cells.types && isPointOrLine(cells.type);
    if (cells.cells == 0 || cannotEndIt)
    {
      return;
    }
    const std::int64_t first = cellsBefore(piece, list);
    CellLabels labels = this->labels(piece, first);
    VtkCellReader reader(this->Files, piece.file, cells, this->Space, labels.exist());
    OwnCells own = this->ownCells(piece, first);
    this->Builder.numberVertices(0, piece.points, base);
    std::int64_t cell = 0;
    try
    {
      for (; cell < cells.cells; ++cell)
      {
        const std::span<const std::int64_t> points = reader.next();
        labels.begin(reader.type());
        if (own.next())
        {
          takeVtkCell(reader.type(), points, this->Builder);
        }
        else
        {
          ++this->Ghosts;
        }
      }
    }
    catch (const MeshError& error)
    {
      this->failAt(piece, "cell", first + cell, error.what());
    }
    reader.finish();
  }

  void readColumns(std::vector<VtkArray> VtkPiece::*arrays)
  {
    const bool ofPoints = arrays == &VtkPiece::pointArrays;
    const auto size = [ofPoints](const VtkPiece& piece)
    { return ofPoints ? piece.points : piece.cells; };
    const auto full = std::ranges::find_if(
      this->Layout.pieces, [&](const VtkPiece& piece) { return size(piece) > 0; });
    if (full == this->Layout.pieces.end())
    {
      return;
    }
    for (const VtkArray& array : (*full).*arrays)
    {
      // The arrays by which pieces were joined are not data.
      if (array.name == GhostTypeName ||
          (ofPoints && array.name == (*full).globalIds && array.name == GlobalIdsName))
      {
        continue;
      }
      const bool everywhere = std::ranges::all_of(this->Layout.pieces,
        [&](const VtkPiece& piece)
        {
          const VtkArray* own = find(piece.*arrays, array.name);
          return size(piece) == 0 || (own && isSame(*own, array));
        });
      if (!everywhere)
      {
        this->Builder.note("The array " + inQuotes(array.name) +
                           " is left out, since not all pieces have it in the same type.");
        continue;
      }
      const bool areGroups = isGroupColumn(array.name);
      if (areGroups && !this->isOfGroups(array, ofPoints))
      {
        continue;
      }
      const std::string name = columnName(array.name, array.components, (*full).*arrays,
        ofPoints ? (*full).pointNormals : (*full).cellNormals,
        ofPoints ? (*full).pointTexture : "");
      const ColumnSpec spec{ name, array.columnType, array.components };
      ImportColumn column(this->Builder, ofPoints ? ColumnOf::Vertices : ColumnOf::Elements, spec);
      if (column.exists())
      {
        ofPoints ? this->readPointColumn(array.name, column, areGroups)
                 : this->readCellColumn(array.name, column, areGroups);
        column.close();
      }
    }
  }

  void readPointColumn(const std::string& name, ImportColumn& column, bool areGroups)
  {
    std::optional<VtkPointMerger::Walk> walk;
    if (this->Merger)
    {
      walk.emplace(*this->Merger);
    }
    for (const VtkPiece& piece : this->Layout.pieces)
    {
      if (piece.points == 0)
      {
        continue;
      }
      VtkArrayReader reader(this->open(piece), *find(piece.pointArrays, name), this->Space);
      copyVtkTuples(
        reader, piece.points, [&walk] { return walk->next(); }, !walk,
        [&](std::span<const std::byte> tuples) { this->append(column, areGroups, tuples); });
      this->advance();
    }
  }

  void readCellColumn(const std::string& name, ImportColumn& column, bool areGroups)
  {
    for (std::size_t list = 0; list < this->lists(); ++list)
    {
      for (const VtkPiece& piece : this->Layout.pieces)
      {
        if (piece.lists[list].cells == 0)
        {
          continue;
        }
        const VtkArray& array = *find(piece.cellArrays, name);
        const std::int64_t first = cellsBefore(piece, list);
        VtkArrayReader reader(this->open(piece), array, this->Space);
        reader.skip(first * array.components);
        OwnCells own = this->ownCells(piece, first);
        copyVtkTuples(
          reader, piece.lists[list].cells, [&own] { return own.next(); }, own.areAll(),
          [&](std::span<const std::byte> tuples) { this->append(column, areGroups, tuples); });
        this->advance();
      }
    }
  }

  VtkFiles& Files;
  const VtkLayout& Layout;
  RawMeshBuilder& Builder;
  Workspace& Space;
  MeshGroups Groups; ///< of a file that this library has written
  std::unique_ptr<VtkPointMerger> Merger;
  std::int64_t Steps = 0;
  std::int64_t Ghosts = 0; ///< cells that are left out
};

} // namespace

void readVtkMesh(InputFile& file, const VtkLayout& layout, RawMeshBuilder& builder,
  const ProgressFunction& progress)
{
  if (layout.pieces.size() > 1 && !VtkPointMerger::applies(layout))
  {
    builder.note("The pieces of " + file.name() +
                 " have no global numbers of points (GlobalIds): points that pieces share stay "
                 "separate, and the mesh is open where pieces meet.");
  }
  const Reservation reserved(builder.workspace().pool(), layout.bytes);
  VtkFiles files(file, layout, progress);
  MeshReader(files, layout, builder).read();
}

} // namespace smg
