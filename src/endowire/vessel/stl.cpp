#include "endowire/vessel/stl.hpp"

#include <cmath>
#include <cstdio>
#include <cstring>

#include "endowire/base/bits.hpp"
#include "endowire/base/error.hpp"
#include "endowire/vessel/text_tokens.hpp"

namespace endowire::vessel {
namespace {

using base::InputError;

constexpr std::size_t header_bytes = 84;  // 80 of text, 4 of count
constexpr std::size_t facet_bytes = 50;   // 12 floats and 2 bytes of attribute

std::uint32_t read_u32(const std::byte* p) {  // little endian whatever the machine
  std::uint32_t value = 0;
  for (unsigned k = 0; k < 4; ++k) value |= std::to_integer<std::uint32_t>(p[k]) << (8 * k);
  return value;
}

double read_float(const std::byte* p) {
  return static_cast<double>(base::bits_as<float>(read_u32(p)));
}

void write_u32(std::vector<std::byte>& out, std::uint32_t value) {
  for (unsigned k = 0; k < 4; ++k) out.push_back(static_cast<std::byte>((value >> (8 * k)) & 0xffU));
}

void add_vertex(TriangleMesh& mesh, const Eigen::Vector3d& v) {
  const std::size_t index = mesh.vertices_mm.size();
  if (index % 3 == 0) mesh.triangles.push_back({});
  mesh.triangles.back()[index % 3] = static_cast<std::int32_t>(index);
  mesh.vertices_mm.push_back(v);
}

[[noreturn]] void fail_vertex(const std::string& file, std::size_t facet, std::size_t corner,
                              const std::string& value) {
  throw InputError(file + ": triangle " + std::to_string(facet + 1) + ", vertex " +
                   std::to_string(corner + 1) + " is " + value + "; must be a finite number");
}

TriangleMesh parse_binary(std::span<const std::byte> bytes, const std::string& file, double scale) {
  const std::size_t count =
      (bytes.size() - header_bytes) / facet_bytes;  // the caller has checked that they agree
  TriangleMesh mesh;
  mesh.vertices_mm.reserve(3 * count);
  mesh.triangles.reserve(count);
  for (std::size_t t = 0; t < count; ++t) {
    const std::byte* facet = bytes.data() + header_bytes + t * facet_bytes + 12;
    for (std::size_t k = 0; k < 3; ++k) {
      Eigen::Vector3d v;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double value = read_float(facet + 12 * k + 4 * axis);
        if (!std::isfinite(value)) fail_vertex(file, t, k, std::isnan(value) ? "nan" : "infinite");
        v[static_cast<Eigen::Index>(axis)] = value * scale;
      }
      add_vertex(mesh, v);
    }
  }
  return mesh;
}

TriangleMesh parse_ascii(std::string_view text, const std::string& file, double scale) {
  TriangleMesh mesh;
  Tokens tokens(text);
  bool in_solid = false;
  const auto truncated = [&]() {
    return InputError(file + ": the text ends inside a solid after " +
                      std::to_string(mesh.vertices_mm.size() / 3) + " triangles; must end with endsolid");
  };
  const auto expect = [&](std::string_view word) {
    const std::string_view token = tokens.next();
    if (token.empty()) throw truncated();
    if (!equals(token, word))
      throw InputError(file + ": triangle " + std::to_string(mesh.vertices_mm.size() / 3 + 1) + " has '" +
                       quoted(token) + "'; must be '" + std::string(word) + "'");
  };
  for (std::string_view token = tokens.next(); !token.empty(); token = tokens.next()) {
    if (equals(token, "solid")) {
      in_solid = true;
      tokens.skip_line();
    } else if (equals(token, "endsolid")) {
      in_solid = false;
      tokens.skip_line();
    } else if (equals(token, "facet")) {
      expect("normal");
      for (int k = 0; k < 3; ++k)
        if (tokens.next().empty()) throw truncated();
      expect("outer");
      expect("loop");
      const std::size_t facet = mesh.triangles.size();
      for (std::size_t k = 0; k < 3; ++k) {
        expect("vertex");
        Eigen::Vector3d v;
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
          const std::string_view number = tokens.next();
          if (number.empty()) throw truncated();
          const double value = parse_number(number);
          if (!std::isfinite(value)) fail_vertex(file, facet, k, quoted(number));
          v[axis] = value * scale;
        }
        add_vertex(mesh, v);
      }
      expect("endloop");
      expect("endfacet");
    } else {
      throw InputError(file + ": after triangle " + std::to_string(mesh.triangles.size()) + " comes '" +
                       quoted(token) + "'; must be 'facet' or 'endsolid'");
    }
  }
  if (in_solid) throw truncated();
  return mesh;
}

bool looks_ascii(std::string_view text) {
  Tokens tokens(text.substr(0, 4096));
  if (!equals(tokens.next(), "solid")) return false;
  // Text, not numbers: a binary file that begins with "solid" has zero bytes in its header or first facets.
  return text.substr(0, 4096).find('\0') == std::string_view::npos;
}

}  // namespace

double millimetres_in(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::centimetre:
      return 10.0;
    case LengthUnit::metre:
      return 1000.0;
    case LengthUnit::millimetre:
      break;
  }
  return 1.0;
}

std::string_view name_of(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::centimetre:
      return "cm";
    case LengthUnit::metre:
      return "m";
    case LengthUnit::millimetre:
      break;
  }
  return "mm";
}

LengthUnit parse_length_unit(std::string_view name, const std::string& label) {
  for (LengthUnit unit : {LengthUnit::millimetre, LengthUnit::centimetre, LengthUnit::metre})
    if (name == name_of(unit)) return unit;
  throw InputError(label + " is \"" + quoted(name) + "\"; must be \"mm\", \"cm\" or \"m\"");
}

TriangleMesh parse_stl(std::span<const std::byte> bytes, const std::string& file_label, LengthUnit unit) {
  const double scale = millimetres_in(unit);
  if (bytes.empty()) throw InputError(file_label + ": length is 0 bytes; must be an STL file with triangles");
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const bool has_header = bytes.size() >= header_bytes;
  const std::uint64_t count = has_header ? read_u32(bytes.data() + 80) : 0;
  const bool binary = has_header && header_bytes + count * facet_bytes == bytes.size();
  TriangleMesh mesh;
  if (binary) {
    mesh = parse_binary(bytes, file_label, scale);
  } else if (looks_ascii(text)) {
    mesh = parse_ascii(text, file_label, scale);
  } else if (!has_header) {
    throw InputError(file_label + ": length is " + std::to_string(bytes.size()) +
                     " bytes; a binary STL has at least 84, an ASCII one begins with 'solid'");
  } else {
    throw InputError(file_label + ": triangle count is " + std::to_string(count) + " but the " +
                     std::to_string(bytes.size()) + " bytes hold " +
                     std::to_string((bytes.size() - header_bytes) / facet_bytes) +
                     "; a binary STL must have 84 + 50 bytes per triangle (truncated, or not an STL?)");
  }
  if (mesh.triangles.empty()) throw InputError(file_label + ": triangle count is 0; must be > 0");
  return mesh;
}

std::vector<std::byte> write_binary_stl(const TriangleMesh& mesh) {
  std::vector<std::byte> out(80, std::byte{0});
  out.reserve(header_bytes + facet_bytes * mesh.triangles.size());
  std::memcpy(out.data(), "endowire, mm", 12);
  write_u32(out, static_cast<std::uint32_t>(mesh.triangles.size()));
  const auto write = [&](const Eigen::Vector3d& v) {
    for (int k = 0; k < 3; ++k) write_u32(out, base::bits_as<std::uint32_t>(static_cast<float>(v[k])));
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    write(mesh.area_normal(t).stableNormalized());
    for (std::size_t k = 0; k < 3; ++k) write(mesh.corner(t, k));
    out.insert(out.end(), 2, std::byte{0});
  }
  return out;
}

std::string write_ascii_stl(const TriangleMesh& mesh, std::string_view name) {
  std::string out = "solid " + std::string(name) + "\n";
  const auto write = [&](const char* word, const Eigen::Vector3d& v) {
    char line[128];
    std::snprintf(line, sizeof line, "%s %.9g %.9g %.9g\n", word, v.x(), v.y(), v.z());
    out += line;
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    write(" facet normal", mesh.area_normal(t).stableNormalized());
    out += "  outer loop\n";
    for (std::size_t k = 0; k < 3; ++k) write("   vertex", mesh.corner(t, k));
    out += "  endloop\n endfacet\n";
  }
  return out + "endsolid " + std::string(name) + "\n";
}

}  // namespace endowire::vessel
