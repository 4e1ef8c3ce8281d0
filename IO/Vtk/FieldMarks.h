// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkStreamingMultigridIOModule.h"

class vtkAbstractArray;
class vtkDataObject;

namespace smg
{

/** Adds an array to the field data of a data set, where filters pass it on. The lists of arrays of
 * ParaView, such as that of colours, do not offer it. */
VTKSTREAMINGMULTIGRIDIO_EXPORT void addFieldArray(vtkDataObject& data, vtkAbstractArray& array);

/** Adds a mark, a field array of one tuple of ones, which the plugin knows by its name; a client
 * that has not loaded the plugin by its unusual number of components: see BigMeshWriter.xml. */
void addMark(vtkDataObject& data, const char* name, int components);

/** Hides an array from the lists of arrays of ParaView. */
void hide(vtkAbstractArray& array);

} // namespace smg
