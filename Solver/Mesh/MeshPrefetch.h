// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

#include <cstdint>
#include <exception>
#include <utility>

namespace smg
{

/** Reads a mesh stream one block ahead: the next block is read on another thread while the current
 * one is used, if the mesh may be read on any thread. The two blocks, whose size the mesh source
 * chooses, are not accounted for. */
class MeshPrefetch
{
public:
  /** `wanted`: whether there is another thread to read on. */
  MeshPrefetch(MeshSource& mesh, bool wanted)
    : Mesh(mesh)
    , Ahead(wanted && mesh.readsOnAnyThread())
  {
  }

  /** Makes the block that was read ahead the current one. Not while read() or block() runs. */
  void advance()
  {
    if (this->Ahead)
    {
      this->read();
      std::swap(this->Current, this->Following);
      this->Following.read = false;
    }
  }

  /** Reads the block after the current one, if it has not been read: on any thread. */
  void read()
  {
    if (!this->Ahead || this->Following.read || this->Ended)
    {
      return;
    }
    this->Following.read = true;
    try
    {
      this->Following.ended = !this->Mesh.next(this->Following.block);
    }
    catch (...)
    {
      // block() rethrows it when the blocks before it have been processed, as without reading
      // ahead.
      this->Following.failure = std::current_exception();
    }
    this->Ended = this->Following.ended || this->Following.failure;
  }

  const StreamInfo& info() const { return this->Mesh.info(); }
  bool isAhead() const { return this->Ahead; }
  /** The number of vertices of the current block if it was read ahead; 0 at the end of the
   * stream. */
  std::int64_t vertices() const
  {
    const bool is = this->Current.read && !this->Current.ended && !this->Current.failure;
    return is ? this->Current.block.vertices() : 0;
  }

  /** The current block, or null at the end of the stream. To be called once after each advance(),
   * on the thread of the caller. Rethrows what reading the block has thrown. */
  const MeshBlock* block()
  {
    if (!this->Ahead)
    {
      return this->Mesh.next(this->Current.block) ? &this->Current.block : nullptr;
    }
    if (this->Current.failure)
    {
      std::rethrow_exception(this->Current.failure);
    }
    return this->Current.ended ? nullptr : &this->Current.block;
  }

private:
  struct Read
  {
    MeshBlock block;
    bool read = false;
    bool ended = false; ///< the stream: the block is not to be used
    std::exception_ptr failure;
  };

  MeshSource& Mesh;
  bool Ahead;
  bool Ended = false;
  Read Current, Following;
};

} // namespace smg
