// SPDX-License-Identifier: BSD-3-Clause
// Progress rises from 0 to 1 between blocks of points, as feet are found and as they are evaluated;
// an abort leaves empty outputs and no harm.
#include "FilterTesting.h"

#include "vtkMultiBlockDataSet.h"
#include "vtkPointInversionFilter.h"
#include "vtkSplineEvaluator.h"
#include "vtkTable.h"

#include <algorithm>

using namespace testing;

namespace
{

/// Writes down the progress and aborts once it has passed a limit.
class ProgressWatcher : public vtkCommand
{
public:
  vtkTypeMacro(ProgressWatcher, vtkCommand);
  static ProgressWatcher* New() { return new ProgressWatcher; }

  void Execute(vtkObject* caller, unsigned long, void* data) override
  {
    const double progress = *static_cast<double*>(data);
    this->Steps.push_back(progress);
    if (progress > this->AbortAfter)
    {
      vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1);
    }
  }

  std::vector<double> Steps;
  double AbortAfter = 2.0;
};

void TestProgress(vtkDataObject* input, bool warm_start)
{
  vtkNew<vtkPointInversionFilter> filter;
  vtkNew<ProgressWatcher> watcher;
  filter->AddObserver(vtkCommand::ProgressEvent, watcher);
  filter->SetInputData(input);
  filter->SetSourceData(MakeTorus());
  filter->SetWarmStart(warm_start);
  filter->Update();
  CHECK(watcher->Steps.size() >= 4);
  CHECK(std::is_sorted(watcher->Steps.begin(), watcher->Steps.end()));
  CHECK(watcher->Steps.front() < 0.5);
  CHECK(watcher->Steps.back() == 1.0);
  CHECK(filter->GetFootPointsOutput()->GetNumberOfPoints() == 20000);

  watcher->AbortAfter = 0.2;
  watcher->Steps.clear();
  filter->Modified();
  filter->Update();
  // Some versions of VTK report 1 at the end of an abort, too.
  const auto late = [](double progress) { return progress > 0.9 && progress < 1.0; };
  CHECK(std::none_of(watcher->Steps.begin(), watcher->Steps.end(), late));
  // How many points there are between two steps is a matter of time; none follows the abort.
  const auto after = [](double progress) { return progress > 0.2 && progress < 1.0; };
  CHECK(std::count_if(watcher->Steps.begin(), watcher->Steps.end(), after) <= 1);
  CHECK(filter->GetFootPointsOutput()->GetNumberOfPoints() == 0);
  CHECK(filter->GetFaceStatisticsOutput()->GetNumberOfRows() == 0);
  CHECK(!filter->GetOutput()->GetFieldData()->HasArray("DistanceCount"));

  // Afterwards it works again, from the same model.
  watcher->AbortAfter = 2.0;
  filter->SetAbortExecute(0); // since VTK 9.2 the executive leaves that to the caller
  filter->Modified();
  filter->Update();
  CHECK(filter->GetFootPointsOutput()->GetNumberOfPoints() == 20000);
  CHECK(filter->GetNumberOfModelBuilds() == 1);
}

/// Aborts past a progress, of which nothing more is told then.
void AbortOnce(vtkAlgorithm* algorithm, ProgressWatcher* watcher, double limit)
{
  watcher->AbortAfter = limit;
  watcher->Steps.clear();
  algorithm->SetAbortExecute(0);
  algorithm->Modified();
  algorithm->Update();
  const auto after = [limit](double progress) { return progress > limit && progress < 1.0; };
  CHECK(std::count_if(watcher->Steps.begin(), watcher->Steps.end(), after) == 1);
}

/// Models of many faces take a while to be built: that is seen, and can be stopped.
void TestBuilding()
{
  vtkNew<vtkMultiBlockDataSet> many;
  for (unsigned int k = 0; k < 300; ++k)
  {
    many->SetBlock(k, MakeTorus());
  }
  const auto points = MakePoints(RandomPoints(100, 4.0));
  vtkNew<vtkPointInversionFilter> filter;
  vtkNew<ProgressWatcher> watcher;
  filter->AddObserver(vtkCommand::ProgressEvent, watcher);
  filter->SetInputData(points);
  filter->SetSourceData(many);
  for (const double limit : { 0.0, 0.1 })
  {
    AbortOnce(filter, watcher, limit);
    CHECK(filter->GetFootPointsOutput()->GetNumberOfPoints() == 0);
    CHECK(filter->GetNumberOfModelBuilds() == 0);
  }
  watcher->AbortAfter = 2.0;
  watcher->Steps.clear();
  filter->SetAbortExecute(0);
  filter->Modified();
  filter->Update();
  CHECK(std::is_sorted(watcher->Steps.begin(), watcher->Steps.end()));
  const auto building = [](double progress) { return progress > 0.0 && progress < 0.3; };
  CHECK(std::count_if(watcher->Steps.begin(), watcher->Steps.end(), building) >= 4);
  CHECK(filter->GetFootPointsOutput()->GetNumberOfPoints() == 100);
  CHECK(filter->GetNumberOfModelBuilds() == 1);
}

/// The inverse of point inversion does the same between blocks of rows.
void TestEvaluation()
{
  constexpr vtkIdType kRows = 200000;
  vtkNew<vtkDoubleArray> parameters;
  parameters->SetName("Parameters");
  parameters->SetNumberOfComponents(2);
  parameters->SetNumberOfTuples(kRows);
  parameters->Fill(0.25);
  vtkNew<vtkTable> table;
  table->AddColumn(parameters);
  vtkNew<vtkSplineEvaluator> evaluator;
  vtkNew<ProgressWatcher> watcher;
  evaluator->AddObserver(vtkCommand::ProgressEvent, watcher);
  evaluator->SetInputData(table);
  evaluator->SetSourceData(MakeTorus());
  for (const double limit : { 0.05, 0.5 })
  {
    AbortOnce(evaluator, watcher, limit);
    CHECK(evaluator->GetOutput()->GetNumberOfPoints() == 0);
    CHECK(evaluator->GetOutput()->GetFieldData()->GetNumberOfArrays() == 0);
  }
  watcher->AbortAfter = 2.0;
  watcher->Steps.clear();
  evaluator->SetAbortExecute(0);
  evaluator->Modified();
  evaluator->Update();
  CHECK(std::is_sorted(watcher->Steps.begin(), watcher->Steps.end()));
  CHECK(watcher->Steps.size() >= 4);
  CHECK(evaluator->GetOutput()->GetNumberOfPoints() == kRows);
}

} // namespace

int TestAbortAndProgress(int, char*[])
{
  return Run(
    []
    {
      const auto points = MakePoints(RandomPoints(20000, 4.0));
      TestProgress(points, false);
      vtkNew<vtkMultiBlockDataSet> blocks;
      blocks->SetBlock(0, MakePoints(RandomPoints(8000, 4.0)));
      blocks->SetBlock(1, MakePoints(RandomPoints(12000, 4.0, 2)));
      TestProgress(blocks, false);
      TestProgress(blocks, true);
      TestBuilding();
      TestEvaluation();
    });
}
