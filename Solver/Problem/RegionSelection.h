// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/Selection.h"

#include <vector>

namespace smg
{

/** The vertices in a region. */
class RegionSelection : public Selection
{
public:
  RegionSelection(
    const Region& region, DataPlace place, const std::string& key, MeshColumns& columns);

  void prepare(const MeshBlock& block, const std::filesystem::path& scratch) override;
  void endPreparing(MeshParts* parts) override;

protected:
  void select(const MeshBlock& block, std::span<std::uint8_t> selected) override;
  std::string predicate() const override { return "is in this region"; }

private:
  Region Selected;
  std::vector<std::int64_t> Found; ///< how often the mesh has each vertex of the region
};

} // namespace smg
