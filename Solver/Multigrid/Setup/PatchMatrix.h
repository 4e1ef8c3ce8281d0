// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>

namespace smg
{

/** A symmetric matrix of the nodes of a patch, of order up to Most: its lower triangle by rows. */
struct PatchMatrix
{
  /** A sliver refined once is a cluster of ten vertices; 8 leave some of them out. */
  static constexpr int Most = 12;
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

  /** The rows and columns of `members`, a subset. */
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
   * Replaces the matrix by a generalised inverse, by its factors L D L^T: without roots, so that
   * the matrix times a power of two gives the same bits. The rows and columns of pivots below
   * `least` times their diagonal entries are zero: a node whose correction the others determine up
   * to rounding, as in a patch that is a separate component, is not corrected. Returns whether
   * there is no such pivot.
   */
  bool invert(double least)
  {
    bool definite = true;
    double lower[Most][Most] = {}; // the inverse of L
    double inverse[Most];          // that of D
    for (int a = 0; a < this->order; ++a)
    {
      double row[Most]; // of L
      double pivot = this->at(a, a);
      for (int b = 0; b < a; ++b)
      {
        double sum = 0.0;
        for (int k = 0; k <= b; ++k)
        {
          sum += lower[b][k] * this->at(a, k);
        }
        row[b] = sum * inverse[b];
        pivot -= sum * row[b];
      }
      if (!(pivot > least * this->at(a, a)))
      {
        definite = false;
        inverse[a] = 0.0;
        continue;
      }
      inverse[a] = 1.0 / pivot;
      for (int b = 0; b < a; ++b)
      {
        for (int k = b; k < a; ++k)
        {
          lower[a][b] -= row[k] * lower[k][b];
        }
      }
      lower[a][a] = 1.0;
    }
    for (int a = 0; a < this->order; ++a)
    {
      for (int b = 0; b <= a; ++b)
      {
        double sum = 0.0;
        for (int k = a; k < this->order; ++k)
        {
          sum += lower[k][a] * inverse[k] * lower[k][b];
        }
        this->at(a, b) = sum;
      }
    }
    return definite;
  }
};

} // namespace smg
