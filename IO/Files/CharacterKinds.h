// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace smg
{

/** What the characters of a text are for. */
class CharacterKinds
{
public:
  enum Kind : std::uint8_t
  {
    Letter, ///< of a word
    Blank,
    LineEnd,
    Comment ///< begins one up to the end of the line, also directly after a word
  };

  /** A carriage return counts as a blank. `comment`: 0: no comments. */
  explicit CharacterKinds(char comment)
  {
    for (const unsigned char c : { ' ', '\t', '\r', '\f', '\v' })
    {
      this->Kinds[c] = Blank;
    }
    this->Kinds['\n'] = LineEnd;
    if (comment)
    {
      this->Kinds[static_cast<unsigned char>(comment)] = Comment;
    }
  }

  Kind operator()(char c) const { return this->Kinds[static_cast<unsigned char>(c)]; }

private:
  std::array<Kind, 256> Kinds{};
};

} // namespace smg
