// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace smg
{

/** A temporary name beside a file, unique unless a terminated program left a file with it. */
std::filesystem::path temporaryName(const std::filesystem::path& path);
/** Locks a temporary file as long as it is open, so that no other program removes it as abandoned.
 * False if one has. */
bool lockTemporary(int file) noexcept;
/** Removes the temporary files beside `path` whose programs were killed: those without a lock.
 * Where the file system has no locks, none. */
void removeAbandonedTemporaries(const std::filesystem::path& path);

} // namespace smg
