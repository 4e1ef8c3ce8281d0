// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** Marks a symbol that the shared libraries export; all others are hidden. */
#define SMG_EXPORT __attribute__((visibility("default")))
