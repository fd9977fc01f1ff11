#include "output/vtp_writer.h"

#include <cerrno>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <system_error>

namespace rbc {

namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the files are little-endian");

using Name = std::int32_t;    // of a vertex in the file

constexpr int LENGTH = sizeof(std::uint64_t);    // of an array, in bytes, ahead of its data
const std::string TAIL = "\n  </AppendedData>\n</VTKFile>\n";

std::string attribute(const std::string &name, const std::string &value)
{
  return " " + name + "=\"" + value + "\"";
}

std::string type_of(const PointArray &array)
{
  return attribute("type", "Float64") + attribute("Name", array.name) +
         attribute("NumberOfComponents", std::to_string(array.components));
}

std::string type_of(const std::string &label)
{
  return attribute("type", "Int64") + attribute("Name", label);
}

std::string head(const std::string &type)
{
  return "<?xml version=\"1.0\"?>\n<VTKFile" + attribute("type", type) +
         attribute("version", "1.0") + attribute("byte_order", "LittleEndian") +
         attribute("header_type", "UInt64") + ">\n";
}

std::string time_value(double time)
{
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.17g", time);
  return "    <FieldData>\n      <DataArray type=\"Float64\" Name=\"TimeValue\" "
         "NumberOfTuples=\"1\" format=\"ascii\">" +
         std::string(digits) + "</DataArray>\n    </FieldData>\n";
}

const PointArray POINTS{"Points", 3};

[[noreturn]] void fail_with(const std::string &path, const std::string &problem)
{
  throw std::runtime_error(problem + " " + path + ": " + std::generic_category().message(errno));
}

}    // namespace

VtpWriter::VtpWriter(std::string path, double time, const PointData &data,
                     const std::vector<Block> &blocks) :
    path_(std::move(path)),
    file_(nullptr, &std::fclose)
{
  std::int64_t vertices = 0, triangles = 0;
  for (const Block &block : blocks) {
    blocks_.push_back({block.shape, vertices, triangles});
    vertices += block.cells * block.shape->vertex_count();
    triangles += block.cells * static_cast<std::int64_t>(block.shape->triangles.size());
  }
  if (3 * triangles > std::numeric_limits<Name>::max())
    throw std::runtime_error(std::to_string(triangles) + " triangles are too many for one file " +
                             path_ + ": use .pvtp");

  struct Length {
    std::int64_t at;
    std::uint64_t bytes;
  };
  std::vector<Length> lengths;
  const auto section = [&](int width, std::int64_t count) {
    lengths.push_back({end_, static_cast<std::uint64_t>(width * count)});
    end_ += LENGTH + width * count;
    return Section{width, end_ - width * count};
  };
  const auto data_array = [&](const std::string &type) {
    return "        <DataArray" + type + attribute("format", "appended") +
           attribute("offset", std::to_string(lengths.back().at)) + "/>\n";
  };

  std::string text = head("PolyData") + "  <PolyData>\n" + time_value(time) + "    <Piece" +
                     attribute("NumberOfPoints", std::to_string(vertices)) +
                     attribute("NumberOfPolys", std::to_string(triangles)) + ">\n      <Points>\n";
  const auto point_array = [&](const PointArray &array) {
    values_.push_back(section(array.components * sizeof(double), vertices));
    text += data_array(type_of(array));
  };
  point_array(POINTS);
  text += "      </Points>\n      <PointData>\n";
  for (const PointArray &array : data.arrays) point_array(array);
  for (const std::string &label : data.labels) {
    labels_.push_back(section(sizeof(std::int64_t), vertices));
    text += data_array(type_of(label));
  }
  text += "      </PointData>\n      <Polys>\n";
  connectivity_ = section(3 * sizeof(Name), triangles);
  text += data_array(attribute("type", "Int32") + attribute("Name", "connectivity"));
  offsets_ = section(sizeof(Name), triangles);
  text += data_array(attribute("type", "Int32") + attribute("Name", "offsets"));
  text += "      </Polys>\n    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"raw\">\n   _";

  const auto start = static_cast<std::int64_t>(text.size());
  end_ += start;
  for (std::vector<Section> *sections : {&values_, &labels_})
    for (Section &section : *sections) section.begin += start;
  for (Section *section : {&connectivity_, &offsets_}) section->begin += start;

  file_.reset(std::fopen(path_.c_str(), "wb"));
  if (!file_) fail("cannot open file");
  put(0, text.data(), text.size());
  for (const Length &length : lengths) put(start + length.at, &length.bytes, LENGTH);
}

void VtpWriter::write(int block, std::int64_t cell, const double *labels, const double *values)
{
  const SurfaceTemplate &shape = *blocks_[block].shape;
  const auto triangles = static_cast<std::int64_t>(shape.triangles.size());
  const std::int64_t first_vertex = blocks_[block].first_vertex + cell * shape.vertex_count();
  const std::int64_t first_triangle = blocks_[block].first_triangle + cell * triangles;
  const auto place = [&](const Section &section, std::int64_t first, const void *data,
                         std::int64_t count) {
    put(section.begin + first * section.width, data,
        static_cast<std::size_t>(count * section.width));
  };

  for (const Section &section : values_) {
    place(section, first_vertex, values, shape.vertex_count());
    values += shape.vertex_count() * section.width / sizeof(double);
  }
  for (const Section &section : labels_) {
    const std::vector<std::int64_t> same(shape.vertex_count(),
                                         static_cast<std::int64_t>(*labels++));
    place(section, first_vertex, same.data(), shape.vertex_count());
  }

  std::vector<Name> corners, ends;
  for (const auto &triangle : shape.triangles) {
    for (int v : triangle) corners.push_back(static_cast<Name>(first_vertex + v));
    ends.push_back(
        static_cast<Name>(3 * (first_triangle + 1 + static_cast<std::int64_t>(ends.size()))));
  }
  place(connectivity_, first_triangle, corners.data(), triangles);
  place(offsets_, first_triangle, ends.data(), triangles);
}

void VtpWriter::close()
{
  put(end_, TAIL.data(), TAIL.size());
  if (std::fclose(file_.release()) != 0) fail("cannot write file");
}

void VtpWriter::put(std::int64_t at, const void *data, std::size_t bytes)
{
  if (fseeko(file_.get(), at, SEEK_SET) != 0 || std::fwrite(data, 1, bytes, file_.get()) != bytes)
    fail("cannot write file");
}

void VtpWriter::fail(const std::string &problem) const
{
  fail_with(path_, problem);
}

void write_pvtp(const std::string &path, double time, const PointData &data,
                const std::vector<std::string> &pieces)
{
  const auto data_array = [](const std::string &type) {
    return "      <PDataArray" + type + "/>\n";
  };
  std::string text = head("PPolyData") + "  <PPolyData GhostLevel=\"0\">\n" + time_value(time) +
                     "    <PPoints>\n" + data_array(type_of(POINTS)) +
                     "    </PPoints>\n    <PPointData>\n";
  for (const PointArray &array : data.arrays) text += data_array(type_of(array));
  for (const std::string &label : data.labels) text += data_array(type_of(label));
  text += "    </PPointData>\n";
  for (const std::string &piece : pieces)
    text += "    <Piece" + attribute("Source", piece) + "/>\n";
  text += "  </PPolyData>\n</VTKFile>\n";

  std::FILE *const file = std::fopen(path.c_str(), "w");
  if (!file) fail_with(path, "cannot open file");
  const bool whole = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  if (std::fclose(file) != 0 || !whole) fail_with(path, "cannot write file");
}

}    // namespace rbc
