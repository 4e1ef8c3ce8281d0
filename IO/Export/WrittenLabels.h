// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Export/GroupElements.h"
#include "IO/Export/MeshFileWriter.h"
#include "IO/Export/PlacedColumns.h"
#include "IO/Files/TextOutput.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <string_view>
#include <vector>

namespace smg
{

/** The label, an integer, that a format has for each vertex or cell: that of a column or, if the
 * mesh has no such column, the number of its first group. */
class WrittenLabels
{
public:
  /** `kind`: vertices or cells; `names`: of columns that are labels, of which the first one is
   * taken. The columns count as placed. */
  WrittenLabels(PlacedColumns& columns, const MeshFileInfo& info, GroupOf kind,
    std::initializer_list<std::string_view> names);

  /** Groups that the format holds otherwise. */
  void leaveTo(std::function<bool(const Group&)> isElsewhere)
  {
    this->IsElsewhere = std::move(isElsewhere);
  }

  /** Whether there are labels. */
  bool exist() const { return this->Label >= 0 || this->areGroups(); }
  /** Whether they are numbers of groups. */
  bool areGroups() const { return this->Label < 0 && this->Sets >= 0; }
  GroupOf kind() const { return this->Kind; }
  /** Vertices or cells whose further groups had no place. */
  std::int64_t inSeveral() const { return this->InSeveral; }

  /** Writes a blank and the label of a vertex or element; without labels `otherwise`. */
  void write(TextOutput& out, const std::vector<Column>& columns, std::size_t tuple,
    std::string_view otherwise = "");

private:
  std::shared_ptr<const GroupElements> Groups;
  GroupOf Kind;
  std::ptrdiff_t Label, Sets; ///< columns; -1: there is none
  std::function<bool(const Group&)> IsElsewhere;
  std::int64_t InSeveral = 0;
};

/** Notes on what labels do not tell of the groups: names, further groups, groups beside a column of
 * labels. `isElsewhere`: see WrittenLabels::leaveTo(). Facets count as written with their numbers.
 */
void noteLabels(const MeshFileInfo& info, std::initializer_list<const WrittenLabels*> labels,
  const std::function<bool(const Group&)>& isElsewhere, WriteNotes& notes);

} // namespace smg
