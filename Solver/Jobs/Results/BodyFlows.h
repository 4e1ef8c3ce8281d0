// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Components.h"
#include "smg/Problem.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace smg
{

/**
 * What flows in each body, a connected component of the mesh: what a solve leaves in one of them
 * makes its fluxes wrong alone. Bodies have the labels of OpenLabels. Sums are kept by label, and
 * added up where labels are joined at the end, so that their bits depend on no blocks.
 */
class BodyFlows
{
public:
  /** So many labels bound the memory: later bodies are judged as one with the first. */
  static constexpr std::int32_t mostLabels(int columns) { return (1 << 14) / columns; }
  static constexpr double Far = std::numeric_limits<double>::infinity();

  /** The sums of a column. */
  struct Sums
  {
    double all = 0.0;   ///< magnitudes of what flows in and out
    double given = 0.0; ///< of these, those of sources, screening and prescribed fluxes
    double terms = 0.0; ///< magnitudes of the terms whose differences are the other fluxes
    double energy = 0.0;
    // Of the residuals of vertices without a Dirichlet condition: the sum, that of the squares, of
    // the squares over the sum of the weights of the row, and of the squares of what the last digit
    // of u makes of it.
    double residual = 0.0, squares = 0.0, scaled = 0.0, rounding = 0.0;
    // The least numbers, and the largest ones with the opposite sign.
    double least = Far, most = Far;     ///< u
    double lowest = Far, highest = Far; ///< values of Dirichlet conditions and ambient values

    void include(double u)
    {
      this->least = u < this->least ? u : this->least;
      this->most = -u < this->most ? -u : this->most;
    }
    void prescribe(double value)
    {
      this->lowest = value < this->lowest ? value : this->lowest;
      this->highest = -value < this->highest ? -value : this->highest;
    }
    void addResidual(double of, double weights, double u);
    void add(const Sums& other);
  };

  /** A condition of which the flux is not given, in the order of Dirichlet, then Robin conditions;
   * and a body in which it holds. */
  using Place = std::pair<std::int32_t, std::int32_t>;

  BodyFlows(const ConditionCounts& counts, int columns);
  BodyFlows(const BodyFlows&) = delete; // of a place in its map
  BodyFlows& operator=(const BodyFlows&) = delete;

  /** The sums of column k in the body of this label. */
  Sums& of(std::int32_t label, std::size_t k)
  {
    const std::size_t place = static_cast<std::size_t>(label) * this->Columns + k;
    return place < this->All.size() ? this->All[place] : this->extended(place);
  }
  const Sums& of(std::int32_t label, std::size_t k) const
  {
    return this->All[static_cast<std::size_t>(label) * this->Columns + k];
  }
  /** Adds to what screening holds a body by: the sum of the rows of the matrix. */
  void screen(std::int32_t label, double rowSum);
  /** Adds to what a condition holds a body by: a Dirichlet condition by more than any number. */
  void touchDirichlet(std::int32_t condition, std::int32_t label)
  {
    this->touch({ condition, label }, Far);
  }
  void touchRobin(std::int32_t condition, std::int32_t label, double rowSum)
  {
    this->touch({ this->Dirichlet + condition, label }, rowSum);
  }

  /** Adds up the sums of bodies that have been joined. The last step. */
  void settle(const Components& components);
  /** Appends pointers to the sums, and to the least numbers, if the parts of a mesh have one body,
   * which is that of all. */
  void appendNumbers(std::vector<double*>& sums, std::vector<double*>& least);

  std::int32_t labels() const
  {
    return static_cast<std::int32_t>(this->All.size() / this->Columns);
  }
  std::int32_t conditions() const { return this->Conditions; }
  double screened(std::int32_t label) const;
  /** What holds bodies where, in the order of the conditions. */
  const std::map<Place, double>& touched() const { return this->Touched; }

private:
  void touch(Place place, double rowSum);
  Sums& extended(std::size_t place);

  std::size_t Columns;
  std::int32_t Dirichlet, Conditions; // numbers of conditions
  std::vector<Sums> All;              // `Columns` per label
  std::vector<double> Screened;       // per label
  std::map<Place, double> Touched;
  std::map<Place, double>::iterator Last; // the place that was touched last
};

} // namespace smg
