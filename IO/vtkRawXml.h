// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkRawXml_h
#define vtkRawXml_h

#include "IO/vtkReaderComplaints.h"

#include <filesystem>

class vtkDataObject;

namespace smg
{

/**
 * Writes the mesh with VTK's `Writer` of .vtp or .vtu files in a form that can be parsed as a
 * stream: raw appended data without compression. Returns whether it succeeded; error messages are
 * in `complaints`.
 */
template <class Writer>
bool writeRawXml(
  vtkDataObject& mesh, const std::filesystem::path& path, vtkReaderComplaints& complaints)
{
  vtkNew<Writer> writer;
  writer->AddObserver(vtkCommand::ErrorEvent, complaints.command());
  writer->SetFileName(path.c_str());
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToNone();
  writer->SetHeaderTypeToUInt64();
  writer->SetInputData(&mesh);
  writer->Write();
  return writer->GetErrorCode() == 0 && complaints.text().empty();
}

} // namespace smg

#endif
