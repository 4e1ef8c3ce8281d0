// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace smg
{

/**
 * What is left of a vector b beside the best multiple of a vector w: the least ||b - c w||^2 over
 * the constants c, summed up entry by entry.
 *
 * The sums are those of b - c0 w, c0 the constant of the first entry with w != 0: a large constant,
 * as that of 293 K, costs no digits of what varies beside it.
 */
class ConstantFit
{
public:
  void add(double w, double b)
  {
    if (w != 0.0 && this->WW == 0.0)
    {
      this->Constant = b / w;
    }
    const double rest = b - this->Constant * w;
    this->Squares += b * b;
    this->WW += w * w;
    this->WB += w * rest;
    this->BB += rest * rest;
  }

  /** Adds the entries of another fit. */
  void join(const ConstantFit& other)
  {
    if (this->WW == 0.0)
    {
      this->Constant = other.Constant;
    }
    // Of the other one: b - c0 w = (b - c1 w) + (c1 - c0) w.
    const double change = other.WW == 0.0 ? 0.0 : other.Constant - this->Constant;
    this->Squares += other.Squares;
    this->WW += other.WW;
    this->WB += other.WB + change * other.WW;
    this->BB += other.BB + change * (2.0 * other.WB + change * other.WW);
  }

  /** Whether any w is not 0. */
  bool hasConstant() const { return this->WW > 0.0; }
  /** ||b||^2. */
  double squares() const { return this->Squares; }
  /** The least ||b - c w||^2; 0 if it is the rounding of b. */
  double rest() const
  {
    constexpr double Rounding = 1e-26;
    const double rest = this->BB - (this->WW > 0.0 ? this->WB * (this->WB / this->WW) : 0.0);
    return rest > Rounding * this->Squares ? rest : 0.0;
  }

private:
  double Constant = 0.0;
  double Squares = 0.0;                ///< of b
  double WW = 0.0, WB = 0.0, BB = 0.0; ///< of w and b - Constant w
};

} // namespace smg
