// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/FileNames.h"
#include "IO/Formats/Vtk/VtkAttributes.h"
#include "IO/Formats/Vtk/VtkLayout.h"
#include "IO/Formats/Vtk/XmlTags.h"
#include "IO/Mesh/Columns.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace smg
{

namespace
{

/** How a file stores its arrays that are not text, as its root element declares. */
struct VtkXmlEncoding
{
  std::endian byteOrder = std::endian::little;
  int headerBytes = 4;
  VtkCompression compression = VtkCompression::None;
};

/** Throws Error if the compressor is not known. */
VtkXmlEncoding vtkXmlEncoding(const InputFile& file, const XmlTag& root)
{
  VtkXmlEncoding encoding;
  encoding.byteOrder =
    root.value("byte_order") == "BigEndian" ? std::endian::big : std::endian::little;
  encoding.headerBytes = root.value("header_type", "UInt32") == "UInt64" ? 8 : 4;
  const std::string compressor = root.value("compressor");
  encoding.compression = compressor.empty()                      ? VtkCompression::None
                         : compressor == "vtkZLibDataCompressor" ? VtkCompression::Zlib
                         : compressor == "vtkLZ4DataCompressor"  ? VtkCompression::Lz4
                                                                 : VtkCompression::Lzma;
  if (encoding.compression == VtkCompression::Lzma && compressor != "vtkLZMADataCompressor")
  {
    file.fail(root.begin, "the compressor " + inQuotes(compressor) + " is not known");
  }
  return encoding;
}

/** The value of an attribute as a count; 0 if it is missing. Throws Error if it is not a count. */
std::int64_t vtkXmlCount(const InputFile& file, const XmlTag& tag, const char* name)
{
  // No file has more points, cells or bytes.
  constexpr std::int64_t MaxXmlCount = std::int64_t(1) << 48;
  const std::string text = tag.value(name, "0");
  std::string_view digits = text;
  digits.remove_prefix(std::min(digits.find_first_not_of(" \t\r\n"), digits.size()));
  digits = digits.substr(0, digits.find_first_of(" \t\r\n"));
  std::int64_t value = -1;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || stop != digits.data() + digits.size() || value < 0 ||
      value > MaxXmlCount)
  {
    file.fail(tag.begin, inQuotes(text) + " cannot be the " + name + " of the tag here");
  }
  return value;
}

/**
 * The array of a tag <DataArray>; how many values it has is not known yet. One that is appended has
 * the encoding Raw, and its begin is an offset from the first byte of the appended data. Throws
 * Error.
 */
VtkArray vtkXmlArray(
  const InputFile& file, const XmlTag& tag, ScalarType type, const VtkXmlEncoding& encoding)
{
  VtkArray array;
  array.name = tag.value("Name");
  array.type = array.columnType = type;
  array.begin = tag.end;
  array.byteOrder = encoding.byteOrder;
  const std::int64_t components =
    tag.attribute("NumberOfComponents") ? vtkXmlCount(file, tag, "NumberOfComponents") : 1;
  if (components < 1 || components > std::numeric_limits<std::int16_t>::max())
  {
    file.fail(tag.begin, "an array cannot have " + std::to_string(components) + " components");
  }
  array.components = static_cast<int>(components);
  const std::string format = tag.value("format", "ascii");
  if (format != "ascii" && format != "binary" && format != "appended")
  {
    file.fail(tag.begin,
      "the array here has the format " + inQuotes(format) + ", not ascii, binary or appended");
  }
  if (format == "ascii")
  {
    return array;
  }
  array.headerBytes = encoding.headerBytes;
  array.compression = encoding.compression;
  array.encoding = VtkEncoding::Base64;
  if (format == "appended")
  {
    // The offset and the encoding of the appended data follow after all arrays.
    array.encoding = VtkEncoding::Raw;
    array.begin = static_cast<std::size_t>(vtkXmlCount(file, tag, "offset"));
  }
  return array;
}

/** Reads the tags of a file into the pieces of a layout. */
class XmlLayoutReader
{
public:
  XmlLayoutReader(InputFile& file, VtkLayout& layout, std::int64_t maxBytes)
    : File(file)
    , Tags(file)
    , Layout(layout)
    , MaxBytes(maxBytes)
    , FirstPiece(layout.pieces.size())
  {
  }

  void read()
  {
    this->readRoot();
    this->Layout.files.emplace_back(this->File);
    for (XmlTag tag; this->Tags.next(tag);)
    {
      if (tag.name == "AppendedData")
      {
        this->placeAppended(tag);
        break;
      }
      tag.closes ? this->close(tag) : this->open(tag);
    }
    if (this->Layout.pieces.size() > this->FirstPiece)
    {
      this->check();
    }
  }

private:
  void readRoot()
  {
    const XmlTag root = vtkXmlRoot(this->File, this->Tags);
    const std::string kind = root.value("type");
    this->IsGrid = kind == "UnstructuredGrid";
    if (!this->IsGrid && kind != "PolyData")
    {
      this->File.fail(root.begin, "the file is neither polygonal data nor an unstructured grid of "
                                  "VTK, which are the kinds that hold meshes");
    }
    this->Encoding = vtkXmlEncoding(this->File, root);
  }

  void close(const XmlTag& tag)
  {
    if (tag.name == this->Section)
    {
      this->Section.clear();
    }
  }

  void open(const XmlTag& tag)
  {
    static constexpr std::string_view Sections[] = { "Points", "PointData", "CellData", "Cells",
      "Verts", "Lines", "Polys", "Strips", "FieldData" };
    if (tag.name == "Piece")
    {
      this->openPiece(tag);
    }
    else if (std::ranges::find(Sections, tag.name) != std::end(Sections))
    {
      this->Section = tag.alone ? "" : tag.name;
      this->noteActive(tag);
    }
    else if (this->Section == "FieldData" && (tag.name == "DataArray" || tag.name == "Array"))
    {
      const std::string name = tag.value("Name");
      addFieldName(this->Layout.fields, name);
      // VTK stores the characters of texts like numbers.
      const std::string type = tag.value("type");
      if (name == MeshGroupsName && (type == "UInt8" || type == "String") &&
          (!tag.alone || tag.value("format") == "appended"))
      {
        this->Layout.groupsArray = vtkXmlArray(this->File, tag, ScalarType::UInt8, this->Encoding);
      }
    }
    else if (tag.name == "DataArray" && !this->Section.empty())
    {
      this->addArray(tag);
    }
    else if (tag.name == "Array" && this->isOfAttributes())
    {
      this->noteOther(tag);
    }
  }

  void openPiece(const XmlTag& tag)
  {
    VtkPiece piece;
    piece.file = this->Layout.files.size() - 1;
    piece.points = vtkXmlCount(this->File, tag, "NumberOfPoints");
    piece.globalIds = GlobalIdsName;
    using namespace VtkCellTypes;
    static constexpr std::pair<const char*, int> Counts[] = { { "NumberOfVerts", PolyVertex },
      { "NumberOfLines", PolyLine }, { "NumberOfPolys", Polygon },
      { "NumberOfStrips", VtkCellTypes::TriangleStrip } };
    for (const auto& [name, type] : Counts)
    {
      VtkCellList& list = piece.lists.emplace_back();
      list.cells = vtkXmlCount(this->File, tag, this->IsGrid ? "NumberOfCells" : name);
      list.type = type;
      piece.cells += list.cells;
      if (this->IsGrid)
      {
        break;
      }
    }
    this->account(tag, sizeof(piece) + piece.lists.size() * sizeof(VtkCellList));
    this->Layout.pieces.push_back(std::move(piece));
    this->PointNames = {};
    this->CellNames = {};
    this->Section.clear();
  }

  /** The names of arrays that mean more than others. */
  void noteActive(const XmlTag& tag)
  {
    if (this->Layout.pieces.size() == this->FirstPiece)
    {
      return;
    }
    VtkPiece& piece = this->Layout.pieces.back();
    if (tag.name == "PointData")
    {
      piece.pointNormals = tag.value("Normals");
      piece.pointTexture = tag.value("TCoords");
      piece.globalIds = tag.value("GlobalIds", GlobalIdsName);
    }
    else if (tag.name == "CellData")
    {
      piece.cellNormals = tag.value("Normals");
    }
  }

  bool isOfAttributes() const
  {
    return this->Section == "PointData" || this->Section == "CellData";
  }

  /** An array that is not read. */
  void noteOther(const XmlTag& tag)
  {
    if (this->Layout.otherArrays.size() < MaxOtherArrays)
    {
      this->Layout.otherArrays.insert(tag.value("Name"));
    }
  }

  /** Stores an array according to its section. */
  void addArray(const XmlTag& tag)
  {
    const std::string type = tag.value("type");
    const auto* const known = std::ranges::find(VtkXmlTypeNames, type);
    const bool attribute = this->isOfAttributes();
    if (known == std::end(VtkXmlTypeNames) && attribute && (type == "String" || type == "Bit"))
    {
      this->noteOther(tag);
      return;
    }
    if (known == std::end(VtkXmlTypeNames) || this->Layout.pieces.size() == this->FirstPiece)
    {
      this->File.fail(tag.begin, "the array here has the type " + inQuotes(type) +
                                   ", or stands outside a piece, and cannot be read");
    }
    VtkPiece& piece = this->Layout.pieces.back();
    VtkArray array = vtkXmlArray(this->File, tag,
      static_cast<ScalarType>(known - std::begin(VtkXmlTypeNames)), this->Encoding);
    if (attribute)
    {
      const bool ofPoints = this->Section == "PointData";
      array.values = this->product(tag, ofPoints ? piece.points : piece.cells, array.components);
      auto& arrays = ofPoints ? piece.pointArrays : piece.cellArrays;
      // Of the same array at several time steps the first one is taken.
      VtkArrayNames& names = ofPoints ? this->PointNames : this->CellNames;
      const bool isLater = tag.attribute("TimeStep") && names.contains(array.name);
      if (!array.name.empty() && !isLater)
      {
        names.nameApart(array, this->Layout.repeatedArrays);
        this->account(tag, sizeof(array) + array.name.size());
        arrays.push_back(std::move(array));
      }
    }
    else if (this->Section == "Points" && !piece.positions)
    {
      array.components = 3;
      array.values = this->product(tag, piece.points, 3);
      piece.positions = std::move(array);
    }
    else if (this->Section != "Points")
    {
      this->addCellArray(piece, std::move(array));
    }
  }

  void addCellArray(VtkPiece& piece, VtkArray array)
  {
    static constexpr std::string_view Lists[] = { "Verts", "Lines", "Polys", "Strips" };
    const auto* const place = std::ranges::find(Lists, this->Section);
    const bool isList = this->IsGrid ? this->Section == "Cells" : place != std::end(Lists);
    if (!isList)
    {
      return;
    }
    VtkCellList& list =
      piece.lists[this->IsGrid ? 0 : static_cast<std::size_t>(place - std::begin(Lists))];
    array.components = 1;
    const bool areCorners = array.name == "connectivity";
    if (!areCorners && array.name != "offsets" && array.name != "types")
    {
      return;
    }
    std::optional<VtkArray>& own = areCorners              ? list.points
                                   : array.name == "types" ? list.types
                                                           : list.offsets;
    // As of other arrays, of several time steps the first one is taken.
    if (own)
    {
      return;
    }
    if (!areCorners)
    {
      array.values = list.cells;
    }
    own = std::move(array);
  }

  void account(const XmlTag& tag, std::size_t bytes)
  {
    this->Layout.bytes += static_cast<std::int64_t>(bytes);
    if (this->Layout.bytes > this->MaxBytes)
    {
      this->File.fail(tag.begin, "there are more pieces and arrays than fit into the memory: raise "
                                 "its limit (option --memory), or join pieces first");
    }
  }

  /** Resolves the offsets of appended arrays. */
  void placeAppended(const XmlTag& tag)
  {
    const bool base64 = tag.value("encoding", "base64") != "raw";
    std::size_t begin = tag.end;
    for (std::string_view text = this->File.at(begin); !text.empty() && text.front() != '_';
         text = this->File.at(++begin))
    {
    }
    ++begin;
    const auto place = [&](VtkArray& array)
    {
      if (array.encoding != VtkEncoding::Raw)
      {
        return;
      }
      if (begin >= this->File.size() || array.begin > this->File.size() - begin)
      {
        this->File.fail(tag.begin, "the array " + inQuotes(array.name) +
                                     " begins behind the end of the file: it is truncated or an "
                                     "offset is wrong");
      }
      array.begin += begin;
      array.encoding = base64 ? VtkEncoding::Base64 : VtkEncoding::Raw;
    };
    this->forEachArray(place);
    if (this->Layout.groupsArray)
    {
      place(*this->Layout.groupsArray);
    }
    this->HasAppended = true;
  }

  void forEachArray(const auto& visit)
  {
    for (std::size_t i = this->FirstPiece; i < this->Layout.pieces.size(); ++i)
    {
      smg::forEachArray(this->Layout.pieces[i], visit);
    }
  }

  /** Whether what the pieces need is there. */
  void check()
  {
    if (this->Layout.pieces.front().lists.size() != (this->IsGrid ? 1u : 4u))
    {
      this->File.fail(0, "the pieces are not all of the same kind of data");
    }
    for (std::size_t i = this->FirstPiece; i < this->Layout.pieces.size(); ++i)
    {
      const VtkPiece& piece = this->Layout.pieces[i];
      if (piece.points > 0 && !piece.positions)
      {
        this->File.fail(0, "a piece has no array of its points");
      }
      for (const VtkCellList& list : piece.lists)
      {
        if (list.cells > 0 && (!list.points || !list.offsets || (this->IsGrid && !list.types)))
        {
          this->File.fail(0, "a piece lacks an array of its cells: connectivity, offsets or types");
        }
      }
    }
    this->forEachArray(
      [this](const VtkArray& array)
      {
        if (array.encoding == VtkEncoding::Raw && !this->HasAppended)
        {
          this->File.fail(0, "the data of the array " + inQuotes(array.name) +
                               " should be appended, but the file has no <AppendedData>");
        }
      });
  }

  std::int64_t product(const XmlTag& tag, std::int64_t count, std::int64_t components)
  {
    std::int64_t values = 0;
    // The size in bytes must not overflow either.
    if (__builtin_mul_overflow(count, components * 8, &values))
    {
      this->File.fail(tag.begin, "the array here cannot have " + std::to_string(count) + " tuples");
    }
    return values / 8;
  }

  InputFile& File;
  XmlTags Tags;
  VtkLayout& Layout;
  const std::int64_t MaxBytes;
  const std::size_t FirstPiece;
  bool IsGrid = false, HasAppended = false;
  VtkXmlEncoding Encoding;
  std::string Section;                 ///< where arrays belong to now
  VtkArrayNames PointNames, CellNames; ///< of the current piece
};

/** A file that is cut off within its last tags may look whole otherwise. */
void requireEnd(InputFile& file)
{
  constexpr std::size_t Most = 4096;
  const std::size_t begin = file.size() - std::min(file.size(), Most);
  if (file.at(begin, Most).find("</VTKFile") == std::string_view::npos)
  {
    file.fail(file.size(), "the file does not end with </VTKFile>: it is truncated");
  }
}

} // namespace

XmlTag vtkXmlRoot(InputFile& file, XmlTags& tags)
{
  requireEnd(file);
  XmlTag root;
  if (!tags.next(root) || root.name != "VTKFile")
  {
    file.fail(0, "the file does not begin with <VTKFile>");
  }
  return root;
}

void addVtkXmlLayout(InputFile& file, VtkLayout& layout, std::int64_t maxBytes)
{
  XmlLayoutReader(file, layout, maxBytes).read();
}

} // namespace smg
