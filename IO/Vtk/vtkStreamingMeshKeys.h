// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStreamingMeshKeys
 * @brief   Pipeline keys for the communication of streaming filters and readers
 *
 * A reader of very large meshes returns a preview if the requested piece is too large, so that a
 * view never loads such a mesh by accident. A filter that requests its input piece by piece sets
 * STREAMED() to the number of pieces to receive the real ones.
 *
 * STREAM_FILE() names the file of the pieces, which has the counts of the whole mesh, and the
 * points that no cell uses and no piece contains. PREVIEWED() states that the whole mesh is shown
 * as a preview, downstream of all filters after the reader, including those that keep none of its
 * arrays.
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
class vtkInformationVariantKey;

class VTKSTREAMINGMULTIGRIDIO_EXPORT vtkStreamingMeshKeys : public vtkObject
{
public:
  static vtkStreamingMeshKeys* New();
  vtkTypeMacro(vtkStreamingMeshKeys, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Request key: the consumer streams through this many pieces and requests the real ones of any
   * size. 0: it does not stream. */
  static vtkInformationIntegerRequestKey* STREAMED();

  /** The value of STREAMED() of the request for a data object, in its information. */
  static vtkInformationIntegerKey* STREAMED_DATA();

  /** Pipeline information: the .vsm file of the pieces. Absent if they are not those of a
   * vtkStreamingMeshReader. Without PREVIEWED() the file is not there yet: the reader makes it when
   * data are requested. */
  static vtkInformationStringKey* STREAM_FILE();

  /** Pipeline information: what names the content of STREAM_FILE()
   * (smg::StoredMesh::fingerprint()), which whoever opens that compares. Absent if it is another
   * one at each time step. */
  static vtkInformationStringKey* STREAM_FINGERPRINT();

  /** Pipeline information: 1 if a request for the whole that is not streamed returns a preview,
   * else 0. */
  static vtkInformationIntegerKey* PREVIEWED();

  /** Information of an algorithm whose last execution was aborted. */
  static vtkInformationIntegerKey* CANCELLED();

  /** Information of a point array: the value of each component at points that no cell uses. Writers
   * of VTK's XML files leave out keys of variants. */
  static vtkInformationVariantKey* ISOLATED_VALUE();

  /** Information of the mask of handles: the name of the active scalars that it has taken the place
   * of. */
  static vtkInformationVariantKey* FORMER_SCALARS();

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
