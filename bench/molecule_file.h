#pragma once

#include <array>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

/// Coordinates and triangles (from 0) of a cell template.
struct MoleculeFile {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<int, 3>> triangles;

  explicit MoleculeFile(const std::string &path)
  {
    std::ifstream file(path);
    int id, type;
    if (!skip_to(file, "Coords")) throw std::runtime_error("no coordinates in " + path);
    for (std::array<double, 3> x; file >> id >> x[0] >> x[1] >> x[2];) vertices.push_back(x);
    file.clear();
    file.seekg(0);
    if (!skip_to(file, "Angles")) throw std::runtime_error("no triangles in " + path);
    for (std::array<int, 3> t; file >> id >> type >> t[0] >> t[1] >> t[2];)
      triangles.push_back({t[0] - 1, t[1] - 1, t[2] - 1});
  }

 private:
  static bool skip_to(std::ifstream &file, const std::string &section)
  {
    for (std::string line; std::getline(file, line);)
      if (line.rfind(section, 0) == 0) return true;
    return false;
  }
};
