// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"

#include <hdf5.h>

namespace smg
{

/** A handle of the library, closed by the destructor. */
template <herr_t (*Close)(hid_t)>
class Hdf5Handle
{
public:
  explicit Hdf5Handle(hid_t id)
    : Id(id)
  {
  }
  ~Hdf5Handle()
  {
    if (this->Id >= 0)
    {
      Close(this->Id);
    }
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;

  hid_t id() const { return this->Id; }
  bool valid() const { return this->Id >= 0; }

private:
  hid_t Id;
};

/** Prevents the library from printing its errors during its lifetime. */
class Hdf5Silence
{
public:
  Hdf5Silence()
  {
    H5Eget_auto2(H5E_DEFAULT, &this->Function, &this->Data);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Hdf5Silence() { H5Eset_auto2(H5E_DEFAULT, this->Function, this->Data); }
  Hdf5Silence(const Hdf5Silence&) = delete;
  Hdf5Silence& operator=(const Hdf5Silence&) = delete;

private:
  H5E_auto2_t Function = nullptr;
  void* Data = nullptr;
};

inline hid_t nativeType(ScalarType type)
{
  switch (type)
  {
    case ScalarType::Int8:
      return H5T_NATIVE_INT8;
    case ScalarType::UInt8:
      return H5T_NATIVE_UINT8;
    case ScalarType::Int16:
      return H5T_NATIVE_INT16;
    case ScalarType::UInt16:
      return H5T_NATIVE_UINT16;
    case ScalarType::Int32:
      return H5T_NATIVE_INT32;
    case ScalarType::UInt32:
      return H5T_NATIVE_UINT32;
    case ScalarType::Int64:
      return H5T_NATIVE_INT64;
    case ScalarType::UInt64:
      return H5T_NATIVE_UINT64;
    case ScalarType::Float32:
      return H5T_NATIVE_FLOAT;
    case ScalarType::Float64:
      return H5T_NATIVE_DOUBLE;
  }
  return -1;
}

} // namespace smg
