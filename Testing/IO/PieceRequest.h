// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Vtk/Failures.h"
#include "IO/Vtk/PropertyNames.h"

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <string>

namespace smg::testing
{

/** Collects the errors of an algorithm and of its executive instead of printing them. */
class Errors
{
public:
  explicit Errors(vtkAlgorithm* algorithm)
    : Algorithm(algorithm)
  {
    this->watch(algorithm);
  }
  ~Errors() { this->Command->SetCallback(nullptr); }
  Errors(const Errors&) = delete;
  Errors& operator=(const Errors&) = delete;

  void watch(vtkAlgorithm* algorithm)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback([](vtkObject*, unsigned long, void* self, void* text)
      { static_cast<Errors*>(self)->Text += static_cast<const char*>(text); });
    algorithm->AddObserver(vtkCommand::ErrorEvent, this->Command);
    algorithm->AddObserver(vtkCommand::WarningEvent, this->Command);
    algorithm->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this->Command);
  }

  /** Whether these words are among them, in which properties have the names of C++. */
  bool contain(const std::string& words) const
  {
    return this->Text.find(words) != std::string::npos ||
           this->Text.find(withProperties(words, *this->Algorithm)) != std::string::npos;
  }
  const std::string& text() const { return this->Text; }
  void clear() { this->Text.clear(); }

private:
  vtkAlgorithm* Algorithm;
  vtkNew<vtkCallbackCommand> Command;
  std::string Text;
};

/** Requests a piece with layers of ghost cells; returns 0 if it could not be made. */
inline int updateWithGhosts(vtkAlgorithm* algorithm, int piece, int pieces, int ghostLevels)
{
  auto* executive = vtkStreamingDemandDrivenPipeline::SafeDownCast(algorithm->GetExecutive());
  vtkNew<vtkInformation> request;
  request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), piece);
  request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), pieces);
  request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), ghostLevels);
  vtkNew<vtkInformationVector> requests;
  requests->Append(request);
  return executive->Update(0, requests) && !isFailed(algorithm->GetOutputDataObject(0));
}

/** Requests a piece without them. */
inline int updatePiece(vtkAlgorithm* algorithm, int piece, int pieces)
{
  return updateWithGhosts(algorithm, piece, pieces, 0);
}

} // namespace smg::testing
