// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/IndexedMesh.h"

#include <cstddef>
#include <functional>
#include <string>

namespace smg
{

/** What a process says to the one that started it, through a pipe. */
enum class MeshMessage : unsigned char
{
  Progress, ///< a double, 0 to 1
  Mesh,     ///< see sendMesh()
  Failure   ///< a sentence
};

/** The end of a pipe that a child process writes to. When nobody reads it, the process ends. */
class MeshPipeWriter
{
public:
  explicit MeshPipeWriter(int descriptor)
    : Descriptor(descriptor)
  {
  }

  void sendProgress(double done);
  void sendFailure(const std::string& sentence);
  /** Sends the mesh and frees its parts as they are sent. */
  void sendMesh(IndexedMesh mesh);

private:
  void bytes(const void* data, std::size_t count);

  template <class T>
  void value(const T& value)
  {
    this->bytes(&value, sizeof(value));
  }
  template <class T>
  void vector(std::vector<T>& values);
  void columns(std::vector<Column>& columns);

  int Descriptor;
};

/** The end of the pipe that is read. */
class MeshPipeReader
{
public:
  /** `idle` is called now and then while nothing comes; it may throw. */
  MeshPipeReader(int descriptor, std::function<void()> idle)
    : Descriptor(descriptor)
    , Idle(std::move(idle))
  {
  }

  /** Receives the kind of the next message; false at the end. */
  bool next(MeshMessage& message);
  /** Receives the rest of a message of this kind; false if it ends before. */
  bool receive(double& done) { return this->bytes(&done, sizeof(done)); }
  bool receive(std::string& sentence);
  bool receive(IndexedMesh& mesh);

private:
  bool bytes(void* data, std::size_t count);

  template <class T>
  bool value(T& value)
  {
    return this->bytes(&value, sizeof(value));
  }
  template <class T>
  bool vector(std::vector<T>& values);
  bool columns(std::vector<Column>& columns);

  int Descriptor;
  std::function<void()> Idle;
};

} // namespace smg
