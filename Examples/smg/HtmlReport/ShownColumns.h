// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace html
{

/** The range of finite numbers. */
struct ValueRange
{
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();

  bool isEmpty() const { return this->least > this->most; }
};

/**
 * A mesh stream with only those columns of its vertices that a picture of it shows: results first,
 * then others, up to eight numbers a vertex. Numbers of vertices and normals are left out. While it
 * is read, the ranges of all numbers are found.
 */
class ShownColumns : public smg::MeshSource
{
public:
  /** `mesh` must outlive this; `first` are the names of the results. */
  ShownColumns(smg::MeshSource& mesh, const std::vector<std::string>& first);

  const smg::StreamInfo& info() const override { return this->Info; }
  bool next(smg::MeshBlock& block) override;

  /** Of a component of a column, in the order of info(); of all vertices when the stream has ended.
   */
  const ValueRange& range(std::size_t column, int component) const
  {
    return this->Ranges[column][static_cast<std::size_t>(component)];
  }

  /** Whether a column is drawn as the colours that it holds. */
  static bool isColour(const smg::ColumnSpec& column);

private:
  smg::MeshSource& Mesh;
  smg::StreamInfo Info;
  std::vector<std::size_t> Places; ///< of the columns shown, among those of the mesh
  std::vector<std::vector<ValueRange>> Ranges;
  smg::MeshBlock Whole; ///< with all columns
};

} // namespace html
