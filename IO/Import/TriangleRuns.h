// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMeshBuilder.h"

#include <cstdint>

namespace smg
{

/** Converts the corners of a polygon to triangles one by one, without storing the corners. */
class TriangleFan
{
public:
  explicit TriangleFan(RawMeshBuilder& builder)
    : Builder(builder)
  {
  }

  void corner(std::int64_t corner)
  {
    if (this->Count >= 2)
    {
      this->Builder.triangleOfElement(this->First, this->Last, corner);
    }
    this->First = this->Count == 0 ? corner : this->First;
    this->Last = corner;
    ++this->Count;
  }
  /** Ends the polygon; the next corner begins another one. */
  void end()
  {
    this->Builder.endTriangles();
    this->Count = 0;
  }
  std::int64_t corners() const { return this->Count; }

private:
  RawMeshBuilder& Builder;
  std::int64_t First = 0, Last = 0;
  std::int64_t Count = 0;
};

/** The same for triangle strips. An element may have several: -1 begins another one. */
class TriangleStrip
{
public:
  explicit TriangleStrip(RawMeshBuilder& builder)
    : Builder(builder)
  {
  }

  void corner(std::int64_t corner)
  {
    if (corner < 0)
    {
      this->Count = 0;
      return;
    }
    if (this->Count >= 2)
    {
      // Every other triangle of a strip is reversed, so that all have the same orientation.
      const bool odd = this->Count % 2 != 0;
      this->Builder.triangleOfElement(
        odd ? this->Last : this->Before, odd ? this->Before : this->Last, corner);
    }
    this->Before = this->Last;
    this->Last = corner;
    ++this->Count;
  }
  void end()
  {
    this->Builder.endTriangles();
    this->Count = 0;
  }

private:
  RawMeshBuilder& Builder;
  std::int64_t Before = 0, Last = 0;
  std::int64_t Count = 0;
};

} // namespace smg
