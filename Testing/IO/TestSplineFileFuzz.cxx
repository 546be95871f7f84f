// SPDX-License-Identifier: BSD-3-Clause
// Files cut at every byte and with bytes changed: an error that says where, or splines; never both,
// never neither, never a crash.
#include "FileTesting.h"

using namespace testing;

namespace
{

int refused = 0;
int taken = 0;

void Try(const std::string& path, const std::string& text, const std::string& what)
{
  WriteText(path, text);
  const ReadResult result = ReadSplines(path);
  const bool has_splines = result.data->GetNumberOfBlocks() > 0;
  if (has_splines != result.errors.empty())
  {
    throw std::runtime_error(what + " of " + path + " gives " +
      std::to_string(result.data->GetNumberOfBlocks()) + " splines and: " + result.errors);
  }
  ++(has_splines ? taken : refused);
  if (!has_splines &&
    !(Contains(result.errors, path) &&
      (Contains(result.errors, "line ") || Contains(result.errors, "Line ") ||
        Contains(result.errors, "no spline"))))
  {
    throw std::runtime_error(
      what + " of " + path + " is refused without a place: " + result.errors);
  }
}

void Spoil(const std::string& path, const std::string& good)
{
  std::mt19937 generator(20);
  for (std::size_t length = 0; length < good.size(); ++length)
  {
    Try(path, good.substr(0, length), "the first " + std::to_string(length) + " bytes");
  }
  const std::string likely = "0123456789-+.eE \n\t<>/\"'{}[],:&xn";
  for (std::size_t at = 0; at < good.size(); ++at)
  {
    std::string text = good;
    switch (generator() % 3)
    {
      case 0:
        text[at] = static_cast<char>(text[at] ^ (1u << (generator() % 8)));
        break;
      case 1:
        text[at] = likely[generator() % likely.size()];
        break;
      default:
        text[at] = static_cast<char>(generator() % 256);
    }
    Try(path, text, "byte " + std::to_string(at) + " changed");
  }
  for (int trial = 0; trial < 200; ++trial)
  {
    std::string text = good;
    for (int change = 0; change < 4; ++change)
    {
      const std::size_t from = generator() % text.size();
      const std::size_t length = generator() % 20;
      const std::size_t to = generator() % text.size();
      const std::string part = text.substr(from, length);
      switch (generator() % 3)
      {
        case 0:
          text.erase(from, length);
          break;
        case 1:
          text.insert(to, part);
          break;
        default:
          text.replace(to, part.size(), part);
      }
      text += text.empty() ? " " : "";
    }
    Try(path, text, "trial " + std::to_string(trial));
  }
}

} // namespace

int TestSplineFileFuzz(int argc, char* argv[])
{
  return Run(
    [&]
    {
      const std::string folder = OutputFolder(argc, argv);
      Spoil(folder + "/fuzz.g2", files::kGoTools);
      Spoil(folder + "/fuzz.xml", files::kGPlusSmo);
      Spoil(folder + "/fuzz.json", files::kGeomdl);
      std::cout << refused << " refused, " << taken << " taken" << std::endl;
      CHECK(refused > 1000 && taken > 100);
    });
}
