// SPDX-License-Identifier: BSD-3-Clause
/**
 * Declares the properties of the filters, readers and writers of this library, each in a line: Set
 * and Get, of flags also On and Off, of names Add, RemoveAll and GetNumberOf. VTK's wrappers expand
 * these macros; a comment before one is the docstring of Set.
 */
#ifndef StreamingMeshProperties_h
#define StreamingMeshProperties_h

#include "vtkSetGet.h"
#include "vtkStreamingMultigridIOModule.h" // For export macro

#include <string> // For std::string
#include <vector> // For std::vector

class vtkObject;

namespace smg
{

class JobProperties;

// Set a member, or an option of the job, of a filter, which is modified if that is another value.
VTKSTREAMINGMULTIGRIDIO_EXPORT void setText(
  vtkObject& filter, std::string& member, const char* text);
VTKSTREAMINGMULTIGRIDIO_EXPORT void setOption(
  vtkObject& filter, JobProperties& options, const char* property, double number);
VTKSTREAMINGMULTIGRIDIO_EXPORT void setOption(
  vtkObject& filter, JobProperties& options, const char* property, const char* text);
VTKSTREAMINGMULTIGRIDIO_EXPORT void addName(
  vtkObject& filter, std::vector<std::string>& names, const char* name);
VTKSTREAMINGMULTIGRIDIO_EXPORT void removeNames(vtkObject& filter, std::vector<std::string>& names);

// What Get returns: null for an empty text, or for no such number.
VTKSTREAMINGMULTIGRIDIO_EXPORT const char* textOf(const std::string& member);
VTKSTREAMINGMULTIGRIDIO_EXPORT const char* textOf(
  const JobProperties& options, const char* property);
VTKSTREAMINGMULTIGRIDIO_EXPORT double numberOf(const JobProperties& options, const char* property);
VTKSTREAMINGMULTIGRIDIO_EXPORT const char* nameOf(
  const std::vector<std::string>& names, int number);

/** What PrintSelf() prints. */
inline const char* textOrNone(const std::string& member)
{
  return member.empty() ? "(none)" : member.c_str();
}

} // namespace smg

// Properties that the class keeps in a member of this name, of names in one with an s.

#define smgProperty(Name, Type)                                                                    \
  vtkSetMacro(Name, Type);                                                                         \
  vtkGetMacro(Name, Type)
#define smgFlagProperty(Name)                                                                      \
  smgProperty(Name, bool);                                                                         \
  vtkBooleanMacro(Name, bool)
#define smgTextProperty(Name)                                                                      \
  virtual void Set##Name(const char* text)                                                         \
  {                                                                                                \
    smg::setText(*this, this->Name, text);                                                         \
  }                                                                                                \
  virtual const char* Get##Name()                                                                  \
  {                                                                                                \
    return smg::textOf(this->Name);                                                                \
  }
#define smgFileProperty(Name)                                                                      \
  virtual void Set##Name(VTK_FILEPATH const char* path)                                            \
  {                                                                                                \
    smg::setText(*this, this->Name, path);                                                         \
  }                                                                                                \
  virtual VTK_FILEPATH const char* Get##Name()                                                     \
  {                                                                                                \
    return smg::textOf(this->Name);                                                                \
  }
#define smgNamesProperty(Name)                                                                     \
  virtual void Add##Name(const char* name)                                                         \
  {                                                                                                \
    smg::addName(*this, this->Name##s, name);                                                      \
  }                                                                                                \
  virtual void RemoveAll##Name##s()                                                                \
  {                                                                                                \
    smg::removeNames(*this, this->Name##s);                                                        \
  }                                                                                                \
  virtual int GetNumberOf##Name##s()                                                               \
  {                                                                                                \
    return static_cast<int>(this->Name##s.size());                                                 \
  }                                                                                                \
  virtual const char* Get##Name(int number)                                                        \
  {                                                                                                \
    return smg::nameOf(this->Name##s, number);                                                     \
  }

// Options of the job of a filter, which it keeps in `Options`: their defaults and ranges are those
// of the table of the job.

#define smgOption(Name, Type)                                                                      \
  virtual void Set##Name(Type value)                                                               \
  {                                                                                                \
    smg::setOption(*this, *this->Options, #Name, static_cast<double>(value));                      \
  }                                                                                                \
  virtual Type Get##Name()                                                                         \
  {                                                                                                \
    return static_cast<Type>(smg::numberOf(*this->Options, #Name));                                \
  }
#define smgFlagOption(Name)                                                                        \
  virtual void Set##Name(bool on)                                                                  \
  {                                                                                                \
    smg::setOption(*this, *this->Options, #Name, on ? 1.0 : 0.0);                                  \
  }                                                                                                \
  virtual bool Get##Name()                                                                         \
  {                                                                                                \
    return smg::numberOf(*this->Options, #Name) != 0.0;                                            \
  }                                                                                                \
  vtkBooleanMacro(Name, bool)
#define smgTextOption(Name)                                                                        \
  virtual void Set##Name(const char* text)                                                         \
  {                                                                                                \
    smg::setOption(*this, *this->Options, #Name, text);                                            \
  }                                                                                                \
  virtual const char* Get##Name()                                                                  \
  {                                                                                                \
    return smg::textOf(*this->Options, #Name);                                                     \
  }

#endif
