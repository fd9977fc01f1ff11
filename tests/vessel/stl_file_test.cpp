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
  const std::string words = text(triangles);
  expect(write(words.substr(0, words.size() / 2)), "triangle");
  expect(write("solid one\nfacet normal 0 0 1\n"), "ends within a triangle");
}

/// A damaged line is no triangle that the file does not hold.
TEST(STLFile, NamesTheLineThatIsDamaged)
{
  const auto said = [](const std::string &third, const std::string &line_end) {
    const std::string lines = "solid one#facet normal 0 0 1#outer loop#vertex 4 10.6 7.9#vertex " +
                              third + "#vertex 1 2 3#endloop#endfacet#endsolid#";
    std::string bytes;
    for (const char letter : lines) bytes += letter == '#' ? line_end : std::string(1, letter);
    try {
      const std::vector<Triangle> read = rbc::read_stl(write(bytes));
      return "taken: " + std::to_string(read.at(0)[1][2]);
    } catch (const std::invalid_argument &problem) {
      return std::string(problem.what());
    }
  };
  for (const std::string third : {"4 10.6 7.91341[16", "4 10.6 abc", "4 10.6", "4 10.6 0x10",
                                  "4 10.6 nan", "4 10.6 1e999", "4 10.6 +-1", "4 10.6 1,5"})
    for (const std::string line_end : {"\n", "\r\n", "\r"}) {
      const std::string problem = said(third, line_end);
      EXPECT_EQ(problem.rfind("a corner is not three numbers in triangle 1 on line ", 0), 0)
          << third << ": " << problem;
      const std::string line = third == "4 10.6" ? "6" : "5";    // read on the next line
      EXPECT_NE(problem.find("line " + line + ": \""), std::string::npos) << problem;
    }
  for (const std::string third : {"4 10.6 7.9 3", "4 10.6 7.9 facet", "4 10.6 7.9\nvertx 1 2 3"})
    EXPECT_NE(said(third, "\n").find("vertex, endloop or endfacet was expected"),
              std::string::npos);
  EXPECT_NE(said("1 2 3\nvertex 1 2 3", "\n").find("more than three corners"), std::string::npos);
  EXPECT_NE(said("1 2 3\nendfacet", "\n").find("less than three corners"), std::string::npos);
  EXPECT_NE(said("1 2 3\nvertex 1 2 3\nendfacet", "\n").find("facet was expected on line 8, not"),
            std::string::npos);
  for (const std::string third : {"4 10.6 7.5", "4 10.6 +7.5E0", "4 10.6\n75e-1", "4 10.6 7.5 "})
    EXPECT_EQ(said(third, "\n"), "taken: 7.500000");
}

}    // namespace
