// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Prefetch.h"
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
      this->Spare = std::move(this->Current.block);
      this->Current = this->Blocks.take([this] { return this->next(); });
    }
  }

  /** Reads the block after the current one, if it has not been read: on any thread. */
  void read()
  {
    this->Blocks.fill(
      [this] { return this->Ahead && !this->Ended; }, [this] { return this->next(); });
  }

  const StreamInfo& info() const { return this->Mesh.info(); }
  bool isAhead() const { return this->Ahead; }
  /** The number of vertices of the current block if it was read ahead; 0 at the end of the
   * stream. */
  std::int64_t vertices() const { return this->Current.ended ? 0 : this->Current.block.vertices(); }

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
    bool ended = true; ///< the stream, also by a failure: the block is not to be used
    std::exception_ptr failure;
  };

  /** In the memory of the last block but one. Behind its end the mesh is not asked again. */
  Read next()
  {
    Read read{ std::move(this->Spare), true, nullptr };
    if (this->Ended)
    {
      return read;
    }
    try
    {
      read.ended = !this->Mesh.next(read.block);
    }
    catch (...)
    {
      // block() rethrows it when the blocks before it have been processed, as without reading
      // ahead.
      read.failure = std::current_exception();
    }
    this->Ended = read.ended;
    return read;
  }

  MeshSource& Mesh;
  bool Ahead;
  bool Ended = false;
  Read Current;
  MeshBlock Spare;
  Prefetch<Read> Blocks;
};

} // namespace smg
