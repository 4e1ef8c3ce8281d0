// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace smg
{

/** A symmetric matrix of the nodes of a patch, of order up to Most: its lower triangle by rows. */
struct PatchMatrix
{
  static constexpr int Most = 4;
  static constexpr int Entries = Most * (Most + 1) / 2;

  int order = 0;
  double entry[Entries] = {};

  static constexpr int entriesOf(int order) { return order * (order + 1) / 2; }
  static constexpr int place(int a, int b)
  {
    return std::max(a, b) * (std::max(a, b) + 1) / 2 + std::min(a, b);
  }

  double& at(int a, int b) { return this->entry[place(a, b)]; }
  double at(int a, int b) const { return this->entry[place(a, b)]; }

  /** The rows and columns of `members`, which are fewer. */
  PatchMatrix part(const int* members, int count) const
  {
    PatchMatrix part;
    part.order = count;
    for (int a = 0; a < count; ++a)
    {
      for (int b = 0; b <= a; ++b)
      {
        part.at(a, b) = this->at(members[a], members[b]);
      }
    }
    return part;
  }

  /**
   * Replaces the matrix by its inverse, by Cholesky's method; false, and the matrix is lost, if it
   * is not positive definite up to rounding: if a pivot is below `least` times its diagonal entry.
   */
  bool invert(double least)
  {
    double factor[Most][Most] = {}; // the inverse of Cholesky's lower factor
    for (int a = 0; a < this->order; ++a)
    {
      // Row a of the factor times the inverse of what is above it.
      double row[Most];
      double pivot = this->at(a, a);
      for (int b = 0; b < a; ++b)
      {
        row[b] = 0.0;
        for (int k = 0; k <= b; ++k)
        {
          row[b] += factor[b][k] * this->at(a, k);
        }
        pivot -= row[b] * row[b];
      }
      if (!(pivot > least * this->at(a, a)))
      {
        return false;
      }
      const double inverse = 1.0 / std::sqrt(pivot);
      for (int b = 0; b < a; ++b)
      {
        for (int k = b; k < a; ++k)
        {
          factor[a][b] -= row[k] * factor[k][b];
        }
        factor[a][b] *= inverse;
      }
      factor[a][a] = inverse;
    }
    for (int a = 0; a < this->order; ++a)
    {
      for (int b = 0; b <= a; ++b)
      {
        double sum = 0.0;
        for (int k = a; k < this->order; ++k)
        {
          sum += factor[k][a] * factor[k][b];
        }
        this->at(a, b) = sum;
      }
    }
    return true;
  }
};

} // namespace smg
