// SPDX-License-Identifier: BSD-3-Clause
#include "CADReading.h"

#include "CADProcess.h"

#include <algorithm>
#include <chrono>

namespace footpoint::cad
{

namespace
{

/// Faces at which the process may die; a file with more of them is broken as a whole.
constexpr std::size_t kMostDeaths = 5;

/// One run of the process.
class Reception
{
public:
  CompleteReading result;
  std::int64_t face = -1; ///< that was worked on last
  std::string stage;      ///< that began last
  bool summarized = false;
  bool done = false;

  void take(const Record& record, const std::function<void(double)>& progress)
  {
    Unpacker unpacker(record.content);
    ReceivedModel& model = this->result.model;
    switch (record.kind)
    {
      case RecordKind::Stage:
        unpacker >> this->stage;
        this->face = -1;
        break;
      case RecordKind::FaceBegins:
        unpacker >> this->face;
        break;
      case RecordKind::Progress:
      {
        double done_until_now = 0.0;
        unpacker >> done_until_now;
        progress(done_until_now);
        break;
      }
      case RecordKind::Summary:
        unpacker >> model.summary;
        this->summarized = true;
        break;
      case RecordKind::Face:
        unpacker >> model.faces.emplace_back();
        break;
      case RecordKind::Edge:
        unpacker >> model.edges.emplace_back();
        break;
      case RecordKind::Mesh:
        unpacker >> model.meshes.emplace_back();
        break;
      case RecordKind::SkippedFace:
      {
        SkippedPart& part = model.skipped_faces.emplace_back();
        unpacker >> part.id >> part.name >> part.reason;
        break;
      }
      case RecordKind::SkippedEdge:
      {
        SkippedPart& part = model.skipped_edges.emplace_back();
        unpacker >> part.id >> part.reason;
        break;
      }
      case RecordKind::Warning:
        unpacker >> this->result.warnings.emplace_back();
        break;
      case RecordKind::Error:
        unpacker >> this->result.error;
        break;
      case RecordKind::Done:
        this->done = true;
        break;
    }
  }
};

/// What has become of the model where the process failed after the faces, or an error.
void close(Reception& reception, const std::string& reason)
{
  CompleteReading& result = reception.result;
  const std::string sentence = reception.face >= 0
    ? "at face " + std::to_string(reception.face) + ": " + reason
    : "while " + reception.stage + ": " + reason;
  if (reception.summarized && reception.face < 0)
  {
    result.warnings.push_back(sentence + "; the exact model is complete, the rest is not");
    result.error.clear();
  }
  else
  {
    result.error = sentence;
  }
}

} // namespace

CompleteReading read_completely(const ReadingOptions& options, double time_limit,
  const std::function<void(double)>& progress, const std::function<bool()>& aborted)
{
  ReadingOptions now = options;
  std::vector<SkippedPart> deadly;
  const auto start = std::chrono::steady_clock::now();
  while (true)
  {
    Reception reception;
    const ReadingOutcome outcome = read_in_process(
      now, time_limit, [&](const Record& record) { reception.take(record, progress); }, aborted);
    CompleteReading& result = reception.result;
    if (outcome.end == ReadingEnd::Aborted)
    {
      CompleteReading nothing;
      nothing.aborted = true;
      return nothing;
    }
    // Crashes are quick; waiting for a second face that never ends would only add to the wait.
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    if (outcome.end == ReadingEnd::Failed && reception.face >= 0 && deadly.size() < kMostDeaths &&
      elapsed.count() < time_limit)
    {
      deadly.push_back({ reception.face, "", outcome.reason });
      now.left_out += (now.left_out.empty() ? "" : ",") + std::to_string(reception.face);
      continue;
    }
    if (!reception.done)
    {
      // An error that was sent says more than how the process ended.
      close(reception, result.error.empty() ? outcome.reason : result.error);
    }
    std::vector<SkippedPart>& skipped = result.model.skipped_faces;
    skipped.insert(skipped.end(), deadly.begin(), deadly.end());
    check(result.model);
    std::sort(skipped.begin(), skipped.end(),
      [](const SkippedPart& a, const SkippedPart& b) { return a.id < b.id; });
    return result;
  }
}

} // namespace footpoint::cad
