#include "endowire/vessel/ply.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "endowire/base/bits.hpp"
#include "endowire/base/error.hpp"
#include "endowire/vessel/text_tokens.hpp"

namespace endowire::vessel {
namespace {

using base::InputError;

enum class Type : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct TypeName {
  std::string_view old, plain;
  Type type;
  std::size_t bytes;
};
constexpr std::array<TypeName, 8> type_names{{{"char", "int8", Type::int8, 1},
                                              {"uchar", "uint8", Type::uint8, 1},
                                              {"short", "int16", Type::int16, 2},
                                              {"ushort", "uint16", Type::uint16, 2},
                                              {"int", "int32", Type::int32, 4},
                                              {"uint", "uint32", Type::uint32, 4},
                                              {"float", "float32", Type::float32, 4},
                                              {"double", "float64", Type::float64, 8}}};

const TypeName& named(std::string_view word, const std::string& file) {
  for (const TypeName& name : type_names)
    if (word == name.old || word == name.plain) return name;
  throw InputError(file + ": a property has type '" + quoted(word) +
                   "'; must be char, uchar, short, ushort, int, uint, float or double");
}

const TypeName& name_of(Type type) {
  return type_names[static_cast<std::size_t>(type)];
}

struct Property {
  std::string name;
  Type type = Type::float32;
  bool list = false;
  Type count = Type::uint8;  ///< of a list
};

struct Element {
  std::string name;
  double count = 0.0;  ///< as claimed
  std::vector<Property> properties;
};

enum class Encoding : std::uint8_t { text, little_endian, big_endian };

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;
};

Property property_of(Tokens& words, const std::string& file) {
  Property property;
  std::string_view word = words.next();
  if (word == "list") {
    property.list = true;
    property.count = named(words.next(), file).type;
    word = words.next();
  }
  property.type = named(word, file).type;
  property.name = words.next();
  return property;
}

Header header_of(Tokens& lines, const std::string& file) {
  Header header;
  bool has_format = false;
  while (!lines.at_end()) {
    Tokens words(lines.line());
    const std::string_view what = words.next();
    if (what == "end_header") {
      if (!has_format) break;
      return header;
    }
    if (what == "format") {
      const std::string_view encoding = words.next();
      has_format = true;
      if (encoding == "binary_little_endian") {
        header.encoding = Encoding::little_endian;
      } else if (encoding == "binary_big_endian") {
        header.encoding = Encoding::big_endian;
      } else if (encoding != "ascii") {
        throw InputError(file + ": format is '" + quoted(encoding) +
                         "'; must be ascii, binary_little_endian or binary_big_endian");
      }
    } else if (what == "element") {
      Element element;
      element.name = words.next();
      const std::string_view count = words.next();
      element.count = parse_number(count);
      if (!(element.count >= 0.0) || element.count != std::floor(element.count))
        throw InputError(file + ": element " + quoted(element.name) + " has count '" + quoted(count) +
                         "'; must be a whole number >= 0");
      header.elements.push_back(std::move(element));
    } else if (what == "property") {
      if (header.elements.empty()) throw InputError(file + ": a property stands before the first element");
      header.elements.back().properties.push_back(property_of(words, file));
    }
  }
  throw InputError(file + ": the header has no " + (has_format ? "end_header" : "format") +
                   " line; must be a PLY file");
}

/// The values behind the header, one after the other.
class Values {
 public:
  Values(std::span<const std::byte> bytes, std::size_t at, Encoding encoding, const std::string& file)
      : bytes_(bytes),
        at_(at),
        text_(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()).substr(at)),
        encoding_(encoding),
        file_(file) {}

  double next(Type type) {
    if (encoding_ == Encoding::text) {
      const std::string_view word = text_.next();
      if (word.empty()) ends();
      return parse_number(word);
    }
    const std::size_t size = name_of(type).bytes;
    if (bytes_.size() - at_ < size) ends();
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t place = encoding_ == Encoding::little_endian ? size - 1 - k : k;
      bits = bits << 8U | std::to_integer<std::uint64_t>(bytes_[at_ + place]);
    }
    at_ += size;
    return value_of(type, bits);
  }

  /// What is left can hold no more values than this.
  [[nodiscard]] double most(Type type) const {
    const std::size_t values =
        encoding_ == Encoding::text ? bytes_.size() : (bytes_.size() - at_) / name_of(type).bytes;
    return static_cast<double>(values);
  }

  [[noreturn]] void ends() const {
    throw InputError(file_ + ": ends before all that its header counts; must be whole");
  }

 private:
  static double value_of(Type type, std::uint64_t bits) {
    switch (type) {
      case Type::int8:
        return static_cast<std::int8_t>(bits);
      case Type::int16:
        return static_cast<std::int16_t>(bits);
      case Type::int32:
        return static_cast<std::int32_t>(bits);
      case Type::float32:
        return static_cast<double>(base::bits_as<float>(static_cast<std::uint32_t>(bits)));
      case Type::float64:
        return base::bits_as<double>(bits);
      case Type::uint8:
      case Type::uint16:
      case Type::uint32:
        break;
    }
    return static_cast<double>(bits);
  }

  std::span<const std::byte> bytes_;
  std::size_t at_;
  Tokens text_;
  Encoding encoding_;
  const std::string& file_;
};

/// How many values a property has here.
double count_of(Values& values, const Property& property) {
  if (!property.list) return 1.0;
  const double count = values.next(property.count);
  if (!(count >= 0.0) || count > values.most(property.type)) values.ends();
  return count;
}

void skip(Values& values, const Property& property) {
  const double count = count_of(values, property);
  for (double k = 0.0; k < count; ++k) static_cast<void>(values.next(property.type));
}

void read_vertex(Values& values, const Element& element, TriangleMesh& mesh, const std::string& file) {
  Eigen::Vector3d vertex = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  for (const Property& property : element.properties) {
    if (property.list) {
      skip(values, property);
      continue;
    }
    const double value = values.next(property.type);
    if (property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z')
      vertex[property.name[0] - 'x'] = value;
  }
  if (!vertex.allFinite())
    throw InputError(file + ": vertex " + std::to_string(mesh.vertices_mm.size() + 1) +
                     " has no finite x, y and z; must have all three");
  mesh.vertices_mm.push_back(vertex);
}

void read_face(Values& values, const Element& element, TriangleMesh& mesh, const std::string& file) {
  for (const Property& property : element.properties) {
    const double count = count_of(values, property);
    const bool corners =
        property.list && (property.name == "vertex_indices" || property.name == "vertex_index");
    std::array<std::int32_t, 3> triangle{};
    for (double k = 0.0; k < count; ++k) {
      const double value = values.next(property.type);
      if (!corners) continue;
      if (!(value >= 0.0 && value < static_cast<double>(mesh.vertices_mm.size())) ||
          value != std::floor(value))
        throw InputError(file + ": a face after triangle " + std::to_string(mesh.triangles.size()) +
                         " has a corner that is none of the " + std::to_string(mesh.vertices_mm.size()) +
                         " vertices before it");
      triangle[k == 0.0 ? 0 : 2] = static_cast<std::int32_t>(value);
      if (k >= 2.0) mesh.triangles.push_back(triangle);
      if (k >= 1.0) triangle[1] = triangle[2];
    }
  }
}

}  // namespace

TriangleMesh parse_ply(std::span<const std::byte> bytes, const std::string& file_label) {
  Tokens lines(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  if (lines.line() != "ply") throw InputError(file_label + ": does not begin with 'ply'; must be a PLY file");
  const Header header = header_of(lines, file_label);
  Values values(bytes, lines.position(), header.encoding, file_label);
  TriangleMesh mesh;
  for (const Element& element : header.elements) {
    // An element without properties takes no bytes: its count says nothing and is not counted through.
    if (element.properties.empty()) continue;
    if (element.count >
        static_cast<double>(std::min<std::size_t>(
            bytes.size(), static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))))
      throw InputError(file_label + ": element " + quoted(element.name) + " has count " +
                       std::to_string(element.count) + "; the " + std::to_string(bytes.size()) +
                       " bytes do not hold as many");
    for (double k = 0.0; k < element.count; ++k) {
      if (element.name == "vertex") {
        read_vertex(values, element, mesh, file_label);
      } else if (element.name == "face") {
        read_face(values, element, mesh, file_label);
      } else {
        for (const Property& property : element.properties) skip(values, property);
      }
    }
  }
  if (mesh.triangles.empty()) throw InputError(file_label + ": there are no faces; must be > 0");
  return mesh;
}

}  // namespace endowire::vessel
