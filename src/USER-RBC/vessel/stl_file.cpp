#include "vessel/stl_file.h"

#include <cctype>
#include <cstdint>
#include <cstring>
#include <fstream>
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

std::vector<Triangle> parse_text(const std::string &text)
{
  std::istringstream words(text);
  std::string word;
  std::vector<Triangle> triangles;
  Triangle triangle;
  int corners = 0;
  while (words >> word) {
    for (char &letter : word) letter = static_cast<char>(std::tolower(letter));
    const std::string where = " in triangle " + std::to_string(triangles.size() + 1);
    if (word == "vertex") {
      if (corners == 3) throw std::invalid_argument("more than three corners" + where);
      Vec3 &corner = triangle[corners++];
      if (!(words >> corner[0] >> corner[1] >> corner[2]))
        throw std::invalid_argument("a corner is not three numbers" + where);
    } else if (word == "endfacet") {
      if (corners != 3) throw std::invalid_argument("less than three corners" + where);
      triangles.push_back(triangle);
      corners = 0;
    }
  }
  if (corners > 0) throw std::invalid_argument("the file ends within a triangle");
  return triangles;
}

}    // namespace

std::vector<Triangle> read_stl(const std::string &path)
{
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::invalid_argument("cannot be opened");
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const bool binary = is_binary(bytes);
  if (!binary && bytes.compare(0, 5, "solid") != 0)
    throw std::invalid_argument("is neither a text STL file, which starts with solid, nor a binary "
                                "one, whose length follows from its number of triangles");
  std::vector<Triangle> triangles = binary ? parse_binary(bytes) : parse_text(bytes);
  if (triangles.empty()) throw std::invalid_argument("holds no triangles");
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const Vec3 &corner : triangles[t])
      if (!corner.allFinite())
        throw std::invalid_argument("a corner of triangle " + std::to_string(t + 1) +
                                    " is not a number");
  return triangles;
}

}    // namespace rbc
