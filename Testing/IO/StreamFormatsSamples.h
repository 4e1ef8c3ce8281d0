// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>

namespace smg::testing
{

inline const std::string TwoTriangles = "# nverts 4\n"
                                        "# nfaces 2\n"
                                        "# bb_min 0 0 0\n"
                                        "# bb_max 1 1 0.5\n"
                                        "v 0 0 0\n"
                                        "v 1 0 0\n"
                                        "v 0 1 0\n"
                                        "f -3 2 3\n"
                                        "v 1 1 0.5\n"
                                        "f -3 -1 -2\n";

inline const std::string TwoTrianglesPost = "f 1 2 4\n"
                                            "v 0 0 0\n"
                                            "f 2 3 4\n"
                                            "v 1 0 0\n"
                                            "v 1 1 0.5\n"
                                            "v 0 1 0\n";

inline const std::string TwoTets = "# svtype tet\n"
                                   "# nverts 5\n"
                                   "# ncells 2\n"
                                   "# v_pnum_f 3\n"
                                   "# v_pmin_f 0 0 0\n"
                                   "# v_pmax_f 1 1 1\n"
                                   "v 0 0 0\n"
                                   "v 1 0 0\n"
                                   "v 0 1 0\n"
                                   "v 0 0 1\n"
                                   "c -4 2 3 4\n"
                                   "v 1 1 1\n"
                                   "c -4 -3 -2 -1\n";

/** Words of four bytes, little-endian. */
inline std::string words(std::initializer_list<std::uint32_t> values)
{
  std::string bytes;
  for (const std::uint32_t value : values)
  {
    for (int k = 0; k < 4; k++)
    {
      bytes += char(value >> (8 * k));
    }
  }
  return bytes;
}

inline constexpr std::uint32_t One = 0x3f800000;
inline constexpr std::uint32_t Half = 0x3f000000;

/** TwoTriangles as SMB. */
inline std::string twoTrianglesBinary()
{
  return words({ 0, 0, 4, 2 }) + '\1' + words({ 0, 0, 0, One, One, Half }) +
         words({ 0x17, 0, 0, 0, One, 0, 0, 0, One, 0 }) + words({ std::uint32_t(-3), 2, 3 }) +
         words({ One, One, Half }) +
         words({ std::uint32_t(-3), std::uint32_t(-1), std::uint32_t(-2) });
}

/** TwoTets as SVB. */
inline std::string twoTetsBinary()
{
  return words({ 4, 0, 5, 2, 3, 0 }) + '\1' + words({ 0, 0, 0, One, One, One, 0x2f }) +
         words({ 0, 0, 0, 0, One, 0, 0, 0, 0, One, 0, 0, 0, 0, One, 0 }) +
         words({ std::uint32_t(-4), 2, 3, 4, One, One, One, 0 }) +
         words({ std::uint32_t(-4), std::uint32_t(-3), std::uint32_t(-2), std::uint32_t(-1) });
}

} // namespace smg::testing
