#include "vessel/stl_file.h"

#include "test_support.h"

using test::Triangle;
using test::Vec3;

namespace {

std::string write(const std::string &bytes)
{
  const std::string path = testing::TempDir() + "rbc_stl_file_test.stl";
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

std::string binary(const std::vector<Triangle> &triangles, const std::string &title)
{
  std::string bytes = title;
  bytes.resize(80, ' ');
  const auto append = [&](const auto &value) {
    bytes.append(reinterpret_cast<const char *>(&value), sizeof value);
  };
  append(static_cast<std::uint32_t>(triangles.size()));
  for (const Triangle &triangle : triangles) {
    for (int n = 0; n < 3; ++n) append(0.0f);
    for (const Vec3 &corner : triangle)
      for (int d = 0; d < 3; ++d) append(static_cast<float>(corner[d]));
    append(std::uint16_t(0));
  }
  return bytes;
}

std::string text(const std::vector<Triangle> &triangles)
{
  std::ostringstream out;
  out.precision(17);
  out << "solid a title\n";
  for (const Triangle &triangle : triangles) {
    out << "  facet normal 0 0 0\n    outer loop\n";
    for (const Vec3 &corner : triangle) out << "      vertex " << corner.transpose() << "\n";
    out << "    endloop\n  endfacet\n";
  }
  out << "endsolid a title\n";
  return out.str();
}

TEST(STLFile, BothFormatsGiveTheTriangles)
{
  const std::vector<Triangle> triangles = test::triangles_of(test::icosphere(3));
  const auto compare = [&](const std::string &bytes, double tolerance) {
    const std::vector<Triangle> read = rbc::read_stl(write(bytes));
    ASSERT_EQ(read.size(), triangles.size());
    for (std::size_t t = 0; t < read.size(); ++t)
      for (int c = 0; c < 3; ++c) ASSERT_NEAR((read[t][c] - triangles[t][c]).norm(), 0, tolerance);
  };
  compare(text(triangles), 1e-15);
  compare(binary(triangles, "vessel"), 1e-7);
  compare(binary(triangles, "solid, in spite of its name"), 1e-7);
}

/// As programs write them that follow the format less closely.
TEST(STLFile, TextIsReadHoweverItIsSpelt)
{
  const std::vector<Triangle> triangles = test::triangles_of(test::icosphere(1));
  const std::string plain = text(triangles);
  const auto replaced = [](std::string words, const std::string &from, const std::string &to) {
    for (std::size_t at = words.find(from); at != std::string::npos;
         at = words.find(from, at + to.size()))
      words.replace(at, from.size(), to);
    return words;
  };
  std::string capitals = plain;
  for (char &letter : capitals)
    if (letter != 'e') letter = static_cast<char>(std::toupper(letter));    // 1e-17 stays
  for (const std::string &words :
       {capitals, "\xef\xbb\xbf" + plain, "\n\r\n  " + plain, "\xef\xbb\xbf\n" + plain,
        replaced(plain, "\n", "\r\n"), replaced(plain, "\n", "\r"),
        replaced(plain, "a title", "a vertex of Vertex 1"), replaced(plain, " a title", "")}) {
    const std::vector<Triangle> read = rbc::read_stl(write(words));
    ASSERT_EQ(read.size(), triangles.size());
    for (std::size_t t = 0; t < read.size(); ++t)
      for (int c = 0; c < 3; ++c) ASSERT_EQ(read[t][c], triangles[t][c]) << words.substr(0, 40);
  }
}

TEST(STLFile, SaysWhatIsWrong)
{
  const auto expect = [](const std::string &path, const std::string &part) {
    std::string said;
    try {
      rbc::read_stl(path);
    } catch (const std::invalid_argument &problem) {
      said = problem.what();
    }
    EXPECT_NE(said.find(part), std::string::npos) << said;
  };
  const std::vector<Triangle> triangles = test::triangles_of(test::icosphere(1));
  expect("no_such_file.stl", "cannot be opened");
  expect(testing::TempDir(), "is a folder, not a file");
  expect("/proc/self/mem", "cannot be read");
  expect(write("ply\nformat ascii 1.0\n"), "neither");
  std::string bytes = binary(triangles, "cut off");
  bytes.pop_back();
  expect(write(bytes), "neither");
  expect(write("solid empty\nendsolid empty\n"), "no triangles");
  std::string words = text(triangles);
  expect(write(words.substr(0, words.size() / 2)), "triangle");
  words.replace(words.find("vertex") + 7, 3, "abc");
  expect(write(words), "not three numbers in triangle 1");
}

}    // namespace
