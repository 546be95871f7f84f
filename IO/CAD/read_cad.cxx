// SPDX-License-Identifier: BSD-3-Clause
// The program that vtkCADReader starts to read a file: Open CASCADE can crash or run for ever on
// broken files, and here it harms nobody. Sends what it finds as records (CADStream.h) through its
// standard output. Arguments: those of CADProcess.cxx.

#include "CADStream.h"
#include "ModelSending.h"

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <iostream>
#include <string>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

using namespace footpoint::cad;

namespace
{

/// No core files, and no more memory than the machine has: a broken count in a file must end in an
/// error, not in swapping.
void limit_resources()
{
  const rlimit none{ 0, 0 };
  setrlimit(RLIMIT_CORE, &none);
  const auto pages = static_cast<rlim_t>(sysconf(_SC_PHYS_PAGES));
  const auto memory = pages * static_cast<rlim_t>(sysconf(_SC_PAGE_SIZE));
  const rlimit all{ memory, memory };
  setrlimit(RLIMIT_AS, &all);
  prctl(PR_SET_PDEATHSIG, SIGKILL); // nobody waits for us any more
}

/// Keeps standard output for the records: whatever Open CASCADE prints goes nowhere.
int take_output()
{
  const int records = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 10);
  const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  return records;
}

ReadingOptions parse(char* argv[])
{
  ReadingOptions options;
  options.file = argv[1];
  options.unit = argv[2];
  options.deflection = std::strtod(argv[3], nullptr);
  options.angular_deflection = std::strtod(argv[4], nullptr);
  options.faces = argv[5];
  options.left_out = argv[6];
  options.healing = argv[7] == std::string("1");
  options.mesh = argv[8] == std::string("1");
  return options;
}

} // namespace

int main(int argc, char* argv[])
{
  if (argc != 9)
  {
    std::cerr << "This program is started by vtkCADReader.\n";
    return 2;
  }
  limit_resources();
  const int records = take_output();
  try
  {
    send_model(parse(argv), records);
  }
  catch (const StreamError&)
  {
    return 1; // the receiver is gone
  }
  // Destructors of a broken model are one more chance to crash.
  _exit(0);
}
