// SPDX-License-Identifier: BSD-3-Clause
// Private: numbers in a text, with the lines they stand in.

#ifndef TextScanner_h
#define TextScanner_h

#include <string>
#include <string_view>

namespace footpoint::files
{

/// Reads words that are separated by white space. Numbers are read without regard to the locale, to
/// the nearest double.
class TextScanner
{
public:
  /// \param text has to live as long \param line number of its first line
  explicit TextScanner(std::string_view text, int line = 1);

  /// True where nothing but white space is left.
  bool at_end();
  /// Line of the next word; of the end where there is none.
  int line();
  /// Number of characters that are left: no more than half as many words can follow.
  std::size_t left() const { return this->Text.size() - this->At; }

  /// A finite number. \param what is expected, for messages, e.g. "knot 3" \throw FileError
  double number(const std::string& what);
  /// The same with more digits, for products that are to be divided again.
  long double long_number(const std::string& what);
  /// A whole number from lowest to highest. \throw FileError
  int integer(const std::string& what, int lowest, int highest);

  /// The rest of the line, which is passed.
  std::string_view rest_of_line();

private:
  std::string_view word(const std::string& what);
  template <typename Number>
  Number parse(const std::string& what);
  [[noreturn]] void refuse(const std::string& what, std::string_view found) const;

  std::string_view Text;
  std::size_t At = 0;
  int Line;
};

/// A word of a file for a message: cut where it is long, without control characters.
std::string in_quotes(std::string_view word);

} // namespace footpoint::files

#endif
