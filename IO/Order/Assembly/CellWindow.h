// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/PagedArray.h"
#include "IO/External/Relabelling.h"
#include "IO/Order/Assembly/StreamAssembly.h"
#include "IO/Order/Pages/OrderedVertices.h"
#include "Solver/Memory/Reservation.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace smg
{

/**
 * The vertices used by consecutive cells: they are read from the order as far as cells reach, get
 * their stream indices by first use, and are released after their last cell. Data that exceed the
 * memory are written to scratch files.
 */
template <class Real>
class CellWindow
{
public:
  CellWindow(const OrderedVertices& order, StreamLayout& layout, Workspace& workspace)
    : Memory(share(workspace))
    , Reserved(workspace.pool(), 2 * this->Memory)
    , Records(order.records)
    , Layout(layout)
    , Slots(workspace.folder(), this->Memory)
    , Reach(workspace.folder(), this->Memory)
  {
  }

  /** Returns the stream index of the vertex at a position, the next one if it has none, and fills
   * in its coordinates. */
  std::uint32_t use(std::uint32_t place, std::array<double, 3>& point)
  {
    while (place >= this->Loaded)
    {
      this->load();
    }
    Slot& slot = this->Slots.at(place);
    if (slot.index == NoIndex)
    {
      slot.index = static_cast<std::uint32_t>(this->Layout.vertexCount++);
      OrderedVertex<Real> vertex{ {}, slot.id, slot.reach };
      for (int axis = 0; axis < 3; ++axis)
      {
        vertex.position[axis] = slot.position[axis];
      }
      this->Layout.vertices.put(0, vertex);
      this->Reach.at(slot.index) = slot.reach;
    }
    point = { slot.position[0], slot.position[1], slot.position[2] };
    return slot.index;
  }

  /** Declares that no further cell has a largest position of `place` or less. */
  void pass(std::uint32_t place)
  {
    while (this->Finalized < this->Layout.vertexCount && this->Reach.get(this->Finalized) <= place)
    {
      ++this->Finalized;
    }
    this->Reach.discardBelow(this->Finalized);
    while (this->Passed < this->Loaded && this->Slots.get(this->Passed).reach <= place)
    {
      ++this->Passed;
    }
    this->Slots.discardBelow(this->Passed);
  }

  /** The number of vertices, by stream index, that no further cell uses. */
  std::int64_t finalized() const { return this->Finalized; }

private:
  struct Slot
  {
    Real position[3];
    std::uint32_t id;
    std::uint32_t index;
    std::uint32_t reach;
    std::uint32_t unused[sizeof(Real) == sizeof(double) ? 7 : 2]; ///< for a size of 2^n
  };

  static std::int64_t share(Workspace& workspace)
  {
    return std::min<std::int64_t>(workspace.available() / 4, std::int64_t(64) << 20);
  }

  void load()
  {
    OrderedVertex<Real> vertex{};
    this->Records.get(vertex);
    Slot& slot = this->Slots.at(this->Loaded++);
    std::copy_n(vertex.position, 3, slot.position);
    slot.id = vertex.id;
    slot.index = NoIndex;
    slot.reach = vertex.reach;
  }

  std::int64_t Memory;
  Reservation Reserved;
  BucketFile::Reader Records;
  StreamLayout& Layout;
  PagedArray<Slot> Slots;          ///< by place
  PagedArray<std::uint32_t> Reach; ///< by stream index
  std::int64_t Loaded = 0;
  std::int64_t Finalized = 0; ///< by stream index
  std::int64_t Passed = 0;    ///< by place
};

} // namespace smg
