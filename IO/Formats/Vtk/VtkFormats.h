// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Format.h"
#include "smg/Column.h"

namespace smg
{

MeshFileFunction makeLegacyVtkWriter, makeVtkXmlWriter;
/** A name as one word of a legacy file, in VTK's encoding. */
std::string encodedVtkName(const std::string& name);
/** The lines of a legacy file that have the groups, as a text of its field data; empty: there are
 * none. */
std::string legacyGroups(const MeshGroups& groups, bool asText);
/** Of legacy files as text. */
MeshFileFunction makeTextVtkWriter;
std::int64_t scratchOfTextVtk(const StreamInfo& mesh, std::int64_t memory, bool text);
std::int64_t bytesOfTextVtk(const StreamInfo& mesh);
std::int64_t bytesOfVtk(const MeshToWrite& written);
std::int64_t bytesOfVtkXml(const MeshToWrite& written);

/** The columns of vertices, or of cells, in a legacy file: those that are active, which the file
 * marks as such, behind the others, which are its field data. */
class LegacyColumns
{
public:
  LegacyColumns(const std::vector<ColumnSpec>& specs, bool ofVertices);

  /** The numbers of the columns, in the order of the file. */
  const std::vector<std::size_t>& order() const { return this->Order; }
  /** The lines before the values of a column. */
  std::string linesBefore(std::size_t column, std::int64_t tuples) const;

private:
  /** The keyword of an active column; empty: it is field data. */
  std::string keywordOf(const ColumnSpec& spec) const;

  const std::vector<ColumnSpec>& Specs;
  bool OfVertices;
  std::vector<std::size_t> Order;
};

} // namespace smg
