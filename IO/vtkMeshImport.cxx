// SPDX-License-Identifier: BSD-3-Clause
#include "IO/vtkMeshImport.h"

#include "IO/Files/InputFile.h"
#include "IO/Formats/Vtk/RecodedImport.h"
#include "IO/Formats/Vtk/XmlTags.h"
#include "IO/vtkRawXml.h"
#include "Solver/Core/Error.h"

#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <exception>
#include <string>

namespace smg
{

namespace
{

/** What to do where Expat, which parses XML for VTK, no longer lets it skip appended data. */
std::string advice(const std::string& complaint)
{
  return complaint.find("not well-formed") != std::string::npos
           ? "; unless the file is damaged, this VTK cannot read <AppendedData> with the installed "
             "version of Expat (libexpat1): save the file elsewhere without compression"
           : "";
}

template <class Reader, class Writer>
void recode(const std::filesystem::path& from, const std::filesystem::path& to)
{
  vtkNew<Reader> reader;
  vtkReaderComplaints complaints;
  reader->AddObserver(vtkCommand::ErrorEvent, complaints.command());
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, complaints.command());
  reader->SetReaderErrorObserver(complaints.command());
  reader->SetParserErrorObserver(complaints.command());
  reader->SetFileName(from.c_str());
  bool isRecoded = false;
  try
  {
    reader->Update();
    // What the reader has complained of is not a mesh to be written.
    isRecoded = complaints.text().empty() && reader->GetErrorCode() == 0 &&
                writeRawXml<Writer>(*reader->GetOutput(), to, complaints);
  }
  catch (const std::exception& exception)
  {
    // A wrong count in the file ends in an allocation that fails.
    throw Error(from.string() + ": VTK cannot read the file (" + exception.what() +
                "): it is damaged, or too large for the memory.");
  }
  if (!isRecoded)
  {
    throw Error(from.string() + ": VTK cannot read the file, or not write it elsewhere: " +
                (complaints.text().empty() ? "unknown error" : complaints.text()) +
                advice(complaints.text()) + '.');
  }
}

} // namespace

void recodeVtkFile(const std::filesystem::path& from, const std::filesystem::path& to)
{
  InputFile file(from);
  XmlTags tags(file);
  XmlTag root;
  const bool isPolyData = tags.next(root) && root.value("type") == "PolyData";
  isPolyData ? recode<vtkXMLPolyDataReader, vtkXMLPolyDataWriter>(from, to)
             : recode<vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter>(from, to);
}

void registerVtkImporter()
{
  setVtkImporter([](const std::filesystem::path& path, VtkXmlKind kind, RawMeshBuilder& builder,
                   const ProgressFunction& progress)
    { importRecoded(recodeVtkFile, path, kind, builder, progress); });
}

} // namespace smg
