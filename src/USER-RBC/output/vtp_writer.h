#pragma once

#include "geometry/surface_template.h"

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace rbc {

/// Numbers of type double given at every vertex.
struct PointArray {
  std::string name;
  int components;
};

/// What the vertices of a file have.
struct PointData {
  std::vector<PointArray> arrays;
  std::vector<std::string> labels;    ///< integers, each the same at all vertices of a surface
};

/// A VTK XML file of PolyData that holds closed surfaces: vertices and triangles in the order of
/// their templates, arrays and labels at each vertex, the time as field data. Every surface has
/// its place in the file, so they may come in any order, and only one of them need be in memory.
/// All throw std::runtime_error, naming the file and the reason.
class VtpWriter {
 public:
  /// Surfaces made from one template, which must outlive the writer.
  struct Block {
    const SurfaceTemplate *shape;
    std::int64_t cells;
  };

  VtpWriter(std::string path, double time, const PointData &data, const std::vector<Block> &blocks);

  /// `values` holds the positions of all vertices, then the arrays one after another; `labels` one
  /// for each.
  void write(int block, std::int64_t cell, const double *labels, const double *values);

  void close();

 private:
  /// An array of the file and where its data begins.
  struct Section {
    int width;    ///< bytes per vertex or triangle
    std::int64_t begin;
  };
  struct Placed {
    const SurfaceTemplate *shape;
    std::int64_t first_vertex, first_triangle;
  };

  std::string path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE *)> file_;
  std::vector<Placed> blocks_;
  std::vector<Section> values_, labels_;
  Section connectivity_, offsets_;
  std::int64_t end_ = 0;

  void put(std::int64_t at, const void *data, std::size_t bytes);
  [[noreturn]] void fail(const std::string &problem) const;
};

/// The file that makes one data set of the pieces that ranks wrote; their names are relative to it.
void write_pvtp(const std::string &path, double time, const PointData &data,
                const std::vector<std::string> &pieces);

}    // namespace rbc
