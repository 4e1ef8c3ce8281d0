// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/IndexedMesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/**
 * Collects the cells of a file, whatever they are, and makes the cells of one kind of them:
 * tetrahedra if there are any, else triangles. Polygons become fans of triangles.
 *
 * Every call is one element of the file and takes the next original number.
 */
class CellCollector
{
public:
  /** Room for the elements that a header promises. */
  void reserve(std::int64_t triangles, std::int64_t tetrahedra);

  void triangle(std::int64_t a, std::int64_t b, std::int64_t c)
  {
    this->note(this->Triangles, 1);
    this->Triangles.corners.insert(this->Triangles.corners.end(), { a, b, c });
  }
  void tetrahedron(std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d)
  {
    this->note(this->Tetrahedra, 1);
    this->Tetrahedra.corners.insert(this->Tetrahedra.corners.end(), { a, b, c, d });
  }
  /** Fewer than three corners are a dropped element. */
  void polygon(std::span<const std::int64_t> corners);
  /** A triangle strip; -1 starts another one. */
  void strip(std::span<const std::int64_t> corners);
  /** A point, a line, or whatever else is not kept. */
  void dropped() { ++this->Elements; }

  /** Elements so far. */
  std::int64_t elements() const { return this->Elements; }

  /**
   * Gives the cells to the mesh: type, corners, original numbers and counts. `columns` have a tuple
   * an element of the file and become the mesh's cell columns.
   */
  void finish(IndexedMesh& mesh, std::vector<Column> columns = {});

private:
  struct Kind
  {
    std::vector<std::int64_t> corners;
    std::vector<std::int64_t> originals; ///< empty as long as cell c is element c
    std::int64_t elements = 0;
  };

  /** The next element becomes `cells` cells of the kind. */
  void note(Kind& kind, std::int64_t cells)
  {
    if (cells != 1 || !kind.originals.empty() || kind.elements != this->Elements)
    {
      this->noteOriginal(kind, cells);
    }
    ++kind.elements;
    ++this->Elements;
  }
  void noteOriginal(Kind& kind, std::int64_t cells);

  Kind Triangles, Tetrahedra;
  std::int64_t Elements = 0;
  std::int64_t Polygons = 0;
};

} // namespace smg
