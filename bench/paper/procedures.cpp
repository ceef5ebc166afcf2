#include "procedures.hpp"

#include <cmath>
#include <filesystem>
#include <numbers>

#include "endowire/io/centreline_file.hpp"
#include "endowire/io/scene_file.hpp"
#include "endowire/io/scene_vessel.hpp"
#include "endowire/vessel/analytic_field.hpp"
#include "endowire/vessel/closure.hpp"
#include "endowire/vessel/surface.hpp"
#include "support/swept_meshes.hpp"

namespace endowire::paper {

namespace {

constexpr double kMicrowireRadius_mm = 0.1778;  // 0.014"
constexpr double kBeforeBend_mm = 20.0;
constexpr double kBeyondBend_mm = 30.0;

rod::Section microwire_section(double length_mm, double at_tip_n_mm2, double at_hand_n_mm2) {
  rod::Section section;
  section.length_mm = length_mm;
  section.flexural_rigidity_n_mm2 = {at_tip_n_mm2, at_hand_n_mm2};
  section.torsional_rigidity_n_mm2 = {at_tip_n_mm2 / 1.3, at_hand_n_mm2 / 1.3};  // a solid round core
  section.axial_rigidity_n = {1500.0, 1500.0};
  section.radius_mm = {kMicrowireRadius_mm, kMicrowireRadius_mm};
  section.linear_density_g_per_mm = 6e-4;
  section.friction = 0.05;
  return section;
}

/// The triangles of a vessel, closed, and distances to them.
struct Triangles {
  explicit Triangles(const vessel::RepairedMesh& repaired)
      : closed(vessel::close_surface(repaired, 60.0)), surface(closed.mesh) {}
  vessel::ClosedSurface closed;
  vessel::ExactSurface surface;
};

/// All of a vessel but its access.
Vessel prepared(const io::VesselMesh& mesh) {
  const auto triangles = std::make_shared<const Triangles>(mesh.repaired);
  Vessel vessel;
  vessel.field = io::prepare_field(mesh, {}).field;
  vessel.exact_mm = [triangles](const Eigen::Vector3d& p) { return triangles->surface.at(p).distance_mm; };
  vessel.tree = io::prepare_centrelines(mesh, {});
  vessel.triangles = mesh.repaired.mesh.triangles.size();
  return vessel;
}

}  // namespace

double Bend::longest_rod_mm() const {
  return 4.0 * std::sqrt(radius_mm * (0.5 * lumen_mm - kMicrowireRadius_mm));
}

rod::Instrument straight_microwire() {
  rod::Instrument wire;
  wire.model = "straight microwire";
  wire.sections = {microwire_section(500.0, 10.0, 10.0)};
  return wire;
}

rod::Instrument curved_microwire() {
  rod::Instrument wire;
  wire.model = "curved microwire";
  wire.sections = {microwire_section(8.0, 2.0, 2.0), microwire_section(30.0, 2.0, 5.0),
                   microwire_section(60.0, 5.0, 20.0), microwire_section(900.0, 20.0, 20.0)};
  wire.sections.front().rest_curvature_per_mm = 50.0 * std::numbers::pi / 180.0 / 8.0;
  return wire;
}

namespace {

/// The hand, the wire and the sheath of a bend; its vessel is still to come.
Procedure through(const Bend& bend) {
  Procedure procedure;
  procedure.name = "bend";
  procedure.vessel.access = {-kBeforeBend_mm * Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitZ()};
  procedure.wire = straight_microwire();
  procedure.spec.gravity_m_per_s2.setZero();
  const double way_mm = kBeforeBend_mm + std::numbers::pi * bend.radius_mm + kBeyondBend_mm;
  procedure.commands.assign(static_cast<std::size_t>(std::ceil(way_mm)), {1.0, 0.0});
  return procedure;
}

}  // namespace

Procedure push_through(const Bend& bend) {
  Procedure procedure = through(bend);
  const auto tube = std::make_shared<const vessel::BentTubeField>(
      Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(), bend.radius_mm,
      std::numbers::pi, 0.5 * bend.lumen_mm);
  procedure.vessel.field = tube;
  procedure.vessel.exact_mm = [tube](const Eigen::Vector3d& p) { return tube->at(p).distance_mm; };
  return procedure;
}

Procedure push_through_mesh(const Bend& bend) {
  constexpr double straight_mm = kBeyondBend_mm + 20.0;
  constexpr double ring_mm = 1.0;
  std::vector<Eigen::Vector3d> axis =
      test::bent_curve(straight_mm, bend.radius_mm, std::numbers::pi, ring_mm);
  for (Eigen::Vector3d& point : axis) point.z() -= straight_mm;
  const std::vector<double> radii(axis.size(), 0.5 * bend.lumen_mm);
  io::VesselMesh mesh;
  mesh.repaired = vessel::repair(test::swept_tube(axis, radii, 24, true), "bend");
  Procedure procedure = through(bend);
  const sim::Access access = procedure.vessel.access;
  procedure.vessel = prepared(mesh);
  procedure.vessel.access = access;
  return procedure;
}

Procedure turned(Procedure procedure, double turn_deg) {
  procedure.commands.front().torque_rad += turn_deg * std::numbers::pi / 180.0;
  return procedure;
}

Procedure shipped_scene(const std::string& file) {
  const std::filesystem::path root = ENDOWIRE_SOURCE_DIR;
  const io::SceneFile scene = io::read_scene_file(root / "scenes" / file, {root / "instruments"});
  const io::VesselMesh mesh = io::vessel_of(scene);
  Procedure procedure;
  procedure.name = file.substr(0, file.find('.'));
  procedure.vessel = prepared(mesh);
  procedure.vessel.access = io::access_of(scene, mesh, *procedure.vessel.tree);
  procedure.wire = scene.instrument;
  procedure.spec = scene.simulation;
  for (const io::TimedCommand& timed : io::commands_of(scene)) procedure.commands.push_back(timed.command);
  procedure.target = io::target_of(scene, mesh, *procedure.vessel.tree);
  return procedure;
}

Procedure push_into(const std::string& anatomy, double advance_mm, double turn_deg_per_mm) {
  vessel::GenerateRequest request;
  request.name = anatomy;
  const io::VesselMesh mesh = io::generate_vessel(request);
  Procedure procedure;
  procedure.name = anatomy;
  procedure.vessel = prepared(mesh);
  procedure.vessel.access = mesh.access.value();
  procedure.wire = curved_microwire();
  procedure.commands.assign(static_cast<std::size_t>(advance_mm),
                            {1.0, turn_deg_per_mm * std::numbers::pi / 180.0});
  return procedure;
}

}  // namespace endowire::paper
