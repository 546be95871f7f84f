// SPDX-License-Identifier: BSD-3-Clause
#include "TextScanner.h"

#include "SplineFile.h"

#include <charconv>
#include <cmath>
#include <type_traits>

namespace footpoint::files
{

namespace
{

bool is_space(char c)
{
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v';
}

} // namespace

TextScanner::TextScanner(std::string_view text, int line)
  : Text(text)
  , Line(line)
{
}

bool TextScanner::at_end()
{
  while (this->At < this->Text.size() && is_space(this->Text[this->At]))
  {
    this->Line += this->Text[this->At] == '\n' ? 1 : 0;
    ++this->At;
  }
  return this->At == this->Text.size();
}

int TextScanner::line()
{
  this->at_end();
  return this->Line;
}

std::string_view TextScanner::word(const std::string& what)
{
  if (this->at_end())
  {
    this->refuse(what, {});
  }
  const std::size_t start = this->At;
  while (this->At < this->Text.size() && !is_space(this->Text[this->At]))
  {
    ++this->At;
  }
  return this->Text.substr(start, this->At - start);
}

template <typename Number>
Number TextScanner::parse(const std::string& what)
{
  const std::string_view found = this->word(what);
  std::string_view digits = found;
  // from_chars takes no plus sign.
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-' && digits[1] != '+')
  {
    digits.remove_prefix(1);
  }
  Number value{};
  const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  bool good = problem == std::errc() && end == digits.data() + digits.size();
  if constexpr (std::is_floating_point_v<Number>)
  {
    good = good && std::isfinite(value);
  }
  if (!good)
  {
    this->refuse(what, found);
  }
  return value;
}

double TextScanner::number(const std::string& what)
{
  return this->parse<double>(what);
}

long double TextScanner::long_number(const std::string& what)
{
  return this->parse<long double>(what);
}

int TextScanner::integer(const std::string& what, int lowest, int highest)
{
  const std::string range =
    what + " (" + std::to_string(lowest) + " to " + std::to_string(highest) + ")";
  const int value = this->parse<int>(range);
  if (value < lowest || value > highest)
  {
    this->refuse(range, std::to_string(value));
  }
  return value;
}

std::string_view TextScanner::rest_of_line()
{
  const std::size_t start = this->At;
  const std::size_t end = this->Text.find('\n', start);
  this->At = end == std::string_view::npos ? this->Text.size() : end;
  return this->Text.substr(start, this->At - start);
}

void TextScanner::refuse(const std::string& what, std::string_view found) const
{
  throw FileError("line " + std::to_string(this->Line) + ": expected " + what + ", found " +
    (found.empty() ? "the end" : in_quotes(found)));
}

std::string in_quotes(std::string_view word)
{
  constexpr std::size_t kLongest = 40; // enough for any number
  std::string text = "'";
  for (const char c : word.substr(0, kLongest))
  {
    text += static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f ? '?' : c;
  }
  return text + (word.size() > kLongest ? "…'" : "'");
}

} // namespace footpoint::files
