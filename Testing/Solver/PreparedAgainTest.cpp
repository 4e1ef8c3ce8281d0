// SPDX-License-Identifier: BSD-3-Clause
#include "smg/DescribedProblem.h"

#include "Testing/Support/DescribedMesh.h"
#include "Testing/Support/ErrorMessage.h"

#include <gtest/gtest.h>

#include <vector>

namespace smg::testing
{
namespace
{

/** Every way to name a part of the mesh. */
std::vector<Where> everyPart()
{
  return { ColumnTag{ "tag", 3 }, ColumnMask{ "mask" }, ColumnMask{ "cellMask" },
    NearestVertices{ { { 0.1, 0.2, 0.3 }, { 1.0, 1.0, 1.0 } } }, OnBoundary{},
    Region::Sphere{ {}, 1.0 }, Region::Vertices{ { 3, 7 } } };
}

ProblemDescription descriptionOf(const Where& where)
{
  ProblemDescription description;
  description.screening = 2.0;
  description.dirichlet = { { where, 1.0 } };
  return description;
}

/** A stream that ends in an error after some blocks. */
class BrokenSource : public MeshSource
{
public:
  explicit BrokenSource(MeshSource& source, int blocks)
    : Source(source)
    , Left(blocks)
  {
  }
  const StreamInfo& info() const override { return this->Source.info(); }
  bool next(MeshBlock& block) override
  {
    if (this->Left-- == 0)
    {
      throw Error("the disk is broken.");
    }
    return this->Source.next(block);
  }

private:
  MeshSource& Source;
  int Left;
};

} // namespace

TEST(PreparedAgain, AProblemIsTheSameHoweverOftenItIsPrepared)
{
  MemorySource source(describedMesh());
  for (const Where& where : everyPart())
  {
    std::vector<ProblemAnswers> answers;
    for (const bool again : { false, true })
    {
      DescribedProblem problem(descriptionOf(where), source.info());
      if (again)
      {
        source.rewind(3);
        problem.prepare(source);
        source.rewind(4);
        BrokenSource broken(source, 5);
        expectError([&] { problem.prepare(broken); }, "broken");
      }
      source.rewind(7);
      problem.prepare(source);
      source.rewind(7);
      answers.push_back(answersOf(problem, source));
    }
    EXPECT_TRUE(answers[0] == answers[1]) << where.index();
  }
}

TEST(PreparedAgain, WhatWasPreparedInPartIsNotUsed)
{
  MemorySource source(describedMesh());
  for (const Where& where :
    { Where(ColumnTag{ "tag", 3 }), Where(OnBoundary{}), Where(NearestVertices{ { {} } }) })
  {
    DescribedProblem problem(descriptionOf(where), source.info());
    source.rewind(4);
    BrokenSource broken(source, 3);
    expectError([&] { problem.prepare(broken); }, "broken");
    source.rewind(4);
    expectError([&] { answersOf(problem, source); }, "call DescribedProblem::prepare()");
  }
}

} // namespace smg::testing
