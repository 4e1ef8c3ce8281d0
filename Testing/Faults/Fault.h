// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace smg::testing
{

/** What shall go wrong in the calls to the system: the n-th call of a kind, once or from then on.
 */
struct Fault
{
  enum class Kind
  {
    Error,      ///< the call does nothing and returns an error
    Short,      ///< a read or write transfers half of the bytes
    Zero,       ///< a read or write transfers none, without an error
    FlippedBit, ///< a read returns one wrong bit; spare() excludes files
    Kill,       ///< the process is killed before the call
  };

  /** Name of an entry of SystemCalls; `memory`: those that map memory; `files`: all others except
   * those that remove files. */
  std::string call = "files";
  std::int64_t nth = 0; ///< from 1; 0: none
  bool forever = false; ///< this call and all later ones of the kind
  Kind kind = Kind::Error;
  int error = 0; ///< of Kind::Error: the value of errno

  /** From "CALL NTH once|forever WHAT", where WHAT is short, zero, flip, kill or an error number.
   */
  static Fault parse(const std::string& text);
};

/** Reads of these existing files have no wrong bits: files without checksums, in which nobody could
 * notice them. Paths are separated by colons. */
void spare(const std::string& paths);

/**
 * Puts the fault into the table of system calls; counting begins again. The calls that are counted
 * are those in which this kind of fault can occur.
 */
void install(const Fault& fault);

/** Calls counted since install(). */
std::int64_t countedCalls();

} // namespace smg::testing
