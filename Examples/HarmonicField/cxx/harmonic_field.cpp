// SPDX-License-Identifier: BSD-3-Clause
/*
A harmonic field on the Stanford bunny, out of core, in C++ without VTK.

The field is 0 at the feet and 1 at the tips of the ears; in between it is harmonic: each value is
the weighted mean of its neighbours. The program writes the field's isolines as the lines of an OBJ
file.

What this lesson shows:
 1. A mesh stream delivers vertices and cells block by block and marks vertices as final when no
    later cell uses them. A program that releases these holds only a small window of the mesh.
 2. A problem is described by conditions and their places, for example regions.
 3. solve() reads the stream once, works on scratch files within a memory limit, and returns a
    solution that is read range by range, here together with the stream.

Run it:

    harmonic_field ../../Data/bunny.smb isolines.obj

    34834 vertices, 69451 cells: converged after 6 cycles, relative residual 7.42985e-09
    isolines.obj: 7379 segments of 23 isolines
*/

#include <smg/Convert.h>
#include <smg/Error.h>
#include <smg/Solve.h>

#include <array>
#include <deque>
#include <fstream>
#include <iostream>
#include <span>
#include <vector>

namespace
{

constexpr double Feet = 0.036; // metres above the ground; y points up
constexpr double Ears = 0.18;
constexpr int Bands = 24;

/** Prescribed values at feet and ears. */
smg::ProblemDescription feetAndEars()
{
  smg::ProblemDescription problem;
  problem.dirichlet = { { smg::halfSpace({ 0, -1, 0 }, -Feet), 0.0 },
    { smg::halfSpace({ 0, 1, 0 }, Ears), 1.0 } };
  return problem;
}

/** A vertex that a later cell may use. */
struct Vertex
{
  std::array<double, 3> point;
  double value;
};

/** Writes the segments of the isolines that cross a triangle; returns their number. */
int crossTriangle(std::ostream& out, const std::array<const Vertex*, 3>& corners)
{
  int segments = 0;
  for (int band = 1; band < Bands; ++band)
  {
    const double level = double(band) / Bands;
    int crossings = 0;
    for (int k = 0; k < 3; ++k)
    {
      const Vertex& a = *corners[k];
      const Vertex& b = *corners[(k + 1) % 3];
      if ((a.value < level) != (b.value < level))
      {
        const double t = (level - a.value) / (b.value - a.value);
        out << "v";
        for (int axis = 0; axis < 3; ++axis)
        {
          out << " " << a.point[axis] + t * (b.point[axis] - a.point[axis]);
        }
        out << "\n";
        ++crossings;
      }
    }
    if (crossings == 2)
    {
      out << "l -2 -1\n";
      ++segments;
    }
  }
  return segments;
}

/** Reads the mesh stream and the solution together, with a window of both. */
int writeIsolines(smg::MeshSource& mesh, smg::Solution& solution, std::ostream& out)
{
  int segments = 0;
  std::deque<Vertex> window;
  std::int64_t first = 0; // stream index of the window's first vertex
  std::vector<double> values;
  smg::MeshBlock block;
  while (mesh.next(block))
  {
    values.resize(block.vertices());
    solution.read(block.firstVertex, block.vertices(), values);
    for (std::int64_t i = 0; i < block.vertices(); ++i)
    {
      const double* point = &block.positions[3 * i];
      window.push_back({ { point[0], point[1], point[2] }, values[i] });
    }
    for (std::size_t c = 0; c < block.corners.size(); c += 3)
    {
      segments += crossTriangle(
        out, { &window[block.corners[c] - first], &window[block.corners[c + 1] - first],
               &window[block.corners[c + 2] - first] });
    }
    for (; first < block.finalized; ++first)
    {
      window.pop_front();
    }
  }
  return segments;
}

} // namespace

int main(int argc, char** argv)
{
  if (argc != 3)
  {
    std::cerr << "usage: harmonic_field MESH ISOLINES.obj\n";
    return 2;
  }
  try
  {
    // Any mesh file is converted to a mesh stream; a stream keeps its order.
    const auto mesh = smg::openMesh(argv[1]);
    if (mesh->info().cellType != smg::CellType::Triangle)
    {
      throw smg::Error(std::string(argv[1]) + " has tetrahedra: this example needs triangles.");
    }

    const auto solution = smg::solve(*mesh, feetAndEars(), { .memoryLimit = 64 * smg::MiB });
    const smg::Report& report = solution->report();
    // If every vertex is prescribed, there is no cycle and no residual.
    const double residual = report.residual();
    std::cout << report.vertices << " vertices, " << report.cells
              << " cells: " << (report.converged ? "converged" : "not converged") << " after "
              << report.cycles << " cycles, relative residual " << residual << "\n";

    std::ofstream out(argv[2]);
    const int segments = writeIsolines(*mesh->source({}, {}), *solution, out);
    out.close();
    if (!out)
    {
      throw smg::Error(std::string(argv[2]) + " cannot be written.");
    }
    std::cout << argv[2] << ": " << segments << " segments of " << Bands - 1 << " isolines\n";
    return 0;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
