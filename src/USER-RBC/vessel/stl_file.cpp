#include "vessel/stl_file.h"

#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <ios>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace rbc {

namespace {

// of the binary format: title, number of triangles; then a normal, three corners and an attribute
// for each
constexpr std::size_t title_bytes = 80, header_bytes = title_bytes + 4, record_bytes = 50,
                      normal_bytes = 12;

/// A title may start with "solid" in either format, so that the length decides.
bool is_binary(const std::string &bytes)
{
  if (bytes.size() < header_bytes) return false;
  std::uint32_t count;
  std::memcpy(&count, &bytes[title_bytes], sizeof count);
  return bytes.size() == header_bytes + record_bytes * count;
}

std::vector<Triangle> parse_binary(const std::string &bytes)
{
  std::vector<Triangle> triangles;
  for (std::size_t at = header_bytes; at < bytes.size(); at += record_bytes) {
    float numbers[9];
    std::memcpy(numbers, &bytes[at + normal_bytes], sizeof numbers);
    Triangle triangle;
    for (int c = 0; c < 3; ++c)
      triangle[c] = Vec3(numbers[3 * c], numbers[3 * c + 1], numbers[3 * c + 2]);
    triangles.push_back(triangle);
  }
  return triangles;
}

/// Without the mark that some editors put before a text.
std::string_view without_mark(std::string_view bytes)
{
  const std::string_view mark = "\xef\xbb\xbf";
  return bytes.substr(0, mark.size()) == mark ? bytes.substr(mark.size()) : bytes;
}

/// A word as a message shows it: a damaged file may hold anything.
std::string quoted(std::string_view word)
{
  constexpr std::size_t longest = 30;
  std::string shown = "\"";
  for (const char letter : word.substr(0, longest))
    shown += std::isprint(static_cast<unsigned char>(letter)) ? letter : '?';
  return shown + (word.size() > longest ? "...\"" : "\"");
}

std::string lowered(std::string_view word)
{
  std::string lower(word);
  for (char &letter : lower)
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return lower;
}

/// Words of a text, one after the other, and the lines on which they stand, counted from 1. Lines
/// end with LF, CR or both.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  /// Moves to the next word; false behind the last one.
  bool next()
  {
    skip([](char letter) { return is_space(letter); });
    const std::size_t start = at_;
    skip([](char letter) { return !is_space(letter); });
    word_ = text_.substr(start, at_ - start);
    return !word_.empty();
  }

  void skip_line()
  {
    skip([](char letter) { return letter != '\n' && letter != '\r'; });
  }

  std::string_view word() const { return word_; }
  std::string line() const { return " on line " + std::to_string(line_); }

 private:
  static bool is_space(char letter) { return std::isspace(static_cast<unsigned char>(letter)); }

  template <class Skipped> void skip(Skipped skipped)
  {
    for (; at_ < text_.size() && skipped(text_[at_]); ++at_) {
      const bool before_feed = at_ + 1 < text_.size() && text_[at_ + 1] == '\n';
      if (text_[at_] == '\n' || (text_[at_] == '\r' && !before_feed)) ++line_;
    }
  }

  std::string_view text_, word_;
  std::size_t at_ = 0;
  long line_ = 1;
};

/// The whole next word as a number: a tail such as that of 7.9[16 tells of a damaged file.
double read_number(Words &words, const std::string &where)
{
  double number = 0;
  const bool found = words.next();
  std::string_view digits = words.word();
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  const char *const end = digits.data() + digits.size();
  const auto read = std::from_chars(digits.data(), end, number);
  if (!found || read.ec != std::errc() || read.ptr != end || !std::isfinite(number))
    throw std::invalid_argument("a corner is not three numbers" + where + words.line() + ": " +
                                quoted(words.word()));
  return number;
}

bool is_text(std::string_view text)
{
  const std::string keyword = "solid";
  Words words(text);
  words.next();
  return lowered(words.word()).compare(0, keyword.size(), keyword) == 0;
}

/// Reads what lies between facet and endfacet. Words before the first corner, those of the normal,
/// count for nothing.
Triangle read_facet(Words &words, const std::string &where)
{
  Triangle triangle;
  int corners = 0;
  while (words.next()) {
    const std::string word = lowered(words.word());
    if (word == "vertex") {
      if (corners == 3)
        throw std::invalid_argument("more than three corners" + where + words.line());
      Vec3 &corner = triangle[corners++];
      for (int d = 0; d < 3; ++d) corner[d] = read_number(words, where);
    } else if (word == "endfacet") {
      if (corners != 3)
        throw std::invalid_argument("less than three corners" + where + words.line());
      return triangle;
    } else if (corners > 0 && word != "endloop") {
      throw std::invalid_argument("vertex, endloop or endfacet was expected" + where +
                                  words.line() + ", not " + quoted(words.word()));
    }
  }
  throw std::invalid_argument("the file ends within a triangle");
}

/// The title, the rest of a line behind solid or endsolid, may hold any words.
std::vector<Triangle> parse_text(std::string_view text)
{
  Words words(text);
  std::vector<Triangle> triangles;
  while (words.next()) {
    const std::string word = lowered(words.word());
    const std::string where = " in triangle " + std::to_string(triangles.size() + 1);
    if (word == "facet")
      triangles.push_back(read_facet(words, where));
    else if (word == "vertex" || word == "endfacet")
      throw std::invalid_argument("facet was expected" + words.line() + ", not " + word);
    else if (word.find("solid") != std::string::npos)
      words.skip_line();
  }
  return triangles;
}

std::string read_bytes(const std::string &path)
{
  std::error_code unknown;
  if (std::filesystem::is_directory(path, unknown))
    throw std::invalid_argument("is a folder, not a file");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::invalid_argument("cannot be opened");
  try {
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  } catch (const std::ios_base::failure &) {
    throw std::invalid_argument("cannot be read");
  }
}

std::vector<Triangle> parse(const std::string &bytes)
{
  if (is_binary(bytes)) return parse_binary(bytes);
  const std::string_view text = without_mark(bytes);
  if (!is_text(text))
    throw std::invalid_argument("is neither a text STL file, which starts with solid, nor a binary "
                                "one, whose length follows from its number of triangles");
  return parse_text(text);
}

}    // namespace

std::vector<Triangle> read_stl(const std::string &path)
{
  std::vector<Triangle> triangles = parse(read_bytes(path));
  if (triangles.empty()) throw std::invalid_argument("holds no triangles");
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const Vec3 &corner : triangles[t])
      if (!corner.allFinite())
        throw std::invalid_argument("a corner of triangle " + std::to_string(t + 1) +
                                    " is not a number");
  return triangles;
}

}    // namespace rbc
