// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/ImportColumn.h"

#include <cstdint>
#include <span>

namespace smg
{

/** A column of labels, one integer each, which is omitted if all have the default value. */
class LabelColumn
{
public:
  LabelColumn(
    RawMeshBuilder& builder, ImportColumn::Of of, const char* name, std::int64_t usual = 0)
    : Column(builder, of, { name, ScalarType::Int64, 1 })
    , Usual(usual)
  {
  }

  void add(std::int64_t label)
  {
    this->Column.append(std::as_bytes(std::span(&label, 1)));
    this->Used = this->Used || label != this->Usual;
  }
  /** To be called after the last one. */
  void finish()
  {
    if (!this->Used)
    {
      this->Column.drop();
    }
  }

private:
  ImportColumn Column;
  std::int64_t Usual;
  bool Used = false; ///< whether any differs from the default
};

} // namespace smg
