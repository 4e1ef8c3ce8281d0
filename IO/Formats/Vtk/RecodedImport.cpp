// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/RecodedImport.h"

#include "IO/Files/InputFile.h"
#include "IO/Formats/Vtk/VtkFormats.h"
#include "IO/Formats/Vtk/VtkXml.h"
#include "IO/Formats/Vtk/VtkXmlPieces.h"
#include "IO/Raw/RawMeshBuilder.h"

#include <cstddef>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

namespace smg
{

namespace
{

/** A folder that is removed with its files. */
class RecodedFiles
{
public:
  explicit RecodedFiles(const std::filesystem::path& parent)
    : Folder(parent / "recoded")
  {
    std::filesystem::create_directory(this->Folder);
  }
  ~RecodedFiles()
  {
    std::error_code ignored;
    std::filesystem::remove_all(this->Folder, ignored);
  }
  RecodedFiles(const RecodedFiles&) = delete;
  RecodedFiles& operator=(const RecodedFiles&) = delete;

  std::filesystem::path file(std::size_t i) const
  {
    return this->Folder / (std::to_string(i) + ".vtx");
  }
  std::filesystem::path summary() const { return this->Folder / "pieces.pvtx"; }

private:
  std::filesystem::path Folder;
};

/** Writes a file that names the pieces, of which it does not matter what they hold. */
void writeSummary(const RecodedFiles& files, std::size_t count)
{
  std::ofstream stream(files.summary());
  stream << "<VTKFile type=\"PUnstructuredGrid\">\n<PUnstructuredGrid>\n";
  for (std::size_t i = 0; i < count; ++i)
  {
    stream << "<Piece Source=\"" << xmlEscaped(files.file(i).string()) << "\"/>\n";
  }
  stream << "</PUnstructuredGrid>\n</VTKFile>\n";
}

} // namespace

void importRecoded(const VtkRecoder& recode, const std::filesystem::path& path, VtkXmlKind kind,
  RawMeshBuilder& builder, const ProgressFunction& progress)
{
  const RecodedFiles files(builder.workspace().folder());
  if (kind == VtkXmlKind::Whole)
  {
    recode(path, files.file(0));
    InputFile file(files.file(0), progress, path.string());
    importVtkXml(file, builder, progress);
    return;
  }
  InputFile summary(path);
  const std::vector<std::filesystem::path> pieces = vtkXmlPieceFiles(summary);
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    recode(pieces[i], files.file(i));
  }
  writeSummary(files, pieces.size());
  InputFile file(files.summary(), {}, path.string());
  importParallelVtkXml(file, builder, progress);
}

} // namespace smg
