// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/VtkHdf/Hdf5/VtkHdfLayout.h"

#include "IO/Files/FileNames.h"
#include "IO/Files/InputFile.h"
#include "IO/Formats/Vtk/ByteSource.h"
#include "IO/Formats/Vtk/VtkAttributes.h"
#include "IO/Formats/VtkHdf/Hdf5/Hdf5File.h"
#include "Solver/Memory/Pool.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace smg
{
namespace
{

class LayoutReader
{
public:
  LayoutReader(const Hdf5File& file, const MeshPart& part, std::int64_t maxBytes)
    : File(file)
    , Partition(part.partition)
    , MaxBytes(maxBytes)
    , Step(file, part.timeStep)
  {
  }

  VtkHdfLayout read()
  {
    const std::string type = this->File.text("/VTKHDF", "Type").value_or("");
    if (type != "UnstructuredGrid" && type != "PolyData")
    {
      this->File.fail("the file holds " + (type.empty() ? "no mesh of VTK" : inQuotes(type)) +
                      "; VTKHDF files of the types UnstructuredGrid and PolyData are read");
    }
    this->Layout.timeSteps = this->Step.steps();
    this->Points = this->File.integers(VtkHdfRoot + "NumberOfPoints");
    this->choosePartitions();
    this->readAttributes("PointData", this->PointArrays);
    this->readAttributes("CellData", this->CellArrays);
    this->readFieldNames();
    this->checkMemory();
    if (type == "PolyData")
    {
      this->addLists(
        { { "Vertices", VtkCellTypes::PolyVertex }, { "Lines", VtkCellTypes::PolyLine },
          { "Polygons", VtkCellTypes::Polygon }, { "Strips", VtkCellTypes::TriangleStrip } });
    }
    else
    {
      this->addLists({ { "", 0 } });
    }
    this->addPieces();
    return std::move(this->Layout);
  }

private:
  /** The cells of one kind of all partitions. */
  struct Cells
  {
    std::string group; ///< with a slash at its end
    int type;          ///< 0: individual types
    std::vector<std::int64_t> cells, points;
    std::int64_t firstCell = 0, firstPoint = 0; ///< of the time step, then of a partition
    std::int64_t firstEnd = 0; ///< partitions before these cells: each has an end more than cells
  };
  struct Attribute
  {
    VtkArray array;
    std::int64_t first = 0; ///< row of the time step
  };

  void choosePartitions()
  {
    const auto own = this->Step.partitions(static_cast<std::int64_t>(this->Points.size()));
    this->FirstPart = own.first;
    this->Parts = own.count;
    this->FirstPoint = this->Step.number("PointOffsets", 0);
    this->Points = this->part(this->Points, "NumberOfPoints");
    this->Layout.partitions = own.count;
    this->Layout.isPart = this->Partition && own.count > 1;
    if (this->Partition && (*this->Partition < 0 || *this->Partition >= own.count))
    {
      this->File.fail("there is no partition " + std::to_string(*this->Partition) + ": there are " +
                      std::to_string(own.count) + ", counted from 0 (option --partition)");
    }
  }

  /** Refuses more partitions than fit into the memory. */
  void checkMemory()
  {
    constexpr std::int64_t PieceBytes = 2000, ArrayBytes = 300;
    const auto arrays =
      static_cast<std::int64_t>(this->PointArrays.size() + this->CellArrays.size());
    this->Layout.bytes = (this->Partition ? 1 : this->Parts) * (PieceBytes + ArrayBytes * arrays);
    if (this->Layout.bytes > this->MaxBytes)
    {
      this->File.fail(
        std::to_string(this->Parts) + " partitions take " +
        std::to_string((this->Layout.bytes >> 20) + 1) +
        " MiB, more than the memory limit allows for the layout of the file: raise it");
    }
  }

  /** The counts of the partitions of the time step. */
  std::vector<std::int64_t> part(const std::vector<std::int64_t>& counts, const std::string& name)
  {
    const auto needed = static_cast<std::size_t>(this->FirstPart + this->Parts);
    if (counts.size() < needed)
    {
      this->File.fail("the dataset " + inQuotes(VtkHdfRoot + name) + " should have " +
                      std::to_string(needed) + " numbers");
    }
    std::vector<std::int64_t> chosen(
      counts.begin() + this->FirstPart, counts.begin() + static_cast<std::ptrdiff_t>(needed));
    std::int64_t sum = 0;
    for (const std::int64_t count : chosen)
    {
      if (count < 0 || count > VtkHdfMostRows - sum)
      {
        this->File.fail(
          "a number of the dataset " + inQuotes(VtkHdfRoot + name) + " cannot be right");
      }
      sum += count;
    }
    return chosen;
  }

  std::vector<std::int64_t> counts(const std::string& name)
  {
    return this->part(this->File.integers(VtkHdfRoot + name), name);
  }

  /** The shape of a dataset, which is queried once. */
  const Hdf5Shape& shapeOf(const std::string& dataset)
  {
    const auto found = this->Shapes.find(dataset);
    return found != this->Shapes.end()
             ? found->second
             : this->Shapes.emplace(dataset, this->File.shape(dataset)).first->second;
  }

  /** An array of a dataset whose rows have `components` numbers, 0: any number of them. */
  VtkArray arrayOf(const std::string& dataset, std::int64_t components)
  {
    const Hdf5Shape& shape = this->shapeOf(dataset);
    if (!shape.type || shape.extents.size() > 2 ||
        (components > 0 && shape.components() != components))
    {
      this->File.fail("the dataset " + inQuotes(dataset) + " should have rows of " +
                      std::to_string(components) + " numbers");
    }
    std::unique_ptr<VtkArrayOpener>& opener = this->Openers[dataset];
    if (!opener)
    {
      opener = std::make_unique<DatasetOpener>(this->File, dataset);
    }
    VtkArray array;
    array.name = dataset.substr(dataset.rfind('/') + 1);
    array.type = *shape.type;
    array.columnType = *shape.type;
    array.components = static_cast<int>(shape.components());
    array.encoding = VtkEncoding::Raw;
    array.byteOrder = std::endian::native;
    array.opener = opener.get();
    return array;
  }

  /** The rows [first, first + count) of an array, which the dataset must have. */
  VtkArray rowsOf(
    VtkArray array, const std::string& dataset, std::int64_t first, std::int64_t count)
  {
    const std::int64_t rows = this->shapeOf(dataset).rows();
    if (first > rows - count)
    {
      this->File.fail("the dataset " + inQuotes(dataset) + " has " + std::to_string(rows) +
                      " rows, " + std::to_string(first + count) + " are needed");
    }
    array.begin = static_cast<std::size_t>(first * array.components);
    array.values = count * array.components;
    return array;
  }

  void addLists(std::initializer_list<std::pair<const char*, int>> kinds)
  {
    std::size_t kind = 0;
    for (const auto& [group, type] : kinds)
    {
      Cells cells{ group, type, {}, {} };
      cells.group += cells.group.empty() ? "" : "/";
      cells.cells = this->counts(cells.group + "NumberOfCells");
      cells.points = this->counts(cells.group + "NumberOfConnectivityIds");
      cells.firstCell = this->Step.number("CellOffsets", 0, kind, kinds.size());
      cells.firstPoint = this->Step.number("ConnectivityIdOffsets", 0, kind, kinds.size());
      cells.firstEnd = this->partsBefore(cells);
      ++kind;
      this->Lists.push_back(std::move(cells));
    }
  }

  /** The partition whose cells of this kind begin where the time step says: its own first one, or
   * where only the points move, that of an earlier time step with the same cells. */
  std::int64_t partsBefore(const Cells& list)
  {
    const auto cells = this->File.integers(VtkHdfRoot + list.group + "NumberOfCells");
    const auto points = this->File.integers(VtkHdfRoot + list.group + "NumberOfConnectivityIds");
    const auto isAt = [](const std::vector<std::int64_t>& own, const auto& all, std::int64_t part)
    { return std::equal(own.begin(), own.end(), all.begin() + part); };
    std::int64_t found = -1, sum = 0;
    for (std::int64_t part = 0; part <= this->FirstPart && sum <= list.firstCell; ++part)
    {
      const bool same = isAt(list.cells, cells, part) && isAt(list.points, points, part);
      if (sum == list.firstCell && (part == this->FirstPart || (found < 0 && same)))
      {
        found = part;
      }
      const std::int64_t count = cells[static_cast<std::size_t>(part)];
      sum += count >= 0 && count <= VtkHdfMostRows ? count : VtkHdfMostRows + 1;
    }
    return found < 0 ? this->FirstPart : found;
  }

  void readFieldNames()
  {
    const std::string group = VtkHdfRoot + std::string("FieldData");
    if (this->File.exists(group))
    {
      for (const std::string& name : this->File.datasets(group))
      {
        addFieldName(this->Layout.fields, name);
      }
    }
  }

  void readAttributes(const std::string& group, std::vector<Attribute>& attributes)
  {
    if (!this->File.exists(VtkHdfRoot + group))
    {
      return;
    }
    for (const std::string& name : this->File.datasets(VtkHdfRoot + group))
    {
      const std::string dataset = VtkHdfRoot + group + '/' + name;
      const Hdf5Shape& shape = this->shapeOf(dataset);
      if (!shape.type || shape.extents.empty() || shape.extents.size() > 2 ||
          shape.components() > MaxComponents)
      {
        if (this->Layout.otherArrays.size() < MaxOtherArrays)
        {
          this->Layout.otherArrays.insert(name);
        }
        continue;
      }
      Attribute attribute;
      attribute.array = this->arrayOf(dataset, 0);
      attribute.first = this->Step.number(group + "Offsets/" + name, -1);
      attributes.push_back(std::move(attribute));
    }
  }

  /** The arrays of a piece; `first`: index of its first row in the time step, which begins at
   * `stepFirst` unless the file specifies another offset for the array. */
  std::vector<VtkArray> attributesOf(const std::vector<Attribute>& attributes,
    const std::string& group, std::int64_t stepFirst, std::int64_t first, std::int64_t count)
  {
    std::vector<VtkArray> arrays;
    for (const Attribute& attribute : attributes)
    {
      const std::string dataset = VtkHdfRoot + group + '/' + attribute.array.name;
      arrays.push_back(this->rowsOf(attribute.array, dataset,
        (attribute.first >= 0 ? attribute.first : stepFirst) + first, count));
    }
    return arrays;
  }

  VtkArray dataset(
    const std::string& name, std::int64_t components, std::int64_t first, std::int64_t count)
  {
    const std::string path = VtkHdfRoot + name;
    const VtkArray array = this->arrayOf(path, components);
    return this->rowsOf(array, path, first, count);
  }

  /** The cells of a kind in a partition, which begins at the position in the list. */
  VtkCellList listOf(const Cells& list, std::size_t part)
  {
    VtkCellList cells;
    cells.cells = list.cells[part];
    cells.type = list.type;
    if (cells.cells > 0)
    {
      // A partition stores a 0 before the ends of its cells.
      const std::int64_t firstOffset =
        list.firstCell + list.firstEnd + static_cast<std::int64_t>(part);
      cells.points =
        this->dataset(list.group + "Connectivity", 1, list.firstPoint, list.points[part]);
      cells.offsets = this->dataset(list.group + "Offsets", 1, firstOffset, cells.cells + 1);
      if (list.type == 0)
      {
        cells.types = this->dataset("Types", 1, list.firstCell, cells.cells);
      }
    }
    return cells;
  }

  /** A partition, whose points and cells begin at these offsets from the first ones of the time
   * step. */
  VtkPiece pieceOf(std::size_t part, std::int64_t firstPoint, std::int64_t firstCell)
  {
    VtkPiece piece;
    piece.points = this->Points[part];
    if (piece.points > 0)
    {
      piece.positions = this->dataset("Points", 3, this->FirstPoint + firstPoint, piece.points);
    }
    for (const Cells& list : this->Lists)
    {
      piece.lists.push_back(this->listOf(list, part));
      piece.cells += piece.lists.back().cells;
    }
    piece.pointArrays = this->attributesOf(
      this->PointArrays, "PointData", this->FirstPoint, firstPoint, piece.points);
    piece.cellArrays =
      this->attributesOf(this->CellArrays, "CellData", this->FirstCell, firstCell, piece.cells);
    piece.pointNormals = this->PointNormals;
    piece.cellNormals = this->CellNormals;
    piece.globalIds = this->GlobalIds;
    return piece;
  }

  void addPieces()
  {
    this->PointNormals = this->File.text(VtkHdfRoot + "PointData", "Normals").value_or("");
    this->CellNormals = this->File.text(VtkHdfRoot + "CellData", "Normals").value_or("");
    this->GlobalIds = this->globalIds();
    for (const Cells& list : this->Lists)
    {
      this->FirstCell += list.firstCell;
    }
    std::int64_t firstPoint = 0, firstCell = 0;
    for (std::size_t part = 0; part < this->Points.size(); ++part)
    {
      if (!this->Partition || static_cast<std::int64_t>(part) == *this->Partition)
      {
        this->Layout.pieces.push_back(this->pieceOf(part, firstPoint, firstCell));
      }
      firstPoint += this->Points[part];
      for (Cells& list : this->Lists)
      {
        firstCell += list.cells[part];
        list.firstCell += list.cells[part];
        list.firstPoint += list.points[part];
      }
    }
    for (auto& [name, opener] : this->Openers)
    {
      this->Layout.openers.push_back(std::move(opener));
    }
  }

  /** The array that the file declares as the global numbers of the points, or one of that name. */
  std::string globalIds() const
  {
    const std::string said = this->File.text(VtkHdfRoot + "PointData", "GlobalIds").value_or("");
    if (!said.empty())
    {
      return said;
    }
    for (const char* name : { "GlobalIds", "GlobalPointIds" })
    {
      if (this->File.exists(VtkHdfRoot + "PointData/" + name))
      {
        return name;
      }
    }
    return {};
  }

  static constexpr std::int64_t MaxComponents = 4096;

  const Hdf5File& File;
  std::optional<std::int64_t> Partition;
  std::int64_t MaxBytes;
  VtkHdfStep Step;
  VtkHdfLayout Layout;
  std::vector<std::int64_t> Points;                                     ///< of each partition
  std::int64_t FirstPart = 0, Parts = 0, FirstPoint = 0, FirstCell = 0; ///< of the time step
  std::vector<Cells> Lists;
  std::vector<Attribute> PointArrays, CellArrays;
  std::string PointNormals, CellNormals, GlobalIds; ///< names of arrays
  std::map<std::string, std::unique_ptr<VtkArrayOpener>> Openers;
  std::map<std::string, Hdf5Shape> Shapes;
};

const std::string StepsGroup = VtkHdfRoot + "Steps";

class DatasetBytes : public ByteSource
{
public:
  DatasetBytes(const Hdf5File& hdf, const std::string& name, InputFile& file, const VtkArray& array,
    Pool& pool)
    : Numbers(hdf, name, array.type, static_cast<std::int64_t>(array.begin))
    , Chunk(pool, memoryOf(this->Numbers.chunkBytes()))
    , File(file)
  {
  }

  void read(std::span<std::byte> bytes) override
  {
    this->Numbers.read(bytes.data(), bytes.size());
    this->File.passed(bytes.size());
  }

private:
  /** The bytes of a chunk, twice while it is decompressed. */
  static std::int64_t memoryOf(std::uint64_t chunkBytes)
  {
    constexpr std::uint64_t Most = std::uint64_t(1) << 60;
    return static_cast<std::int64_t>(2 * std::min(chunkBytes, Most));
  }

  Hdf5Numbers Numbers; // reads no chunk before numbers are requested
  Reservation Chunk;
  InputFile& File;
};

} // namespace

VtkHdfLayout vtkHdfLayout(const Hdf5File& file, const MeshPart& part, std::int64_t maxBytes)
{
  return LayoutReader(file, part, maxBytes).read();
}

VtkHdfStep::VtkHdfStep(const Hdf5File& file, std::int64_t step)
  : File(file)
  , Step(step)
{
  const std::int64_t said =
    file.exists(StepsGroup) ? file.integer(StepsGroup, "NSteps").value_or(0) : 0;
  this->Steps = std::clamp<std::int64_t>(said, 0, VtkHdfMostRows);
  if (step < 0 || step >= std::max<std::int64_t>(this->Steps, 1))
  {
    file.fail(this->Steps > 0
                ? "there is no time step " + std::to_string(step) + ": the file has " +
                    std::to_string(this->Steps) + ", counted from 0 (option --time-step)"
                : "the file has no time steps (option --time-step)");
  }
}

std::int64_t VtkHdfStep::number(
  const std::string& name, std::int64_t otherwise, std::size_t column, std::size_t columns) const
{
  const std::string dataset = StepsGroup + '/' + name;
  if (this->Steps == 0 || !this->File.exists(dataset))
  {
    return otherwise;
  }
  const std::vector<std::int64_t> values = this->File.integers(dataset);
  const std::size_t at = static_cast<std::size_t>(this->Step) * columns + column;
  if (at >= values.size() || values[at] < 0 || values[at] > VtkHdfMostRows)
  {
    this->File.fail(
      "the dataset " + inQuotes(dataset) + " is too short, or its numbers cannot be right");
  }
  return values[at];
}

VtkHdfStep::Partitions VtkHdfStep::partitions(std::int64_t all) const
{
  Partitions own;
  own.first = this->number("PartOffsets", 0);
  own.count = this->number("NumberOfParts", this->nextPartition(own.first, all) - own.first);
  if (all == 0 || own.first > all || own.count > all - own.first)
  {
    this->File.fail("the file has " + std::to_string(all) + " partitions, fewer than it says");
  }
  return own;
}

/** The begin of the next time step's partitions after those of this one, or the end. */
std::int64_t VtkHdfStep::nextPartition(std::int64_t first, std::int64_t all) const
{
  const std::string offsets = StepsGroup + "/PartOffsets";
  std::int64_t next = all;
  if (this->Steps > 1 && this->File.exists(offsets))
  {
    for (const std::int64_t offset : this->File.integers(offsets))
    {
      next = offset > first ? std::min(next, offset) : next;
    }
  }
  return next;
}

DatasetOpener::DatasetOpener(const Hdf5File& file, std::string name)
  : Hdf(file)
  , Name(std::move(name))
{
}

std::unique_ptr<ByteSource> DatasetOpener::open(
  InputFile& file, const VtkArray& array, Pool& pool) const
{
  return std::make_unique<DatasetBytes>(this->Hdf, this->Name, file, array, pool);
}

} // namespace smg
