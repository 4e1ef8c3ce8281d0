// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/VtkHdf/Hdf5/DatasetOpener.h"

#include "IO/Files/InputFile.h"
#include "IO/Formats/Vtk/ByteSource.h"
#include "IO/Formats/VtkHdf/Hdf5/Hdf5File.h"
#include "Solver/Memory/Reservation.h"

#include <algorithm>
#include <utility>

namespace smg
{

namespace
{

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
