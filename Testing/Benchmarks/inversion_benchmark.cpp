// SPDX-License-Identifier: BSD-3-Clause

/// How fast and how right point inversion is, beside other programs; see
/// Documentation/Benchmarks.md.

#include "comparison.h"
#include "figures.h"
#include "scaling.h"
#include "tables.h"
#include "timing.h"
#include "vector_targets.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>

namespace
{

using namespace inversion_benchmark;

const char* const kUsage = R"(usage: inversion_benchmark [option]...
Times point inversion, one thread, and prints tables in Markdown. Everything by default.

  --shape NAME     only this shape (may be repeated)
  --class NAME     only these queries (may be repeated): on, near, off, far, centre, core, distant,
                   ties
  --points N       queries of a class, at most (100000)
  --budget S       seconds of one pass over a class; slow programs get fewer queries (0.06)
  --repeats N      passes, of which the median counts (5)
  --ours-only      no other program
  --compare-only   no filter, no scaling, no single vector instructions: the default where shapes
                   or classes are named
  --output FOLDER  also write inversion.csv, for plot.py
  --list           print the names of the shapes
  --help           print this

Progress goes to the standard error. On two slow threads everything takes 5 minutes, with
--budget 0.01 --repeats 1 (rough figures) 2.
)";

struct Arguments
{
  Settings settings;
  bool compare_only = false;
  bool list = false;
  bool help = false;
  std::string output;
};

/// \throw std::exception where an argument is not understood
Arguments parse(int argc, char** argv)
{
  Arguments arguments;
  Settings& settings = arguments.settings;
  for (int i = 1; i < argc; ++i)
  {
    const std::string option = argv[i];
    const auto value = [&]() -> std::string
    {
      if (++i == argc)
      {
        throw std::invalid_argument(option + " needs a value");
      }
      return argv[i];
    };
    if (option == "--shape")
    {
      settings.shapes.push_back(value());
    }
    else if (option == "--class")
    {
      settings.classes.push_back(class_of(value()));
    }
    else if (option == "--points")
    {
      settings.points = std::max(1, std::stoi(value()));
    }
    else if (option == "--budget")
    {
      settings.budget = std::stod(value());
    }
    else if (option == "--repeats")
    {
      settings.repeats = std::max(1, std::stoi(value()));
    }
    else if (option == "--ours-only")
    {
      settings.ours_only = true;
    }
    else if (option == "--compare-only")
    {
      arguments.compare_only = true;
    }
    else if (option == "--output")
    {
      arguments.output = value();
    }
    else if (option == "--list")
    {
      arguments.list = true;
    }
    else if (option == "--help")
    {
      arguments.help = true;
    }
    else
    {
      throw std::invalid_argument("unknown option " + option);
    }
  }
  return arguments;
}

void list_shapes()
{
  for (const Shape& shape : all_shapes())
  {
    std::cout << shape.name << ": " << shape.pieces() << " pieces\n";
  }
}

/// \throw std::invalid_argument where a name is that of no shape
void check_names(const Settings& settings)
{
  const std::vector<Shape> all = all_shapes();
  for (const std::string& name : settings.shapes)
  {
    if (std::none_of(all.begin(), all.end(), [&](const Shape& s) { return s.name == name; }))
    {
      throw std::invalid_argument("there is no shape '" + name + "'");
    }
  }
}

void run(const Arguments& arguments)
{
  const Settings& settings = arguments.settings;
  check_names(settings);
  const bool whole = !arguments.compare_only && settings.shapes.empty() && settings.classes.empty();
  Records records = compare(settings, std::cerr);
  if (whole)
  {
    for (const auto measure : { measure_vector_targets, measure_scaling })
    {
      const Records more = measure(settings, std::cerr);
      records.insert(records.end(), more.begin(), more.end());
    }
  }
  print_machine(std::cout, settings);
  if (whole)
  {
    print_figures(std::cout, records);
  }
  print_comparison(std::cout, records);
  if (!arguments.output.empty())
  {
    std::filesystem::create_directories(arguments.output);
    std::ofstream file(std::filesystem::path(arguments.output) / "inversion.csv");
    write_csv(file, records);
    if (!file)
    {
      throw std::runtime_error("cannot write inversion.csv in " + arguments.output);
    }
  }
}

} // namespace

int main(int argc, char** argv)
{
  Arguments arguments;
  try
  {
    arguments = parse(argc, argv);
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << '\n' << kUsage;
    return 2;
  }
  if (arguments.help)
  {
    std::cout << kUsage;
    return 0;
  }
  if (arguments.list)
  {
    list_shapes();
    return 0;
  }
  try
  {
    const double spent = inversion_benchmark::seconds([&] { run(arguments); });
    std::cerr << "measured in " << std::lround(spent) << " s\n";
  }
  catch (const std::exception& error)
  {
    std::cerr << "inversion_benchmark: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
