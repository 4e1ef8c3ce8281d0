// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/VtkFallback.h"

#include "IO/Formats/Vtk/ByteSource.h"
#include "IO/Formats/Vtk/VtkFiles.h"
#include "Solver/Core/Error.h"

#include <cstdint>
#include <string>

namespace smg
{

namespace
{

/** Bytes of an array in memory, by the header of its data. */
std::uint64_t bytesOf(InputFile& file, const VtkArray& array)
{
  if (array.headerBytes == 0)
  {
    const auto values = static_cast<std::uint64_t>(array.values < 0 ? 0 : array.values);
    return values * sizeOf(array.type);
  }
  const auto header = bytesAt(file, array.encoding, array.begin);
  const auto integer = [&] { return header->integer(array.headerBytes, array.bigEndian); };
  const std::uint64_t blocks = integer();
  if (array.compression == VtkCompression::None || blocks == 0)
  {
    return blocks;
  }
  std::uint64_t bytes = 0;
  if (__builtin_mul_overflow(blocks, integer(), &bytes))
  {
    file.fail(array.begin, "the header of the compressed array here cannot be right");
  }
  return bytes;
}

/** Bytes that VTK's readers need for the mesh: the arrays, and once more while they are read. */
std::int64_t neededBytes(InputFile& file, const VtkLayout& layout)
{
  VtkFiles files(file, layout);
  std::int64_t sum = 0;
  for (const VtkPiece& piece : layout.pieces)
  {
    InputFile& own = files.open(piece.file, VtkFiles::Main);
    forEachArray(piece,
      [&](const VtkArray& array)
      {
        if (__builtin_add_overflow(sum, bytesOf(own, array), &sum))
        {
          own.fail(array.begin, "the size of the array here cannot be right: the file is damaged");
        }
      });
  }
  std::int64_t needed = 0;
  return __builtin_mul_overflow(sum, 2, &needed) ? sum : needed;
}

std::string mebibytes(std::int64_t bytes)
{
  return std::to_string((bytes + (1 << 20) - 1) >> 20) + " MiB";
}

} // namespace

bool needsVtk(const VtkLayout& layout)
{
  bool needed = false;
  for (const VtkPiece& piece : layout.pieces)
  {
    forEachArray(piece,
      [&needed](const VtkArray& array) { needed |= array.compression == VtkCompression::Other; });
  }
  return needed;
}

void importWithVtk(InputFile& file, VtkXmlKind kind, const VtkLayout& layout,
  RawMeshBuilder& builder, const ProgressFunction& progress)
{
  const std::string advice = ": save it with appended raw data without compression, which are read "
                             "in any size.";
  const VtkImporter importer = vtkImporter();
  if (!importer)
  {
    throw Error(file.name() +
                ": the file is compressed in a way that only VTK reads, which this "
                "program was built without" +
                advice);
  }
  const std::int64_t needed = neededBytes(file, layout);
  const std::int64_t available = builder.workspace().available();
  if (needed > available)
  {
    throw Error(file.name() + ": the file is compressed in a way that only VTK reads, in memory: " +
                mebibytes(needed) + " are needed, " + mebibytes(available) + " are allowed" +
                advice);
  }
  importer(file.path(), kind, builder, progress);
}

} // namespace smg
