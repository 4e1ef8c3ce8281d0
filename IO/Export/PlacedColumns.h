// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Export/MeshFileWriter.h"
#include "IO/Files/FileNames.h"
#include "IO/Mesh/Columns.h"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{

/** The columns of a mesh that a text format can hold. The others are left out, with a
 * note. */
class PlacedColumns
{
public:
  PlacedColumns(
    const std::vector<ColumnSpec>& ofVertices, const std::vector<ColumnSpec>& ofElements)
    : OfVertices(ofVertices)
    , OfElements(ofElements)
  {
  }
  explicit PlacedColumns(const MeshFileInfo& info)
    : PlacedColumns(info.vertexColumns, info.elementColumns)
  {
  }
  explicit PlacedColumns(const StreamInfo& mesh)
    : PlacedColumns(mesh.vertexColumns, mesh.cellColumns)
  {
  }

  // The index of the column with this name and number of components; -1 if there is none.
  std::ptrdiff_t ofVertices(std::string_view name, int least, int most)
  {
    return this->OfVertices.place(name, least, most, Numbers::Any);
  }
  std::ptrdiff_t ofElements(std::string_view name, int least, int most)
  {
    return this->OfElements.place(name, least, most, Numbers::Any);
  }
  // The index of the colours: bytes, or shares of 1, of three or four components.
  std::ptrdiff_t colorsOfVertices()
  {
    return this->OfVertices.place(ColorsName, 3, 4, Numbers::Colors);
  }
  std::ptrdiff_t colorsOfElements()
  {
    return this->OfElements.place(ColorsName, 3, 4, Numbers::Colors);
  }
  // The index of the first of these columns with one integer per tuple, since the names of labels
  // differ between formats.
  std::ptrdiff_t integerOfVertices(std::initializer_list<std::string_view> names)
  {
    return this->OfVertices.firstInteger(names);
  }
  std::ptrdiff_t integerOfElements(std::initializer_list<std::string_view> names)
  {
    return this->OfElements.firstInteger(names);
  }

  // The indices of all columns that were not asked for, of at most so many components.
  std::vector<std::size_t> othersOfVertices(int most) { return this->OfVertices.takeOthers(most); }
  std::vector<std::size_t> othersOfElements(int most) { return this->OfElements.takeOthers(most); }

  /** A note for the user on the columns that were not asked for. */
  std::vector<std::string> leftOut(std::string_view suffix) const
  {
    const std::string names =
      this->OfVertices.others("vertex", this->OfElements.others("cell", {}));
    if (names.empty())
    {
      return {};
    }
    return { "These columns are left out, since " + std::string(suffix) +
             " files have no place for them: " + names + '.' };
  }

private:
  enum class Numbers
  {
    Any,
    Integers,
    Colors
  };

  struct Places
  {
    explicit Places(const std::vector<ColumnSpec>& columns)
      : Specs(columns)
      , Taken(columns.size(), false)
    {
    }

    std::ptrdiff_t place(std::string_view name, int least, int most, Numbers numbers)
    {
      const auto found = std::ranges::find_if(this->Specs,
        [&](const ColumnSpec& spec)
        {
          const bool isReal = spec.type == ScalarType::Float32 || spec.type == ScalarType::Float64;
          const bool isAllowed = numbers == Numbers::Integers ? !isReal
                                 : numbers == Numbers::Colors
                                   ? isReal || spec.type == ScalarType::UInt8
                                   : true;
          return spec.name == name && spec.components >= least && spec.components <= most &&
                 isAllowed;
        });
      if (found == this->Specs.end())
      {
        return -1;
      }
      const std::ptrdiff_t place = found - this->Specs.begin();
      this->Taken[static_cast<std::size_t>(place)] = true;
      return place;
    }

    std::ptrdiff_t firstInteger(std::initializer_list<std::string_view> names)
    {
      std::ptrdiff_t found = -1;
      for (const std::string_view* name = names.begin(); name != names.end() && found < 0; ++name)
      {
        found = this->place(*name, 1, 1, Numbers::Integers);
      }
      return found;
    }

    std::vector<std::size_t> takeOthers(int most)
    {
      std::vector<std::size_t> others;
      for (std::size_t i = 0; i < this->Specs.size(); ++i)
      {
        if (!this->Taken[i] && this->Specs[i].components <= most)
        {
          this->Taken[i] = true;
          others.push_back(i);
        }
      }
      return others;
    }

    /** The names of the others, before the given ones. */
    std::string others(const std::string& owner, std::string names) const
    {
      for (std::size_t i = this->Specs.size(); i-- > 0;)
      {
        if (!this->Taken[i])
        {
          names = owner + ' ' + inQuotes(this->Specs[i].name) + (names.empty() ? "" : ", ") + names;
        }
      }
      return names;
    }

    std::vector<ColumnSpec> Specs;
    std::vector<bool> Taken;
  };

  Places OfVertices, OfElements;
};

} // namespace smg
