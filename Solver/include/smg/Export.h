// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** Marks the exported symbols of the shared libraries; all others are hidden. */
#define SMG_EXPORT __attribute__((visibility("default")))
