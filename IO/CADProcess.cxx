// SPDX-License-Identifier: BSD-3-Clause
#include "CADProcess.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <locale>
#include <poll.h>
#include <spawn.h>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

extern char** environ;

namespace footpoint::cad
{

namespace
{

constexpr int kPollMilliseconds = 100;
constexpr std::size_t kChunk = 1 << 16;

/// The program lies in the folder `footpoint` beside this library, wherever that is installed.
std::string program_path()
{
  Dl_info info;
  if (::dladdr(reinterpret_cast<const void*>(&program_path), &info) == 0 || !info.dli_fname)
  {
    return {};
  }
  const std::string library = info.dli_fname;
  const std::size_t slash = library.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : library.substr(0, slash);
  return folder + "/footpoint/footpoint-read-cad";
}

std::string number_text(double number)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(17);
  text << number;
  return text.str();
}

/// A running process and the end of the pipe that it writes into; stopped on destruction.
class Process
{
public:
  Process(const std::string& program, const std::vector<std::string>& arguments)
  {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
    {
      this->Problem = errno;
      return;
    }
    this->Pipe = ends[0];
    std::vector<char*> words{ const_cast<char*>(program.c_str()) };
    for (const std::string& argument : arguments)
    {
      words.push_back(const_cast<char*>(argument.c_str()));
    }
    words.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    // Signals that the caller blocks or ignores are not the program's affair.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    sigset_t all;
    sigfillset(&all);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    this->Problem =
      ::posix_spawn(&this->Id, program.c_str(), &actions, &attributes, words.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
  }

  ~Process()
  {
    if (this->Pipe >= 0)
    {
      ::close(this->Pipe);
    }
    if (this->running())
    {
      ::kill(this->Id, SIGKILL);
      this->wait();
    }
  }

  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  int problem() const { return this->Problem; } ///< 0 where it was started
  int pipe() const { return this->Pipe; }

  /// How it ended, empty where without fault.
  std::string wait()
  {
    int status = 0;
    pid_t got = 0;
    do
    {
      got = ::waitpid(this->Id, &status, 0);
    } while (got < 0 && errno == EINTR);
    this->Id = -1;
    if (got < 0)
    {
      return {}; // somebody else has waited for it
    }
    if (WIFSIGNALED(status))
    {
      const int signal = WTERMSIG(status);
      return std::string("Open CASCADE crashed (") + ::strsignal(signal) + ")";
    }
    return WEXITSTATUS(status) == 0
      ? ""
      : "the program that reads CAD files ended with code " + std::to_string(WEXITSTATUS(status));
  }

private:
  bool running() const { return this->Problem == 0 && this->Id > 0; }

  pid_t Id = -1;
  int Pipe = -1;
  int Problem = 0;
};

ReadingOutcome failed(const std::string& reason)
{
  return { ReadingEnd::Failed, reason };
}

} // namespace

ReadingOutcome read_in_process(const ReadingOptions& options, double time_limit,
  const std::function<void(const Record&)>& on_record, const std::function<bool()>& aborted)
{
  using Clock = std::chrono::steady_clock;
  const std::string program = program_path();
  Process process(program,
    { options.file, options.unit, number_text(options.deflection),
      number_text(options.angular_deflection), options.faces, options.left_out,
      options.healing ? "1" : "0", options.mesh ? "1" : "0" });
  if (process.problem() != 0)
  {
    return failed("the program that reads CAD files, " + program +
      ", could not be started: " + std::strerror(process.problem()));
  }

  RecordAssembly assembly;
  std::vector<char> chunk(kChunk);
  Clock::time_point last_sign = Clock::now();
  while (true)
  {
    pollfd waiting{ process.pipe(), POLLIN, 0 };
    const int ready = ::poll(&waiting, 1, kPollMilliseconds);
    if (aborted())
    {
      return { ReadingEnd::Aborted, "" };
    }
    if (ready <= 0)
    {
      if (std::chrono::duration<double>(Clock::now() - last_sign).count() > time_limit)
      {
        return failed("Open CASCADE gave no sign of progress for " + number_text(time_limit) +
          " s and was stopped (TimeLimit)");
      }
      continue;
    }
    const ssize_t count = ::read(process.pipe(), chunk.data(), chunk.size());
    if (count < 0 && errno == EINTR)
    {
      continue;
    }
    if (count <= 0)
    {
      break;
    }
    last_sign = Clock::now();
    assembly.add(chunk.data(), static_cast<std::size_t>(count), on_record);
  }
  const std::string fault = process.wait();
  return fault.empty() ? ReadingOutcome{ ReadingEnd::Complete, "" } : failed(fault);
}

} // namespace footpoint::cad
