// SPDX-License-Identifier: BSD-3-Clause
/*
The light on the Stanford bunny, recorded in four scans of different brightness, becomes seamless,
out of core, in C++ without VTK.

Scans of a real object have such columns in their file; there, the same from the command line is

    smg blend scan.ply blended.ply --patch Scan --columns Light

What this lesson shows:
 1. A StoredMesh is a mesh that can be read several times. ScannedMesh is one: another mesh with two
    computed columns, the number of the scan and the light.
 2. blend() removes the steps of the light between the scans and keeps its gradients inside them. It
    solves on scratch files within a memory limit and returns the new values, which are read range
    by range.
 3. ReplacedColumns is the mesh stream with these values; a writer reads it block by block. The
whole mesh is never in memory.

Run it:

    blending ../../Data/bunny.smb bunny-blended.vsm

    34834 vertices: converged in 9 passes
      Light: the largest step between scans was 64.7098 and is 0.968176
*/

#include <smg/Blend.h>
#include <smg/Convert.h>
#include <smg/SolvedMesh.h>
#include <smg/WriteMesh.h>

#include <iostream>
#include <memory>
#include <utility>

namespace
{

const smg::ColumnSpec Scan{ "Scan", smg::ScalarType::Float64, 1 };
const smg::ColumnSpec Light{ "Light", smg::ScalarType::Float64, 1 };

/** A mesh stream with the columns of the scans. */
class ScannedSource : public smg::MeshSource
{
public:
  explicit ScannedSource(std::unique_ptr<smg::MeshSource> source)
    : Source(std::move(source))
    , Info(this->Source->info())
  {
    this->Info.vertexColumns = { Scan, Light };
  }

  const smg::StreamInfo& info() const override { return this->Info; }

  bool next(smg::MeshBlock& block) override
  {
    if (!this->Source->next(block))
    {
      return false;
    }
    const auto vertices = static_cast<std::size_t>(block.vertices());
    block.vertexColumns = { { Scan, {} }, { Light, {} } };
    for (smg::Column& column : block.vertexColumns)
    {
      column.resize(vertices);
    }
    for (std::size_t i = 0; i < vertices; ++i)
    {
      const double* p = block.positions.data() + 3 * i;
      const double scan = (p[0] > -0.02 ? 1.0 : 0.0) + (p[1] > 0.1 ? 2.0 : 0.0);
      block.vertexColumns[0].as<double>()[i] = scan;
      block.vertexColumns[1].as<double>()[i] = 128.0 + 512.0 * p[2] + 32.0 * scan;
    }
    return true;
  }

private:
  std::unique_ptr<smg::MeshSource> Source;
  smg::StreamInfo Info;
};

/** A mesh with these columns, which can be read again. */
class ScannedMesh : public smg::StoredMesh
{
public:
  explicit ScannedMesh(const smg::StoredMesh& mesh)
    : Mesh(mesh)
    , Info(this->source({}, {})->info())
  {
  }

  const smg::StreamInfo& info() const override { return this->Info; }
  /** Has both columns whatever is asked for. */
  std::unique_ptr<smg::MeshSource> source(std::vector<std::string> /*vertexColumns*/,
    std::vector<std::string> /*cellColumns*/) const override
  {
    return std::make_unique<ScannedSource>(this->Mesh.source({}, {}));
  }

private:
  const smg::StoredMesh& Mesh;
  smg::StreamInfo Info;
};

void print(const smg::Report& report)
{
  std::cout << report.vertices
            << " vertices: " << (report.converged ? "converged" : "not converged") << " in "
            << report.passes << " passes\n";
  for (const smg::Report::Seam& seam : report.seams)
  {
    std::cout << "  " << seam.column << ": the largest step between scans was " << seam.before
              << " and is " << seam.after << "\n";
  }
}

} // namespace

int main(int argc, char** argv)
{
  if (argc != 3)
  {
    std::cerr << "usage: blending BUNNY BLENDED.vsm|.ply|.vtp\n";
    return 2;
  }
  try
  {
    const auto bunny = smg::openMesh(argv[1]);
    const ScannedMesh scans(bunny->reader());

    smg::BlendDescription description;
    description.patch = Scan.name;
    description.columns = { Light.name };
    smg::SolveOptions options;
    options.memoryLimit = std::int64_t(128) << 20;
    const auto light = smg::blend(scans, description, options);
    print(light->report());

    smg::ReplacedColumns blended(bunny->reader(), *light, { Light });
    for (const std::string& remark : smg::writeMesh(blended, argv[2]))
    {
      std::cout << remark << "\n";
    }
    return 0;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
