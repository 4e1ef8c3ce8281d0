// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace smg::testing
{

/** Whether this build has AddressSanitizer or ThreadSanitizer, under which tests take ten times as
 * long: their meshes may then be smaller, as long as they take the same paths. */
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool Sanitized = true;
#else
inline constexpr bool Sanitized = false;
#endif

/** Whether buffers grow in place, with mremap(), and not by a second copy: see Buffer.h. */
#ifdef __SANITIZE_THREAD__
inline constexpr bool GrowsInPlace = false;
#else
inline constexpr bool GrowsInPlace = true;
#endif

/** The least memory limit of a conversion, MiB, in which buffers that do not grow in place fit. */
inline constexpr int MinMebibytes = GrowsInPlace ? 16 : 32;

} // namespace smg::testing
