// SPDX-License-Identifier: BSD-3-Clause
#include "CancelSignal.h"

#include "Ranks.h"

#include "vtkMultiProcessController.h"

#if VTK_MODULE_ENABLE_VTK_ParallelMPI
#include "vtkMPICommunicator.h"
#include "vtkMPIController.h"
#endif

#include <vector>

namespace footpoint::conversion
{

#if VTK_MODULE_ENABLE_VTK_ParallelMPI

namespace
{

/// No other message of VTK or ParaView has it.
constexpr int kTag = 0x466f;

} // namespace

/// One byte to each other rank, and no answer.
struct CancelSignal::Messages
{
  vtkMPIController* Controller;
  unsigned char Byte = 1;
  std::vector<vtkMPICommunicator::Request> Requests;

  void send()
  {
    for (int rank = 0; rank < this->Controller->GetNumberOfProcesses(); ++rank)
    {
      if (rank != this->Controller->GetLocalProcessId())
      {
        this->Requests.emplace_back();
        this->Controller->NoBlockSend(&this->Byte, 1, rank, kTag, this->Requests.back());
      }
    }
  }

  bool waiting() const
  {
    int flag = 0;
    int source = 0;
    this->Controller->Iprobe(vtkMultiProcessController::ANY_SOURCE, kTag, &flag, &source);
    return flag != 0;
  }

  void receive(int rank)
  {
    unsigned char byte = 0;
    this->Controller->Receive(&byte, 1, rank, kTag);
  }

  void finish()
  {
    for (vtkMPICommunicator::Request& request : this->Requests)
    {
      request.Wait();
    }
  }
};

CancelSignal::CancelSignal(vtkMultiProcessController* controller)
{
  auto* const mpi = vtkMPIController::SafeDownCast(controller);
  if (mpi && mpi->GetNumberOfProcesses() > 1)
  {
    this->Sent = std::make_unique<Messages>();
    this->Sent->Controller = mpi;
    this->Sent->Requests.reserve(static_cast<std::size_t>(mpi->GetNumberOfProcesses()));
  }
}

#else

struct CancelSignal::Messages
{
  void send() {}
  bool waiting() const { return false; }
  void receive(int) {}
  void finish() {}
};

CancelSignal::CancelSignal(vtkMultiProcessController*) {}

#endif

CancelSignal::~CancelSignal() = default;

bool CancelSignal::requested(bool here)
{
  if (here && !this->Here && this->Sent)
  {
    this->Sent->send();
  }
  this->Here = this->Here || here;
  this->Elsewhere = this->Elsewhere || (!this->Here && this->Sent && this->Sent->waiting());
  return this->Here || this->Elsewhere;
}

bool CancelSignal::settle(const Ranks& ranks)
{
  const auto asked = ranks.gather({ this->Here ? 1u : 0u });
  bool any = false;
  for (int rank = 0; rank < ranks.count(); ++rank)
  {
    const bool stopped = asked[static_cast<std::size_t>(rank)][0] != 0;
    any = any || stopped;
    if (stopped && rank != ranks.rank() && this->Sent)
    {
      this->Sent->receive(rank);
    }
  }
  if (this->Sent)
  {
    this->Sent->finish();
  }
  return any;
}

Execution stopped_by(CancelSignal& cancel, const Execution& execution)
{
  Execution result = execution;
  result.proceed = [&cancel, proceed = execution.proceed](double fraction)
  { return !cancel.requested(!proceed(fraction)); };
  return result;
}

} // namespace footpoint::conversion
