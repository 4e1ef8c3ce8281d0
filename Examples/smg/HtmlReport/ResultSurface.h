// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Error.h"
#include "smg/MeshSource.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace html
{

/** The surface of a mesh with columns of its vertices, small enough for a page: what viewer.js
 * draws. */
struct ResultSurface
{
  /** A component of a column, or colours. */
  struct Shown
  {
    std::string name;
    bool isColour = false;
    /** The smallest and the largest finite number at all vertices of the mesh, which the surface
     * need not have. */
    double least = 0.0, most = 0.0;
    /** Of each point: red, green and blue, a byte each; or a number of 16 bits, 0 for `least` and
     * 65534 for `most`, 65535 where it is not finite. */
    std::vector<std::byte> values = {};
  };

  std::int64_t vertices = 0;          ///< of the mesh
  bool isSolid = false;               ///< whether the cells are tetrahedra
  std::array<double, 6> bounds{};     ///< of the surface
  std::vector<float> positions;       ///< relative to the centre of the bounds
  std::vector<std::uint16_t> corners; ///< of triangles
  std::vector<Shown> columns;
  int shown = -1;      ///< the column that is drawn first; -1: none
  std::string failure; ///< why there is no surface; empty: there is one

  std::size_t points() const { return this->positions.size() / 3; }
  std::size_t triangles() const { return this->corners.size() / 3; }

  /** The data as JSON in ASCII, without a "<", so that it may stand in an element of a page. */
  std::string json() const;
};

/** The most points of such a surface. */
inline constexpr std::int64_t SurfacePoints = 20000;

/**
 * Reads a mesh stream to its end and simplifies its surface to SurfacePoints points, or fewer if
 * the memory asks for it. The first columns shown are those with the names `first`, in their order,
 * then others of the vertices, at most eight in all.
 *
 * @param memory limit in bytes
 * @throws Error if the stream cannot be read. Where the surface itself is the problem, that is its
 * `failure`.
 * @throws Cancelled
 */
ResultSurface resultSurface(smg::MeshSource& mesh, const std::vector<std::string>& first,
  std::int64_t memory, const smg::ProgressFunction& progress);

} // namespace html
