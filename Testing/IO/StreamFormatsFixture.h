// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Streams/StreamConversion.h"
#include "Testing/IO/MeshText.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/StreamMesh.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/VsmReader.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace smg::testing
{

inline std::string readFile(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

/** The folder of the tests and the operations in it. */
class StreamFormats : public ::testing::Test
{
protected:
  std::filesystem::path write(const std::string& name, const std::string& content)
  {
    writeBytes(this->Folder / name, content);
    return this->Folder / name;
  }

  /** Converts a file and returns the result. */
  StreamMesh convert(const std::filesystem::path& path, const StreamToVsmOptions& options = {})
  {
    this->Result = streamToVsm(path, this->Folder / "out.vsm", options);
    return collect(*VsmReader(this->Folder / "out.vsm").source());
  }

  /** The message that rejects a file with this content. */
  std::string refusal(const std::string& name, const std::string& content)
  {
    const std::filesystem::path path = this->write(name, content);
    std::filesystem::remove(this->Folder / "out.vsm");
    const std::string message = messageOf([&] { streamToVsm(path, this->Folder / "out.vsm"); });
    if (!message.empty())
    {
      EXPECT_EQ(message.find(path.string()), 0U) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      EXPECT_FALSE(std::filesystem::exists(this->Folder / "out.vsm"));
    }
    return message;
  }

  void expectRefusal(const std::string& name, const std::string& content, const std::string& part)
  {
    const std::string message = this->refusal(name, content);
    EXPECT_NE(message.find(part), std::string::npos)
      << "got '" << message << "' instead of '" << part << "'";
  }

  TemporaryFolder Folder;
  StreamToVsmResult Result;
};

} // namespace smg::testing
