// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/VtkHdf/Hdf5/Hdf5Output.h"

#include "IO/Formats/VtkHdf/Hdf5/Hdf5File.h"
#include "smg/Error.h"

#include <algorithm>
#include <array>

namespace smg
{

Hdf5Output::Hdf5Output(const std::filesystem::path& path)
  : Path(path)
  , Part(FileDescriptor::createBeside(path))
{
  const Hdf5Silence silence;
  this->File = H5Fcreate(this->Part.path().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  if (this->File < 0)
  {
    this->fail();
  }
}

Hdf5Output::~Hdf5Output()
{
  this->close();
}

void Hdf5Output::fail() const
{
  throw Error(this->Path.string() + ": the file cannot be written: is there room for it?");
}

bool Hdf5Output::close() noexcept
{
  const Hdf5Silence silence;
  bool closed = true;
  for (auto& [name, set] : this->Sets)
  {
    closed = H5Dclose(set.handle) >= 0 && closed;
  }
  this->Sets.clear();
  if (this->File >= 0)
  {
    closed = H5Fclose(this->File) >= 0 && closed;
    this->File = -1;
  }
  return closed;
}

void Hdf5Output::addGroup(const std::string& name)
{
  const Hdf5Silence silence;
  const Hdf5Handle<H5Gclose> group(
    H5Gcreate2(this->File, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  if (!group.valid())
  {
    this->fail();
  }
}

void Hdf5Output::addText(const std::string& object, const char* attribute, const std::string& text)
{
  const Hdf5Silence silence;
  // Attributes have at most 64 KiB, but for texts of variable length, which are elsewhere.
  constexpr std::size_t MostFixed = 32768;
  const bool isLong = text.size() > MostFixed;
  const char* const start = text.c_str();
  const Hdf5Handle<H5Tclose> type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type.id(), isLong ? H5T_VARIABLE : text.size());
  H5Tset_strpad(type.id(), isLong ? H5T_STR_NULLTERM : H5T_STR_NULLPAD);
  const Hdf5Handle<H5Sclose> space(H5Screate(H5S_SCALAR));
  const Hdf5Handle<H5Aclose> handle(H5Acreate_by_name(this->File, object.c_str(), attribute,
    type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  if (!handle.valid() ||
      H5Awrite(handle.id(), type.id(),
        isLong ? static_cast<const void*>(&start) : static_cast<const void*>(start)) < 0)
  {
    this->fail();
  }
}

void Hdf5Output::addIntegers(
  const std::string& object, const char* attribute, std::span<const std::int64_t> values)
{
  const Hdf5Silence silence;
  const hsize_t count = values.size();
  const Hdf5Handle<H5Sclose> space(H5Screate_simple(1, &count, nullptr));
  const Hdf5Handle<H5Aclose> handle(H5Acreate_by_name(this->File, object.c_str(), attribute,
    H5T_STD_I64LE, space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  if (!handle.valid() || H5Awrite(handle.id(), H5T_NATIVE_INT64, values.data()) < 0)
  {
    this->fail();
  }
}

void Hdf5Output::addDataset(
  const std::string& name, ScalarType type, int components, std::int64_t rows)
{
  const Hdf5Silence silence;
  constexpr hsize_t ChunkBytes = hsize_t(1) << 18;
  constexpr std::int64_t MinRows = 64;
  const auto width = static_cast<hsize_t>(std::max(1, components));
  const int rank = components > 0 ? 2 : 1;
  const std::array<hsize_t, 2> none{ 0, width };
  const std::array<hsize_t, 2> most{ H5S_UNLIMITED, width };
  const auto expected = static_cast<hsize_t>(std::max(rows, MinRows));
  const std::array<hsize_t, 2> chunk{ std::clamp<hsize_t>(expected, 1,
                                        std::max<hsize_t>(1, ChunkBytes / (width * sizeOf(type)))),
    width };
  const Hdf5Handle<H5Sclose> space(H5Screate_simple(rank, none.data(), most.data()));
  const Hdf5Handle<H5Pclose> properties(H5Pcreate(H5P_DATASET_CREATE));
  H5Pset_obj_track_times(properties.id(), false); // the same mesh gives the same bytes
  H5Pset_chunk(properties.id(), rank, chunk.data());
  const hid_t handle = H5Dcreate2(this->File, name.c_str(), nativeType(type), space.id(),
    H5P_DEFAULT, properties.id(), H5P_DEFAULT);
  if (handle < 0)
  {
    this->fail();
  }
  this->Sets[name] = { handle, type, components, 0 };
}

void Hdf5Output::append(const std::string& dataset, std::span<const std::byte> rows)
{
  const Hdf5Silence silence;
  Dataset& set = this->Sets.at(dataset);
  const auto width = static_cast<hsize_t>(std::max(1, set.components));
  const std::array<hsize_t, 2> count{ rows.size() / (width * sizeOf(set.type)), width };
  if (count[0] == 0)
  {
    return;
  }
  const std::array<hsize_t, 2> begin{ set.rows, 0 };
  set.rows += count[0];
  const std::array<hsize_t, 2> extents{ set.rows, width };
  const int rank = set.components > 0 ? 2 : 1;
  if (H5Dset_extent(set.handle, extents.data()) < 0)
  {
    this->fail();
  }
  const Hdf5Handle<H5Sclose> space(H5Dget_space(set.handle));
  H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, begin.data(), nullptr, count.data(), nullptr);
  const Hdf5Handle<H5Sclose> memory(H5Screate_simple(rank, count.data(), nullptr));
  if (H5Dwrite(
        set.handle, nativeType(set.type), memory.id(), space.id(), H5P_DEFAULT, rows.data()) < 0)
  {
    this->fail();
  }
}

void Hdf5Output::finish()
{
  const Hdf5Silence silence;
  const bool flushed = H5Fflush(this->File, H5F_SCOPE_LOCAL) >= 0;
  if (!this->close() || !flushed)
  {
    this->fail();
  }
  this->Part.renameTo(this->Path);
}

} // namespace smg
