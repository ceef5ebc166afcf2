#include "endowire/vessel/obj.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "endowire/base/error.hpp"
#include "endowire/vessel/text_tokens.hpp"

namespace endowire::vessel {
namespace {

using base::InputError;

std::string line_label(const std::string& file, std::size_t line) {
  return file + ": line " + std::to_string(line);
}

Eigen::Vector3d vertex_of(Tokens& words, const std::string& label) {
  Eigen::Vector3d vertex;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const std::string_view word = words.next();
    vertex[axis] = parse_number(word);
    if (!std::isfinite(vertex[axis]))
      throw InputError(label + ": a coordinate is '" + quoted(word) + "'; must be a finite number");
  }
  return vertex;
}

/// From 1, or back from the last with a minus; only what stands before a slash counts.
std::int32_t corner_of(std::string_view word, std::size_t vertices, const std::string& label) {
  const double number = parse_number(word.substr(0, word.find('/')));
  const auto count = static_cast<double>(vertices);
  const double index = number < 0.0 ? count + number : number - 1.0;
  if (!(index >= 0.0 && index < count) || index != std::floor(index))
    throw InputError(label + ": a corner is '" + quoted(word) + "'; must be 1 … " + std::to_string(vertices) +
                     ", a vertex before it");
  return static_cast<std::int32_t>(index);
}

}  // namespace

TriangleMesh parse_obj(std::string_view text, const std::string& file_label) {
  TriangleMesh mesh;
  Tokens lines(text);
  std::size_t number = 0;
  std::string joined;  // of lines that go on
  std::vector<std::int32_t> corners;
  while (!lines.at_end()) {
    std::string_view line = lines.line();
    ++number;
    if (!line.empty() && line.back() == '\\') {
      joined.append(line.substr(0, line.size() - 1)).push_back(' ');
      continue;
    }
    if (!joined.empty()) line = joined.append(line);
    Tokens words(line);
    const std::string_view what = words.next();
    const std::string label = what == "v" || what == "f" ? line_label(file_label, number) : std::string();
    if (what == "v") {
      if (mesh.vertices_mm.size() >= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
        throw InputError(label + ": there are more than 2147483647 vertices");
      mesh.vertices_mm.push_back(vertex_of(words, label));
    } else if (what == "f") {
      corners.clear();
      for (std::string_view word = words.next(); !word.empty() && word[0] != '#'; word = words.next())
        corners.push_back(corner_of(word, mesh.vertices_mm.size(), label));
      if (corners.size() < 3)
        throw InputError(label + ": a face has " + std::to_string(corners.size()) + " corners; must be >= 3");
      for (std::size_t k = 2; k < corners.size(); ++k)
        mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
    }
    joined.clear();
  }
  if (mesh.triangles.empty())
    throw InputError(file_label + ": there are no faces; must be an OBJ file with lines that begin with f");
  return mesh;
}

}  // namespace endowire::vessel
