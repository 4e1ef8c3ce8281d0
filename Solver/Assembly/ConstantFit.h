// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace smg
{

/**
 * What is left of a vector b beside the best multiple of a vector w: the least ||b - c w||^2 over
 * the constants c, summed up entry by entry.
 *
 * The constant of the entries so far and what is left beside it are updated together, as in
 * recursive least squares: nothing large is subtracted, and a large constant, as that of 293 K, or
 * one entry with a small w, costs no digits of what is left.
 */
class ConstantFit
{
public:
  void add(double w, double b)
  {
    const double before = this->WW;
    const double misfit = b - this->Constant * w;
    this->Squares += b * b;
    this->WW += w * w;
    if (w != 0.0 && this->WW > 0.0)
    {
      this->Constant += w / this->WW * misfit;
      this->Rest += misfit * misfit * (before / this->WW);
    }
    else
    {
      this->Rest += misfit * misfit;
    }
  }

  /** Adds the entries of another fit. */
  void join(const ConstantFit& other)
  {
    const double both = this->WW + other.WW;
    this->Squares += other.Squares;
    this->Rest += other.Rest;
    if (other.WW > 0.0)
    {
      const double change = other.Constant - this->Constant;
      this->Rest += change * change * this->WW * (other.WW / both);
      this->Constant += change * (other.WW / both);
      this->WW = both;
    }
  }

  /** Whether any w is not 0. */
  bool hasConstant() const { return this->WW > 0.0; }
  /** ||b||^2. */
  double squares() const { return this->Squares; }
  /** The least ||b - c w||^2; 0 if it is the rounding of b. */
  double rest() const
  {
    constexpr double Rounding = 1e-26;
    return this->Rest > Rounding * this->Squares ? this->Rest : 0.0;
  }

private:
  double Constant = 0.0; ///< the best one so far
  double WW = 0.0;       ///< ||w||^2
  double Squares = 0.0;  ///< ||b||^2
  double Rest = 0.0;     ///< ||b - Constant w||^2
};

} // namespace smg
