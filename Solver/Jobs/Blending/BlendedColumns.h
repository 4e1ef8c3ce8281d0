// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/MeshColumns.h"
#include "smg/Blend.h"

#include <span>
#include <vector>

namespace smg
{

/** The vertex columns of a mesh that are blended. */
class BlendedColumns
{
public:
  /** Checks the names. Throws Error. */
  BlendedColumns(const BlendDescription& description, const StreamInfo& mesh, MeshColumns& columns);

  const std::vector<ColumnSpec>& specs() const { return this->Specs; }
  /** The components of all columns. */
  int components() const { return this->Components; }

  /** Reads the values of the vertices of a block. Throws Error if one is not finite. */
  void read(const MeshBlock& block, std::span<double> values) const;

private:
  void add(const std::string& name, const BlendDescription& description, const StreamInfo& mesh);

  MeshColumns& Columns;
  std::vector<NamedColumn> Named;
  std::vector<ColumnSpec> Specs;
  int Components = 0;
};

} // namespace smg
