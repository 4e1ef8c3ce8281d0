// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/PageFile.h"

#include <bit>
#include <cstdint>
#include <filesystem>
#include <type_traits>
#include <utility>

namespace smg
{

/** An unbounded array of values, initially zero, in bounded memory: the rest is in a scratch file.
 * Fast if consecutive accesses are close to each other. */
template <class T>
class PagedArray
{
  static_assert(std::is_trivially_copyable_v<T> && std::has_single_bit(sizeof(T)));

public:
  /** Scratch files go to `folder` (see PageFile); at most `memory` bytes of the values are in
   * memory. */
  PagedArray(std::filesystem::path folder, std::int64_t memory)
    : Pages(std::move(folder), memory)
  {
  }

  /** The value at index `i`, for modification; valid until another index is accessed. */
  T& at(std::int64_t i) { return *this->visit(i, true); }

  /** The value at index `i`. */
  T get(std::int64_t i) { return *this->visit(i, false); }

  /** Declares that no index below `i` will be accessed again. */
  void discardBelow(std::int64_t i)
  {
    if (i / PerPage > this->FirstPage)
    {
      this->FirstPage = i / PerPage;
      this->Pages.discardBelow(this->FirstPage);
      this->Page = -1;
    }
  }

private:
  static constexpr std::int64_t PerPage = PageFile::PageBytes / sizeof(T);

  T* visit(std::int64_t i, bool change)
  {
    const std::int64_t page = i / PerPage;
    if (page != this->Page || (change && !this->Changing))
    {
      this->Values = reinterpret_cast<T*>(this->Pages.page(page, change));
      this->Page = page;
      this->Changing = change;
    }
    return this->Values + i % PerPage;
  }

  PageFile Pages;
  std::int64_t FirstPage = 0;
  std::int64_t Page = -1; ///< the last accessed page
  bool Changing = false;  ///< whether it was accessed for modification
  T* Values = nullptr;
};

} // namespace smg
