#include "vessel/stl_file.h"

#include <cctype>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <ios>
#include <iterator>
#include <sstream>
#include <stdexcept>

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

void to_lower(std::string &word)
{
  for (char &letter : word)
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
}

/// Without the mark that some editors put before a text.
std::string without_mark(const std::string &bytes)
{
  const std::string mark = "\xef\xbb\xbf";
  return bytes.compare(0, mark.size(), mark) == 0 ? bytes.substr(mark.size()) : bytes;
}

bool is_text(const std::string &text)
{
  const std::string keyword = "solid";
  std::istringstream words(text);
  std::string word;
  words >> word;
  to_lower(word);
  return word.compare(0, keyword.size(), keyword) == 0;
}

/// The title may hold any words, so that a vertex counts within a facet only.
std::vector<Triangle> parse_text(const std::string &text)
{
  std::istringstream words(text);
  std::string word;
  std::vector<Triangle> triangles;
  Triangle triangle;
  bool in_facet = false;
  int corners = 0;
  while (words >> word) {
    to_lower(word);
    const std::string where = " in triangle " + std::to_string(triangles.size() + 1);
    if (word == "facet") {
      in_facet = true;
    } else if (word == "vertex" && in_facet) {
      if (corners == 3) throw std::invalid_argument("more than three corners" + where);
      Vec3 &corner = triangle[corners++];
      if (!(words >> corner[0] >> corner[1] >> corner[2]))
        throw std::invalid_argument("a corner is not three numbers" + where);
    } else if (word == "endfacet") {
      if (corners != 3) throw std::invalid_argument("less than three corners" + where);
      triangles.push_back(triangle);
      corners = 0;
      in_facet = false;
    }
  }
  if (corners > 0) throw std::invalid_argument("the file ends within a triangle");
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
  const std::string text = without_mark(bytes);
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
