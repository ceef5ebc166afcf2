#include "recording.hpp"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "input_error.hpp"
#include "quiet_errors.hpp"

namespace crossings {

using Eigen::Vector3d;

std::pair<std::size_t, double> Axis::locate(double arc) const {
  const auto after = std::upper_bound(arc_mm.begin() + 1, arc_mm.end() - 1, arc);
  const auto i = static_cast<std::size_t>(after - arc_mm.begin()) - 1;
  return {i, std::clamp((arc - arc_mm[i]) / (arc_mm[i + 1] - arc_mm[i]), 0.0, 1.0)};
}

Vector3d Axis::at(double arc) const {
  const auto [i, f] = locate(arc);
  return (1.0 - f) * points_mm[i] + f * points_mm[i + 1];
}

double Axis::radius_at(double arc) const {
  const auto [i, f] = locate(arc);
  return (1.0 - f) * radius_mm[i] + f * radius_mm[i + 1];
}

std::vector<RecordedFile> read_collection(const std::string& path) {
  namespace fs = std::filesystem;
  if (!fs::is_regular_file(path)) throw InputError(path + ": no such file");
  const auto root =
      vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(path.c_str()));
  vtkXMLDataElement* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
  if (collection == nullptr) throw InputError(path + ": not a .pvd file (no <Collection>)");
  std::vector<RecordedFile> files;
  for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* element = collection->GetNestedElement(i);
    const char* file = element->GetAttribute("file");
    if (std::string(element->GetName()) != "DataSet" || file == nullptr) continue;
    RecordedFile entry;
    element->GetScalarAttribute("timestep", entry.time);
    element->GetScalarAttribute("part", entry.part);
    entry.path = (fs::path(path).parent_path() / file).string();
    files.push_back(entry);
  }
  if (files.empty()) throw InputError(path + ": names no files; a recording has at least one step");
  std::stable_sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  return files;
}

namespace {

std::vector<double> column(vtkPolyData& data, const std::vector<vtkIdType>& order, const char* name) {
  std::vector<double> values;
  vtkDataArray* array = data.GetPointData()->GetArray(name);
  if (array == nullptr) return values;
  for (const vtkIdType id : order) values.push_back(array->GetComponent(id, 0));
  return values;
}

std::vector<vtkIdType> order_of_points(vtkPolyData& data) {
  std::vector<vtkIdType> order;
  vtkCellArray* lines = data.GetLines();
  vtkNew<vtkIdList> ids;
  for (lines->InitTraversal(); lines->GetNextCell(ids) != 0;) {
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k) {
      if (order.empty() || order.back() != ids->GetId(k)) order.push_back(ids->GetId(k));
    }
  }
  for (vtkIdType id = 0; order.empty() && id < data.GetNumberOfPoints(); ++id) order.push_back(id);
  return order;
}

/// Arc of the point of the polyline that is nearest to `target`.
double arc_nearest(const Axis& axis, const Vector3d& target) {
  double best = std::numeric_limits<double>::infinity();
  double arc = 0.0;
  for (std::size_t i = 0; i + 1 < axis.points_mm.size(); ++i) {
    const Vector3d rod = axis.points_mm[i + 1] - axis.points_mm[i];
    const double f = std::clamp((target - axis.points_mm[i]).dot(rod) / rod.squaredNorm(), 0.0, 1.0);
    const double distance = (axis.points_mm[i] + f * rod - target).norm();
    if (distance < best) {
      best = distance;
      arc = axis.arc_mm[i] + f * (axis.arc_mm[i + 1] - axis.arc_mm[i]);
    }
  }
  return arc;
}

void require(bool condition, const std::string& message) {
  if (!condition) throw InputError(message);
}

}  // namespace

Axis read_axis(const std::string& path, std::optional<double> radius_mm,
               const std::optional<Vector3d>& sheath_mm) {
  require(std::filesystem::is_regular_file(path), path + ": no such file");
  vtkNew<vtkXMLPolyDataReader> reader;
  const QuietErrors errors(*reader);
  reader->SetFileName(path.c_str());
  reader->Update();
  require(errors.text().empty(), path + ": not a readable .vtp file (" + errors.text() + ")");
  vtkPolyData& data = *reader->GetOutput();
  const std::vector<vtkIdType> order = order_of_points(data);
  require(order.size() >= 2,
          path + ": holds " + std::to_string(order.size()) + " points; a wire has at least 2");

  Axis axis;
  for (const vtkIdType id : order) {
    Vector3d point;
    data.GetPoint(id, point.data());
    require(point.allFinite(),
            path + ": point " + std::to_string(id) + " has a coordinate that is not finite");
    axis.points_mm.push_back(point);
  }
  axis.arc_mm = column(data, order, "arc_mm");
  if (axis.arc_mm.empty()) {
    axis.arc_mm.push_back(0.0);
    for (std::size_t i = 1; i < order.size(); ++i) {
      axis.arc_mm.push_back(axis.arc_mm.back() + (axis.points_mm[i] - axis.points_mm[i - 1]).norm());
    }
  }
  for (std::size_t i = 1; i < order.size(); ++i) {
    require(axis.arc_mm[i] > axis.arc_mm[i - 1], path + ": arc_mm[" + std::to_string(i) + "] is " +
                                                     std::to_string(axis.arc_mm[i]) +
                                                     "; must increase from the tip to the sheath");
  }
  axis.radius_mm =
      radius_mm ? std::vector<double>(order.size(), *radius_mm) : column(data, order, "radius_mm");
  require(!axis.radius_mm.empty(), path + ": has no radius_mm; give --radius-mm");
  for (const double r : axis.radius_mm) {
    require(std::isfinite(r) && r > 0.0, path + ": radius_mm is " + std::to_string(r) + "; must be > 0");
  }
  vtkDataArray* inserted = data.GetFieldData()->GetArray("inserted_length_mm");
  if (sheath_mm) {
    axis.inserted_mm = arc_nearest(axis, *sheath_mm);
  } else if (inserted != nullptr && inserted->GetNumberOfTuples() > 0) {
    axis.inserted_mm = inserted->GetComponent(0, 0);
    require(std::isfinite(axis.inserted_mm), path + ": inserted_length_mm is not finite");
  } else {
    axis.inserted_mm = axis.arc_mm.back();
  }
  axis.inserted_mm = std::min(axis.inserted_mm, axis.arc_mm.back());
  return axis;
}

}  // namespace crossings
