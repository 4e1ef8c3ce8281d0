// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/PieceInput.h"

#include "IO/Vtk/Failures.h"
#include "IO/Vtk/SingleBlock.h"
#include "IO/Vtk/vtkStreamingMeshKeys.h"
#include "smg/Error.h"
#include "smg/VsmReader.h"

#include "vtkAlgorithm.h"
#include "vtkAlgorithmOutput.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationIntegerRequestKey.h"
#include "vtkInformationStringKey.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <exception>
#include <string_view>
#include <utility>
#include <vector>

namespace smg
{
namespace
{

/** ParaView adds filters of the first class after every one of the user, our writer of the second.
 */
bool isAdded(vtkAlgorithm& filter)
{
  return filter.IsA("vtkPVPostFilter") || filter.IsA("vtkChosenArrays");
}

/** The longest chain of filters of others that ends at `last`. Those of this library look at each
 * point and cell alone, or at the whole mesh, and pass on ghost cells; a simplified mesh has its
 * own. */
std::vector<vtkAlgorithm*> otherFilters(vtkAlgorithm& last)
{
  std::vector<vtkAlgorithm*> longest;
  bool hasInput = false;
  const bool isNewMesh = last.IsA("vtkStreamingMeshSimplification") != 0;
  for (int port = 0; !isNewMesh && port < last.GetNumberOfInputPorts(); ++port)
  {
    for (int k = 0; k < last.GetNumberOfInputConnections(port); ++k)
    {
      std::vector<vtkAlgorithm*> before = otherFilters(*last.GetInputAlgorithm(port, k));
      longest = before.size() > longest.size() ? std::move(before) : std::move(longest);
      hasInput = true;
    }
  }
  const bool isOfThisLibrary = last.IsA("vtkStreamingSolver") || last.IsA("vtkRegionFilter");
  if (hasInput && !isOfThisLibrary && !isAdded(last))
  {
    longest.push_back(&last);
  }
  return longest;
}

/** Whether the algorithm, or one before it, was aborted when it was executed last. */
bool wasCancelled(vtkAlgorithm& last)
{
  bool was = last.GetInformation()->Has(vtkStreamingMeshKeys::CANCELLED()) != 0;
  for (int port = 0; port < last.GetNumberOfInputPorts(); ++port)
  {
    for (int k = 0; k < last.GetNumberOfInputConnections(port); ++k)
    {
      was = was || wasCancelled(*last.GetInputAlgorithm(port, k));
    }
  }
  return was;
}

} // namespace

namespace
{

/** The filters whose names in ParaView are not those of their classes. */
constexpr std::pair<std::string_view, const char*> NamesInParaView[] = {
  { "vtkAppendPolyData", "Append Geometry" },
  { "vtkAppendFilter", "Append Datasets" },
  { "vtkGroupDataSetsFilter", "Group Datasets" },
  { "vtkCleanPolyData", "Clean" },
  { "vtkCleanUnstructuredGrid", "Clean to Grid" },
  { "vtkPVMetaClipDataSet", "Clip" },
  { "vtkPVMetaSliceDataSet", "Slice" },
  { "vtkPVArrayCalculator", "Calculator" },
  { "vtkPExtractHistogram", "Histogram" },
};

} // namespace

std::string nameInPipeline(vtkAlgorithm& filter)
{
  std::string words;
  const std::string name = filter.GetClassName();
  for (const auto& [className, inParaView] : NamesInParaView)
  {
    if (name == className)
    {
      return inParaView;
    }
  }
  const auto isCapitalAt = [&name](std::size_t k)
  { return k < name.size() && std::isupper(static_cast<unsigned char>(name[k])) != 0; };
  const std::string ofParaView = "vtkPV";
  const std::size_t begin = name.starts_with(ofParaView) && isCapitalAt(ofParaView.size())
                              ? ofParaView.size()
                            : name.starts_with("vtk") ? 3
                                                      : 0;
  for (std::size_t k = begin; k < name.size(); ++k)
  {
    const bool isCapital = isCapitalAt(k);
    const bool endsWord = !words.empty() && std::islower(static_cast<unsigned char>(name[k - 1]));
    words += isCapital && endsWord ? " " : "";
    words += name[k];
  }
  return words;
}

namespace
{

vtkAlgorithmOutput& connectionOf(vtkAlgorithm& consumer, int port)
{
  if (consumer.GetNumberOfInputConnections(port) < 1)
  {
    throw Error(nameInPipeline(consumer) + " has no input: connect a mesh to it.");
  }
  return *consumer.GetInputConnection(port, 0);
}

} // namespace

PieceInput::PieceInput(vtkAlgorithm& consumer, int port)
  : PieceInput(connectionOf(consumer, port))
{
}

PieceInput::PieceInput(vtkAlgorithmOutput& output)
  : Producer(output.GetProducer())
  , ProducerPort(output.GetIndex())
  , Executive(vtkStreamingDemandDrivenPipeline::SafeDownCast(Producer->GetExecutive()))
{
  if (!this->Executive)
  {
    throw Error("The executive of the input " + nameInPipeline(*this->Producer) +
                " cannot deliver pieces: use a vtkStreamingDemandDrivenPipeline.");
  }
}

/** Whoever has solved asks for what is shown next; whoever has failed leaves the last piece as the
 * output of all filters before, so that what these show is made again here. */
PieceInput::~PieceInput()
{
  if (!this->IsStreaming)
  {
    return;
  }
  this->Executive->GetOutputInformation(this->ProducerPort)
    ->Set(vtkStreamingMeshKeys::STREAMED(), 0);
  this->Executive->PropagateUpdateExtent(this->ProducerPort);
  if (std::uncaught_exceptions() > this->Exceptions && this->isPreviewed())
  {
    try
    {
      this->update(0, 1, false);
    }
    catch (...)
    {
      // The first error is the one to report; what is shown is made at the next update.
    }
  }
}

vtkDataObject* PieceInput::update(int piece, int pieces, bool streamed, int ghostLevels)
{
  if (this->Block)
  {
    return this->Block;
  }
  this->learnMesh();
  vtkNew<vtkInformationVector> requests;
  requests->SetNumberOfInformationObjects(this->Producer->GetNumberOfOutputPorts());
  vtkInformation* request = requests->GetInformationObject(this->ProducerPort);
  request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), piece);
  request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), pieces);
  request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), ghostLevels);
  request->Set(vtkStreamingMeshKeys::STREAMED(), streamed ? pieces : 0);
  this->IsStreaming = streamed;
  vtkDataObject* data = nullptr;
  if (this->Executive->Update(this->ProducerPort, requests))
  {
    data = this->Producer->GetOutputDataObject(this->ProducerPort);
  }
  if (!data && wasCancelled(*this->Producer))
  {
    throw InputCancelled(this->placeOfPiece(piece, pieces) + " was not made: it was aborted.");
  }
  if (!data || isFailed(data))
  {
    throw InputFailed(this->placeOfPiece(piece, pieces) +
                      " could not be made: see the error that " + this->producerName() +
                      " or the pipeline before it reported.");
  }
  if (data->IsA("vtkCompositeDataSet"))
  {
    if (piece > 0 || pieces > 1)
    {
      return this->update(0, 1, false);
    }
    this->Block = meshOf(data);
    return this->Block;
  }
  return data;
}

void PieceInput::release()
{
  if (this->isData())
  {
    return;
  }
  if (vtkDataObject* data = this->Producer->GetOutputDataObject(this->ProducerPort))
  {
    data->ReleaseData();
  }
}

bool PieceInput::isData() const
{
  return this->Block || this->Producer->IsA("vtkTrivialProducer");
}

std::filesystem::path PieceInput::streamFile() const
{
  return this->text(vtkStreamingMeshKeys::STREAM_FILE());
}

std::string PieceInput::streamFingerprint() const
{
  return this->text(vtkStreamingMeshKeys::STREAM_FINGERPRINT());
}

std::string PieceInput::text(vtkInformationStringKey* key) const
{
  const char* text =
    this->Block ? nullptr : this->Executive->GetOutputInformation(this->ProducerPort)->Get(key);
  return text ? text : "";
}

void PieceInput::learnMesh()
{
  this->Executive->UpdateInformation();
  vtkInformation* info = this->Executive->GetOutputInformation(this->ProducerPort);
  if (this->Block || !info->Has(vtkStreamingMeshKeys::STREAM_FILE()) ||
      info->Has(vtkStreamingMeshKeys::PREVIEWED()))
  {
    return;
  }
  if (!info->Has(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES()))
  {
    info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), 0);
    info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), 1);
    info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  }
  if (!this->Executive->PropagateUpdateExtent(this->ProducerPort))
  {
    throw InputFailed("The input could not be made: see the error that " + this->producerName() +
                      " or the pipeline before it reported.");
  }
  this->Executive->UpdateInformation();
}

std::optional<StreamInfo> PieceInput::meshInfo()
{
  this->learnMesh();
  const std::filesystem::path file = this->streamFile();
  std::error_code absent;
  if (file.empty() || !std::filesystem::exists(file, absent))
  {
    return {};
  }
  return VsmReader(file, nullptr, this->streamFingerprint()).info();
}

std::string PieceInput::placeOfPiece(int piece, int pieces) const
{
  if (pieces == 1)
  {
    return "The input";
  }
  return this->NamesPieces
           ? "Piece " + std::to_string(piece) + " of " + std::to_string(pieces) + " of the input"
           : "The input from " + this->producerName();
}

namespace
{

/** The output of a filter of the user that arrives at that of a filter. */
vtkAlgorithmOutput* outputOfUser(vtkAlgorithmOutput* output)
{
  while (isAdded(*output->GetProducer()) && output->GetProducer()->GetInputConnection(0, 0))
  {
    output = output->GetProducer()->GetInputConnection(0, 0);
  }
  return output;
}

} // namespace

bool PieceInput::isBesideMesh() const
{
  vtkAlgorithmOutput* output = outputOfUser(this->Producer->GetOutputPort(this->ProducerPort));
  return output->GetProducer()->IsA("vtkStreamingSolver") && output->GetIndex() > 0;
}

std::string PieceInput::producerName() const
{
  vtkAlgorithmOutput* output = this->Producer->GetOutputPort(this->ProducerPort);
  return nameInPipeline(*outputOfUser(output)->GetProducer());
}

bool PieceInput::isFiltered() const
{
  return !this->Block && !otherFilters(*this->Producer).empty();
}

int PieceInput::ghostLevels(int pieces) const
{
  return pieces > 1 && !this->Block ? static_cast<int>(otherFilters(*this->Producer).size()) : 0;
}

std::string PieceInput::noteOnBorders() const
{
  if (!this->Differs)
  {
    return {};
  }
  std::string between;
  for (vtkAlgorithm* filter : otherFilters(*this->Producer))
  {
    between += (between.empty() ? "" : ", ") + nameInPipeline(*filter);
  }
  return "the mesh comes in pieces through " + between +
         ", and two pieces differ at points that both have: what is computed of more than a piece "
         "and its neighbours, as smoothed positions, is wrong at the borders of pieces; raise "
         "Maximum Points In Memory of the reader, so that the mesh is one piece";
}

bool PieceInput::isInMemory() const
{
  vtkInformation* info = this->Executive->GetOutputInformation(this->ProducerPort);
  return this->Block || (info->Has(vtkStreamingMeshKeys::PREVIEWED()) && !this->isPreviewed());
}

namespace
{

/** Whether a reader or Streaming Mesh Preview above says so: other filters between may still have
 * the key of an earlier input. */
bool isPreviewedAt(vtkAlgorithm& producer, int port)
{
  vtkInformation* info = producer.GetExecutive()->GetOutputInformation(port);
  if (!info->Get(vtkStreamingMeshKeys::PREVIEWED()))
  {
    return false;
  }
  if (producer.IsA("vtkStreamingMeshPreview"))
  {
    return true;
  }
  bool hasInput = false;
  for (int in = 0; in < producer.GetNumberOfInputPorts(); ++in)
  {
    for (int k = 0; k < producer.GetNumberOfInputConnections(in); ++k)
    {
      vtkAlgorithmOutput* output = producer.GetInputConnection(in, k);
      hasInput = true;
      if (isPreviewedAt(*output->GetProducer(), output->GetIndex()))
      {
        return true;
      }
    }
  }
  return !hasInput;
}

} // namespace

bool PieceInput::isPreviewed() const
{
  return !this->Block && isPreviewedAt(*this->Producer, this->ProducerPort);
}

void PieceInput::requireWhole() const
{
  if (this->isPreviewed())
  {
    throw Error(
      "The input is made of a preview, by a filter that does not pass on what says so: put that "
      "filter (as Pass Arrays, or a Programmable Filter) behind this one, or raise Maximum "
      "Points In Memory of the reader.");
  }
}

unsigned long long PieceInput::modifiedTime()
{
  return this->Executive->GetPipelineMTime();
}

} // namespace smg
