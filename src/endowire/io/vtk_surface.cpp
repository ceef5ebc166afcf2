#include "endowire/io/vtk_surface.hpp"

#include "endowire/base/error.hpp"

#ifdef ENDOWIRE_WITH_VTK
#include <fmt/format.h>
#include <vtkDataSet.h>
#include <vtkDataSetReader.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>
#include <vtkTriangleFilter.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "endowire/io/file.hpp"
#include "endowire/io/mesh_bytes.hpp"
#include "endowire/io/own_process.hpp"
#include "endowire/io/vtk_poly_data.hpp"
#include "endowire/vessel/text_tokens.hpp"
#endif

namespace endowire::io {

using base::InputError;

#ifdef ENDOWIRE_WITH_VTK

namespace {

/// zlib packs 1032 bytes into one at most.
constexpr double most_packed = 1032.0;
/// The reader takes the length of what it reads as an int.
constexpr std::size_t max_legacy_bytes = 0x7fffffff;
/// Tags of XML within each other; those of VTK are six deep.
constexpr int max_depth = 64;

/// Keeps what VTK says instead of printing it, while it lives.
class Listener : public vtkOutputWindow {
 public:
  static Listener* New() {  // NOLINT(readability-identifier-naming): VTK's name
    auto* listener = new Listener;
    listener->InitializeObjectBase();
    return listener;
  }
  void DisplayText(const char* text) override {
    if (said_.empty()) said_ = text;
  }
  [[nodiscard]] const std::string& said() const { return said_; }

 private:
  std::string said_;
};

class Listening {
 public:
  Listening() : before_(vtkOutputWindow::GetInstance()), verbosity_(vtkLogger::GetCurrentVerbosityCutoff()) {
    vtkOutputWindow::SetInstance(listener_);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  }
  Listening(const Listening&) = delete;
  Listening& operator=(const Listening&) = delete;
  ~Listening() {
    vtkLogger::SetStderrVerbosity(verbosity_);
    vtkOutputWindow::SetInstance(before_);
  }
  /// The first complaint; empty when there was none.
  [[nodiscard]] std::string said() const {
    const std::string& all = listener_->said();
    const std::size_t colon = all.find("): ");  // behind class and address
    return one_line(colon == std::string::npos ? all : all.substr(colon + 3)).substr(0, 200);
  }

 private:
  vtkSmartPointer<vtkOutputWindow> before_;
  vtkLogger::Verbosity verbosity_;
  vtkNew<Listener> listener_;
};

[[noreturn]] void refuse_count(const std::string& file, std::string_view name, std::string_view count,
                               double most) {
  throw InputError(
      fmt::format("{}: {} is {}; the file holds at most {:.0f}", file, name, vessel::quoted(count), most));
}

void check_count(const std::string& file, std::string_view name, std::string_view count, double most) {
  const double number = vessel::parse_number(count);
  if (!(number >= 0.0 && number <= most)) refuse_count(file, name, count, most);
}

/// Counts of the legacy format stand behind their keywords, alone on a line; numbers take a byte at least.
void check_legacy_counts(const std::string& bytes, const std::string& file) {
  constexpr std::array<std::string_view, 12> keywords{
      "POINTS",     "POLYGONS",   "TRIANGLE_STRIPS", "VERTICES", "LINES",        "CELLS",
      "CELL_TYPES", "POINT_DATA", "CELL_DATA",       "FIELD",    "LOOKUP_TABLE", "CONNECTIVITY"};
  const auto most = static_cast<double>(bytes.size());
  vessel::Tokens lines(bytes);
  while (!lines.at_end()) {
    vessel::Tokens words(lines.line());
    const std::string_view first = words.next();
    for (const std::string_view keyword : keywords) {
      if (first != keyword) continue;
      // POINTS n type; POLYGONS n size; FIELD name n; LOOKUP_TABLE name n
      for (int k = 0; k < 2; ++k) {
        const std::string_view word = words.next();
        if (std::isfinite(vessel::parse_number(word))) check_count(file, keyword, word, most);
      }
    }
  }
}

/// Counts of the XML formats are attributes; tags are not nested without end.
void check_xml_counts(const std::string& bytes, const std::string& file) {
  constexpr std::array<std::string_view, 7> attributes{"NumberOfPoints", "NumberOfVerts", "NumberOfLines",
                                                       "NumberOfStrips", "NumberOfPolys", "NumberOfCells",
                                                       "NumberOfTuples"};
  const double most = most_packed * static_cast<double>(bytes.size());
  for (const std::string_view attribute : attributes)
    for (std::size_t at = bytes.find(attribute); at != std::string::npos;
         at = bytes.find(attribute, at + 1)) {
      std::size_t begin = at + attribute.size();
      while (begin < bytes.size() && (bytes[begin] == '=' || bytes[begin] == ' ' || bytes[begin] == '"'))
        ++begin;
      const std::size_t end = bytes.find_first_of("\"' >", begin);
      if (end == std::string::npos) break;
      check_count(file, attribute, std::string_view(bytes).substr(begin, end - begin), most);
    }
  int depth = 0;
  const std::size_t appended = bytes.find("<AppendedData");
  for (std::size_t at = bytes.find('<'); at < appended && at + 1 < bytes.size();
       at = bytes.find('<', at + 1)) {
    const std::size_t end = bytes.find('>', at);
    if (bytes[at + 1] == '/') {
      --depth;
    } else if (bytes[at + 1] != '?' && bytes[at + 1] != '!' && end != std::string::npos &&
               bytes[end - 1] != '/') {
      ++depth;
    }
    if (depth > max_depth)
      throw InputError(
          fmt::format("{}: its tags are more than {} deep; must be a VTK file", file, max_depth));
  }
}

/// What every reader ends in.
vessel::TriangleMesh triangles_of(vtkDataSet* data, const std::string& said, const std::string& file) {
  const std::string reason = said.empty() ? std::string() : ": " + said;
  if (data == nullptr || data->GetNumberOfPoints() == 0)
    throw InputError(file + ": VTK finds no points in it" + reason);
  if (!said.empty()) throw InputError(file + ": VTK cannot read it" + reason);
  if (data->GetNumberOfPoints() > std::numeric_limits<std::int32_t>::max())
    throw InputError(file + ": has more than 2147483647 points");
  // A corner that is no point would be read from beside the points, by VTK too.
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell) {
    data->GetCellPoints(cell, corners);
    for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k)
      if (corners->GetId(k) < 0 || corners->GetId(k) >= data->GetNumberOfPoints())
        throw InputError(fmt::format("{}: cell {} has corner {}; must be 0 … {}", file, cell,
                                     corners->GetId(k), data->GetNumberOfPoints() - 1));
  }
  vtkNew<vtkDataSetSurfaceFilter> outside;
  outside->SetInputData(data);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(outside->GetOutputPort());
  triangles->PassVertsOff();
  triangles->PassLinesOff();
  triangles->Update();
  vessel::TriangleMesh mesh = from_vtk(*triangles->GetOutput());
  if (mesh.triangles.empty()) throw InputError(file + ": holds no faces; must be a surface");
  for (std::size_t v = 0; v < mesh.vertices_mm.size(); ++v)
    if (!mesh.vertices_mm[v].allFinite())
      throw InputError(fmt::format("{}: point {} is not finite; must be three finite numbers", file, v));
  return mesh;
}

/// VTK's readers crash on some damaged files: they read in a process of their own.
template <class Read>
vessel::TriangleMesh alone(std::size_t file_bytes, const std::string& file, Read read) {
  constexpr std::size_t spare = std::size_t{512} << 20;
  constexpr std::size_t copies = 64;  // of the file, at most, that VTK holds of its content in its own types
  return unpack_mesh(in_own_process([&] { return pack_mesh(read()); }, spare + copies * file_bytes, file),
                     file);
}

template <class Reader>
vessel::TriangleMesh read_xml(const std::string& bytes, const std::string& file) {
  const Listening listening;
  vtkNew<Reader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(bytes);
  reader->Update();
  return triangles_of(reader->GetOutput(), listening.said(), file);
}

}  // namespace

vessel::TriangleMesh parse_legacy_vtk(const std::string& bytes, const std::string& file_label) {
  if (bytes.size() > max_legacy_bytes)
    throw InputError(
        fmt::format("{}: is {} bytes long; must be <= {}", file_label, bytes.size(), max_legacy_bytes));
  check_legacy_counts(bytes, file_label);
  return alone(bytes.size(), file_label, [&] {
    const Listening listening;
    vtkNew<vtkDataSetReader> reader;
    reader->ReadFromInputStringOn();
    reader->SetBinaryInputString(bytes.data(), static_cast<int>(bytes.size()));
    reader->Update();
    return triangles_of(reader->GetOutput(), listening.said(), file_label);
  });
}

vessel::TriangleMesh parse_vtk_xml(const std::string& bytes, const std::string& file_label) {
  check_xml_counts(bytes, file_label);
  const std::string_view begin = std::string_view(bytes).substr(0, 4096);
  if (begin.find("PolyData") != std::string_view::npos)
    return alone(bytes.size(), file_label, [&] { return read_xml<vtkXMLPolyDataReader>(bytes, file_label); });
  if (begin.find("UnstructuredGrid") != std::string_view::npos)
    return alone(bytes.size(), file_label,
                 [&] { return read_xml<vtkXMLUnstructuredGridReader>(bytes, file_label); });
  throw InputError(file_label + ": is no VTK file of PolyData or UnstructuredGrid; must be a surface");
}

#else

namespace {

[[noreturn]] void refuse(const std::string& file) {
  throw InputError(file +
                   ": is a VTK file; this build has no VTK (ENDOWIRE_WITH_VTK is off) and reads STL, PLY and "
                   "OBJ surfaces");
}

}  // namespace

vessel::TriangleMesh parse_legacy_vtk(const std::string&, const std::string& file_label) {
  refuse(file_label);
}

vessel::TriangleMesh parse_vtk_xml(const std::string&, const std::string& file_label) {
  refuse(file_label);
}

#endif

}  // namespace endowire::io
