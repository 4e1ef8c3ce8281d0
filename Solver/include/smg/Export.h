// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** Marks what the shared libraries export: all other symbols are hidden. */
#define SMG_EXPORT __attribute__((visibility("default")))
