// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Off/OffHeader.h"

namespace smg
{

class InputFile;
class RawMeshBuilder;

/** Reads the counts of a binary file, from byte `header.body` on, and advances past them. Throws
 * Error if the file is too short for them. */
void readBinaryOffCounts(InputFile& file, OffHeader& header);

/**
 * Reads vertices and faces of a binary file: 32-bit numbers, most significant byte first, as
 * Geomview writes them. A vertex has floats in the order of the keyword's letters, a colour four; a
 * face has its number of corners, these, and the number of its colour's floats, and these.
 */
void readBinaryOff(InputFile& file, const OffHeader& header, RawMeshBuilder& builder);

} // namespace smg
