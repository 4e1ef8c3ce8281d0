// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/InlineArray.h"

#include "IO/Formats/Vtk/VtkXml.h"

namespace smg
{

InlineArray::InlineArray(ColumnSpec spec, std::int64_t tuples)
  : Spec(std::move(spec))
  , Bytes(tuples * static_cast<std::int64_t>(this->Spec.tupleBytes()))
{
}

std::string InlineArray::tag() const
{
  return "<DataArray type=\"" + vtkXmlTypeName(this->Spec.type) + "\" Name=\"" +
         xmlEscaped(this->Spec.name) + "\" NumberOfComponents=\"" +
         std::to_string(this->Spec.components) + "\" format=\"binary\">\n";
}

std::int64_t InlineArray::begin(PositionedFile& file, std::int64_t at)
{
  const auto bytes = static_cast<std::uint64_t>(this->Bytes);
  this->At = at;
  this->append(file, std::as_bytes(std::span(&bytes, 1)));
  this->finish(file);
  return this->At + Base64Encoder::encodedSize(this->Bytes);
}

void InlineArray::append(PositionedFile& file, std::span<const std::byte> bytes)
{
  std::string text;
  this->Encoder.append(bytes, text);
  this->write(file, text);
}

void InlineArray::finish(PositionedFile& file)
{
  std::string text;
  this->Encoder.finish(text);
  this->write(file, text);
}

void InlineArray::write(PositionedFile& file, const std::string& text)
{
  file.write(this->At, std::as_bytes(std::span(text)));
  this->At += static_cast<std::int64_t>(text.size());
}

} // namespace smg
