// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Timer.h"
#include "smg/MeshSource.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace smg::benchmark
{

/** A mesh stream that adds the time of its reading and decoding to a number. */
class TimedSource : public MeshSource
{
public:
  TimedSource(std::unique_ptr<MeshSource> source, double& seconds)
    : Source(std::move(source))
    , Seconds(seconds)
  {
  }
  const StreamInfo& info() const override { return this->Source->info(); }
  bool next(MeshBlock& block) override
  {
    const Timer timer;
    const bool isThere = this->Source->next(block);
    this->Seconds += timer.seconds();
    return isThere;
  }

private:
  std::unique_ptr<MeshSource> Source;
  double& Seconds;
};

/** A stored mesh whose streams do so. */
class TimedMesh : public StoredMesh
{
public:
  TimedMesh(const StoredMesh& mesh, double& seconds)
    : Mesh(mesh)
    , Seconds(seconds)
  {
  }
  const StreamInfo& info() const override { return this->Mesh.info(); }
  std::unique_ptr<MeshSource> source(
    std::vector<std::string> vertexColumns, std::vector<std::string> cellColumns) const override
  {
    return std::make_unique<TimedSource>(
      this->Mesh.source(std::move(vertexColumns), std::move(cellColumns)), this->Seconds);
  }
  std::string fingerprint() const override { return this->Mesh.fingerprint(); }
  std::filesystem::path file() const override { return this->Mesh.file(); }
  std::string fileFingerprint() const override { return this->Mesh.fileFingerprint(); }

private:
  const StoredMesh& Mesh;
  double& Seconds;
};

} // namespace smg::benchmark
