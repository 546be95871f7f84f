// SPDX-License-Identifier: BSD-3-Clause
// Private: what the reading process has sent, as VTK data.

#ifndef CADOutputs_h
#define CADOutputs_h

#include "CADModel.h"

#include <string>
#include <vector>

class vtkMultiBlockDataSet;
class vtkPolyData;

namespace footpoint::cad
{

struct SkippedPart
{
  std::int64_t id;
  std::string name; ///< may be empty
  std::string reason;
};

/// All parts of a model that have come.
struct ReceivedModel
{
  ModelSummary summary;
  std::vector<FaceData> faces;
  std::vector<EdgeData> edges;
  std::vector<FaceMesh> meshes;
  std::vector<SkippedPart> skipped_faces;
  std::vector<SkippedPart> skipped_edges;
};

/// Drops faces and edges that the core would refuse, and notes why.
void check(ReceivedModel& model);

/// The formats are those in the documentation of vtkCADReader.
void write_mesh(const ReceivedModel& model, vtkPolyData* mesh);
void write_faces(const ReceivedModel& model, vtkMultiBlockDataSet* faces);
void write_edges(const ReceivedModel& model, vtkMultiBlockDataSet* edges);

} // namespace footpoint::cad

#endif
