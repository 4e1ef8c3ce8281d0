// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStreamingMeshKeys
 * @brief   Pipeline keys by which streaming filters and readers understand each other
 *
 * A reader of gigantic meshes answers a request for too large a piece with a preview, so that a
 * view never loads such a mesh by accident. A filter that pulls its input piece by piece is no
 * accident: it says so by setting STREAMED() to the number of pieces it asks for.
 *
 * Pieces have only points that cells use. STREAM_FILE() says where the others are, and PREVIEWED()
 * that the whole is a preview, through all filters that come after the reader, also those that keep
 * none of its arrays.
 *
 * The executive keeps request keys where they were last set. Therefore STREAMED() counts only if
 * its value equals UPDATE_NUMBER_OF_PIECES() of the same request: see IsStreamed().
 *
 * @sa vtkStreamingMeshReader vtkStreamingMeshWriter
 */
#ifndef vtkStreamingMeshKeys_h
#define vtkStreamingMeshKeys_h

#include "vtkObject.h"
#include "vtkStreamingMultigridIOModule.h" // For export macro

class vtkInformation;
class vtkInformationIntegerKey;
class vtkInformationIntegerRequestKey;
class vtkInformationStringKey;

class VTKSTREAMINGMULTIGRIDIO_EXPORT vtkStreamingMeshKeys : public vtkObject
{
public:
  static vtkStreamingMeshKeys* New();
  vtkTypeMacro(vtkStreamingMeshKeys, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Request key: the consumer streams through this many pieces and wants the real ones, whatever
   * their size. 0: it does not.
   */
  static vtkInformationIntegerRequestKey* STREAMED();

  /** The value of STREAMED() that a data object was made for, in its information. */
  static vtkInformationIntegerKey* STREAMED_DATA();

  /**
   * Pipeline information: the .vsm file that the pieces come from, if it has points that no cell
   * uses, which no piece has; else empty.
   */
  static vtkInformationStringKey* STREAM_FILE();

  /** Pipeline information: 1 if who asks for the whole, not streamed, gets a preview; else 0. */
  static vtkInformationIntegerKey* PREVIEWED();

  /** Whether the request in the pipeline information `info` comes from a streaming consumer. */
  static bool IsStreamed(vtkInformation* info);

protected:
  vtkStreamingMeshKeys() = default;
  ~vtkStreamingMeshKeys() override = default;

private:
  vtkStreamingMeshKeys(const vtkStreamingMeshKeys&) = delete;
  void operator=(const vtkStreamingMeshKeys&) = delete;
};

#endif
