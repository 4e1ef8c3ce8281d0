// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <functional>

namespace smg::benchmark
{

/**
 * Runs `work` in a child process, so that its memory is measured by itself, and returns its answer.
 * When the child throws or dies, the answer is `{"failed": "why"}`.
 */
nlohmann::json runInChild(const std::function<nlohmann::json()>& work);

} // namespace smg::benchmark
