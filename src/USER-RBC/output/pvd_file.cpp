#include "output/pvd_file.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace rbc {

namespace {

const std::string HEAD = "<?xml version=\"1.0\"?>\n"
                         "<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
const std::string TAIL = "  </Collection>\n</VTKFile>\n";
const std::string ENTRY = "    <DataSet timestep=\"";

/// Entries of a list that are before a time, as lines.
std::string entries_before(const std::string &path, double time)
{
  std::ifstream old(path);
  std::string entries, line;
  while (std::getline(old, line))
    if (line.compare(0, ENTRY.size(), ENTRY) == 0 &&
        std::strtod(line.c_str() + ENTRY.size(), nullptr) < time)
      entries += line + "\n";
  return entries;
}

}    // namespace

std::string pvd_name(const std::string &series)
{
  const std::filesystem::path path(series);
  std::string stem = path.stem().string();
  const std::size_t star = stem.find('*');
  if (star == std::string::npos || path.parent_path().string().find('*') != std::string::npos)
    return "";
  std::string before = stem.substr(0, star), after = stem.substr(star + 1);
  while (!before.empty() && std::strchr("._-", before.back())) before.pop_back();
  if (before.empty())
    while (!after.empty() && std::strchr("._-", after.front())) after.erase(0, 1);
  stem = before + after;
  return (path.parent_path() / ((stem.empty() ? "series" : stem) + ".pvd")).string();
}

void add_to_pvd(const std::string &path, double time, const std::string &name)
{
  char number[32];
  std::snprintf(number, sizeof(number), "%.17g", time);
  const std::string text = HEAD + entries_before(path, time) + ENTRY + number +
                           "\" group=\"\" part=\"0\" file=\"" + name + "\"/>\n" + TAIL;
  const std::string written = path + ".part";
  std::ofstream file(written, std::ios::binary);
  file << text;
  file.close();
  if (!file || std::rename(written.c_str(), path.c_str()) != 0)
    throw std::runtime_error("cannot write file " + path + ": " + std::strerror(errno));
}

}    // namespace rbc
