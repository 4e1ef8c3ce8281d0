// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Arrays/AddedColumns.h"
#include "IO/Arrays/OriginalOrder.h"
#include "IO/Arrays/ReadColumn.h"
#include "IO/Formats/Vsm/WriteVsm.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/MemorySource.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Convert.h"
#include "smg/Describe.h"
#include "smg/VsmReader.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <vector>

namespace smg::testing
{
namespace
{

/** A mesh in a file, and the same with a column from an array. */
class FileFingerprint : public ::testing::Test
{
protected:
  FileFingerprint()
  {
    const StreamMesh mesh = toStream(grid(9, 7));
    this->write(mesh);
    this->Mesh = openMesh(this->Path);
    this->Order = std::make_shared<OriginalOrder>(*this->Mesh);
    this->Heat.resize(static_cast<std::size_t>(mesh.vertices()), 1.0);
  }

  void write(const StreamMesh& mesh) const
  {
    MemorySource source(mesh);
    writeVsm(source, this->Path);
  }

  std::shared_ptr<const AddedColumns> withHeat(std::shared_ptr<const StoredMesh> mesh) const
  {
    auto added = std::make_shared<AddedColumns>(std::move(mesh), this->Order);
    added->add(false, "heat",
      { this->Heat.data(), ScalarType::Float64, std::ssize(this->Heat), 1, sizeof(double),
        sizeof(double) });
    return added;
  }

  TemporaryFolder Folder;
  std::filesystem::path Path = this->Folder / "mesh.vsm";
  std::shared_ptr<const StoredMesh> Mesh;
  std::shared_ptr<const OriginalOrder> Order;
  std::vector<double> Heat;
};

TEST_F(FileFingerprint, IsThatOfTheFileWhateverTheMeshHasBesides)
{
  const auto added = this->withHeat(this->Mesh);
  const auto twice = this->withHeat(added);
  const std::string ofFile = VsmReader(this->Path).fingerprint();
  for (const std::shared_ptr<const StoredMesh>& mesh :
    std::initializer_list<std::shared_ptr<const StoredMesh>>{ this->Mesh, added, twice })
  {
    EXPECT_EQ(mesh->fileFingerprint(), ofFile);
    EXPECT_EQ(VsmReader(mesh->file(), nullptr, mesh->fileFingerprint()).info().cells,
      this->Mesh->info().cells);
  }
  EXPECT_EQ(this->Mesh->fingerprint(), ofFile);
  EXPECT_NE(added->fingerprint(), ofFile);
  EXPECT_NE(twice->fingerprint(), added->fingerprint());
  // All of a fingerprint is compared, not its beginning.
  expectError([&] { VsmReader(this->Path, nullptr, added->fingerprint()); }, "is another mesh");
  expectError([&] { VsmReader(this->Path, nullptr, ofFile + ' '); }, "is another mesh");
}

TEST_F(FileFingerprint, IsComparedByAllThatOpenTheFileAgain)
{
  const std::shared_ptr<const StoredMesh> meshes[] = { this->Mesh, this->withHeat(this->Mesh) };
  const std::function<void(const StoredMesh&)> uses[] = { [](const StoredMesh& mesh)
    { meshInfo(mesh); },
    [](const StoredMesh& mesh) { describe(mesh); },
    [](const StoredMesh& mesh) { OriginalOrder(mesh, nullptr); },
    [this](const StoredMesh& mesh)
    {
      std::vector<double> values(this->Heat.size() * 3);
      readColumn(mesh, *this->Order, nullptr, false, "Position",
        reinterpret_cast<std::byte*>(values.data()));
    } };
  for (const auto& mesh : meshes)
  {
    for (const auto& use : uses)
    {
      EXPECT_NO_THROW(use(*mesh));
    }
  }
  this->write(toStream(grid(7, 9)));
  for (const auto& mesh : meshes)
  {
    for (const auto& use : uses)
    {
      expectError([&] { use(*mesh); }, "mesh.vsm: is another mesh than before");
    }
  }
}

} // namespace
} // namespace smg::testing
