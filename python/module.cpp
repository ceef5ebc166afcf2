// The module `endowire`: the names, units and signs of C++. Docstrings begin with the signature or the type, from which write_stub.py makes
// endowire.pyi: what pybind11 writes itself differs from version to version.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "endowire/base/error.hpp"
#include "endowire/io/statistics.hpp"
#include "endowire/io/version.hpp"
#include "wires.hpp"

namespace endowire::python {

namespace py = pybind11;

namespace {

using Path = std::optional<std::filesystem::path>;
using Seed = std::optional<std::uint64_t>;
using release = py::call_guard<py::gil_scoped_release>;

// ---- numbers as NumPy sees them

constexpr auto stride = static_cast<py::ssize_t>(sizeof(sim::SnapshotPoint));

/// A view that keeps its owner alive and cannot be written to.
py::array view(const double* first, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides,
               const py::object& owner) {
  py::array_t<double> array(std::move(shape), std::move(strides), first, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

py::array view(const Eigen::Vector3d& vector, const py::object& owner) {
  return view(vector.data(), {3}, {sizeof(double)}, owner);
}

/// A number of every joint, as a property.
template <double sim::SnapshotPoint::*number>
py::array numbers(const py::object& self) {
  const auto& points = self.cast<const Observation&>().snapshot.points;
  return view(points.empty() ? nullptr : &(points.front().*number), {static_cast<py::ssize_t>(points.size())},
              {stride}, self);
}

template <Eigen::Vector3d sim::SnapshotPoint::*vector>
py::array vectors(const py::object& self) {
  const auto& points = self.cast<const Observation&>().snapshot.points;
  return view(points.empty() ? nullptr : (points.front().*vector).data(),
              {static_cast<py::ssize_t>(points.size()), 3}, {stride, sizeof(double)}, self);
}

/// An event with the name of its branch, which the vessel of its step knows.
struct NamedEvent {
  sim::Event event;
  std::string branch;
};

std::vector<NamedEvent> named_events(const Report& report) {
  std::vector<NamedEvent> all;
  for (const sim::Event& event : report.events) {
    const auto branch = static_cast<std::size_t>(event.branch);
    all.push_back(
        {event, event.branch < 0 ? "" : report.variant->prepared->centrelines->branches()[branch].name});
  }
  return all;
}

py::bytes bytes_of(const std::string& saved) {
  return {saved.data(), saved.size()};
}

/// What a call gives, without Python's lock while it runs.
template <class Call>
auto unlocked(Call call) {
  const py::gil_scoped_release free;
  return call();
}

// ---- arguments

/// Any integer of Python or NumPy.
Seed seed_of(const py::object& seed) {
  if (seed.is_none()) return std::nullopt;
  const auto number = py::reinterpret_steal<py::object>(PyNumber_Index(seed.ptr()));
  if (!number) throw py::error_already_set();
  const std::uint64_t value = PyLong_AsUnsignedLongLong(number.ptr());
  if (PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    throw base::InputError("seed is " + py::str(number).cast<std::string>() +
                           "; must be 0 … 18446744073709551615, or None");
  }
  return value;
}

sim::Command one_of(const std::optional<sim::Command>& command, double advance_mm, double torque_rad) {
  if (!command) return {advance_mm, torque_rad};
  if (advance_mm != 0.0 || torque_rad != 0.0)
    throw base::InputError("command is given beside advance_mm or torque_rad; must be given alone");
  return *command;
}

/// One number of each simulation, or one for all.
std::vector<double> one_each(const char* name, const py::object& given, std::size_t count) {
  const auto array = py::array::ensure(given);
  if (!array || std::string_view("biuf").find(array.dtype().kind()) == std::string_view::npos)
    throw py::type_error(std::string(name) + " must be real numbers");  // NumPy would read texts, and None
  const py::array_t<double, py::array::c_style | py::array::forcecast> numbers(array);
  if (numbers.ndim() == 0) return std::vector<double>(count, *numbers.data());
  if (numbers.ndim() != 1 || static_cast<std::size_t>(numbers.size()) != count)
    throw base::InputError(
        std::string(name) + " is an array of shape " + py::str(numbers.attr("shape")).cast<std::string>() +
        "; must be one number, or of shape (" + std::to_string(count) + ",), one a simulation");
  return {numbers.data(), numbers.data() + count};
}

std::vector<sim::Command> one_of(const std::optional<std::vector<sim::Command>>& commands,
                                 const py::object& advance_mm, const py::object& torque_rad,
                                 std::size_t count) {
  const std::vector<double> advances = one_each("advance_mm", advance_mm, count);
  const std::vector<double> torques = one_each("torque_rad", torque_rad, count);
  if (!commands) {
    std::vector<sim::Command> all(count);
    for (std::size_t i = 0; i < count; ++i) all[i] = {advances[i], torques[i]};
    return all;
  }
  const auto none = [](double v) { return v == 0.0; };
  if (!std::all_of(advances.begin(), advances.end(), none) ||
      !std::all_of(torques.begin(), torques.end(), none))
    throw base::InputError("commands is given beside advance_mm or torque_rad; must be given alone");
  return *commands;
}

// ---- the module

void define_numbers(py::module_& m) {
  py::class_<sim::Command>(m, "Command", "What the hand does in one step.")
      .def(py::init([](double advance_mm, double torque_rad) {
             return sim::Command{advance_mm, torque_rad};
           }),
           py::arg("advance_mm") = 0.0, py::arg("torque_rad") = 0.0,
           "__init__(self, advance_mm: float = 0.0, torque_rad: float = 0.0) -> None")
      .def_readonly("advance_mm", &sim::Command::advance_mm, "float: > 0 into the vessel")
      .def_readonly("torque_rad", &sim::Command::torque_rad,
                    "float: > 0 right-handed about the direction of advance");

  py::class_<NamedEvent>(m, "Event", "Something that began in a step.")
      .def_property_readonly(
          "kind", [](const NamedEvent& e) { return std::string(io::name_of(e.event.kind)); },
          "str: snap, perforation, kink, exit, too_narrow, hand_slip, not_converged, stall, new_branch or "
          "self_overlap")
      .def_property_readonly(
          "value", [](const NamedEvent& e) { return e.event.value; },
          "float: snap: longest way of a joint [mm]; perforation, stall, not_converged: force [N]; kink: "
          "curvature [1/mm]; exit: number of the opening; too_narrow, self_overlap: gap [mm], < 0; hand_slip "
          "[mm]; new_branch: radius of its lumen [mm]")
      .def_property_readonly(
          "position_mm",
          [](const py::object& self) { return view(self.cast<const NamedEvent&>().event.position_mm, self); },
          "numpy.ndarray: (3,)")
      .def_readonly("branch", &NamedEvent::branch, "str: of the centreline tree; empty: of none");

  py::class_<sim::TargetDistance>(m, "TargetDistance", "How the tip stands to the target of the scene.")
      .def_readonly("reached", &sim::TargetDistance::reached, "bool: the tip is there, or beyond")
      .def_readonly("to_go_mm", &sim::TargetDistance::to_go_mm,
                    "float: along the vessels, back out of a wrong branch included; 0 behind the goal")
      .def_readonly("offset_radii", &sim::TargetDistance::offset_radii,
                    "float: of the tip from the nearest centreline, in radii of the lumen there");
}

void define_report(py::module_& m) {
  using S = sim::StepReport;
  py::class_<Report> report(m, "StepReport", "What one step did.");
  const auto number = [&](const char* name, auto field, const char* doc) {
    report.def_property_readonly(
        name, [field](const Report& r) { return r.step.*field; }, doc);
  };
  number("converged", &S::converged,
         "bool: solved, and verified against the vessel; else the wire stays where it was");
  number("push_force_n", &S::push_force_n, "float: force of the hand on the wire, > 0 pushes");
  number("torque_n_mm", &S::torque_n_mm, "float: torque of the hand on the wire");
  number("inserted_length_mm", &S::inserted_length_mm, "float: of wire beyond the end of the sheath");
  number("hand_slip_mm", &S::hand_slip_mm, "float: commanded minus achieved advance");
  number("tip_force_n", &S::tip_force_n, "float: wall force within the last 5 mm");
  number("max_force_5mm_n", &S::max_force_5mm_n, "float: wall force over a sliding 5 mm, largest");
  number("max_wall_deflection_mm", &S::max_wall_deflection_mm, "float");
  number("snapped", &S::snapped, "bool: the wire left one equilibrium for another");
  number("walls_at_rest", &S::walls_at_rest,
         "bool: false where walls swung to and fro on an edge of the field");
  number("rods", &S::rods, "int");
  number("contact_samples", &S::contact_samples, "int");
  number("newton_iterations", &S::newton_iterations, "int");
  number("rods_divided", &S::rods_divided, "int: by the adaptive resolution; rods that enter not counted");
  number("rods_joined", &S::rods_joined, "int: same");
  number("resolution_energy_mj", &S::resolution_energy_mj,
         "float: sum of the sizes of the changes of energy by these");
  number("splits", &S::splits, "int: halvings of the command");
  number("detections", &S::detections, "float: collision detections, in units of the whole wire");
  number("verifications", &S::verifications, "int: checks of the final state against the field");
  report
      .def_property_readonly(
          "termination", [](const Report& r) { return std::string(io::name_of(r.step.solve.termination)); },
          "str: why the last minimisation ended")
      .def_property_readonly("events", &named_events, "list[Event]: each told once, when it begins");
}

void define_observation(py::module_& m) {
  using P = sim::SnapshotPoint;
  py::class_<Observation>(
      m, "Observation",
      R"(The wire between two steps, from the tip to the sheath: n joints, the last one in the sheath.

Nothing that is done to the simulation later changes it. Arrays are read-only views of float64 into the observation, which
they keep; they are strided: numpy.ascontiguousarray(view) packs one.)")
      .def_property_readonly("joints_mm", &vectors<&P::position_mm>,
                             "numpy.ndarray: (n, 3); n is 0 while the tip is in the sheath")
      .def_property_readonly("arc_mm", &numbers<&P::arc_mm>,
                             "numpy.ndarray: (n,), along the wire from the tip")
      .def_property_readonly("radius_mm", &numbers<&P::radius_mm>, "numpy.ndarray: (n,), of the wire")
      .def_property_readonly("curvature_per_mm", &numbers<&P::curvature_per_mm>, "numpy.ndarray: (n,)")
      .def_property_readonly("twist_rad", &numbers<&P::twist_rad>,
                             "numpy.ndarray: (n,), turn of the material about its axis")
      .def_property_readonly("wall_force_n_per_mm", &numbers<&P::wall_force_n_per_mm>,
                             "numpy.ndarray: (n,), normal force on the wall per length of wire")
      .def_property_readonly("friction_n_per_mm", &numbers<&P::friction_n_per_mm>, "numpy.ndarray: (n,)")
      .def_property_readonly("wall_force_direction", &vectors<&P::wall_force_direction>,
                             "numpy.ndarray: (n, 3), of the force on the wire")
      .def_property_readonly(
          "tip_mm", [](const py::object& self) { return view(self.cast<const Observation&>().tip_mm, self); },
          "numpy.ndarray: (3,); the end of the sheath while the tip is in it")
      .def_readonly("branch", &Observation::branch,
                    "str: that the tip lies in, as endowire inspect lists it; empty: the vessel has none")
      .def_readonly("target", &Observation::target,
                    "TargetDistance | None: none when the scene has no target")
      .def_property_readonly(
          "inserted_length_mm", [](const Observation& o) { return o.snapshot.inserted_length_mm; }, "float")
      .def_property_readonly(
          "push_force_n", [](const Observation& o) { return o.snapshot.push_force_n; },
          "float: as StepReport")
      .def_property_readonly(
          "torque_n_mm", [](const Observation& o) { return o.snapshot.torque_n_mm; }, "float: as StepReport");
}

void define_simulation(py::module_& m) {
  py::class_<Steered, std::shared_ptr<Steered>>(m, "Simulation",
                                                R"(One wire in one vessel, steered from outside.

Any number of simulations run at once on any number of threads: Python's lock is released while they compute. Calls to
one simulation wait for each other.)")
      .def(
          py::init([](const py::object& scene, const Path& cache_folder) {
            const auto path = py::module_::import("os").attr("fsencode")(scene).cast<std::string>();
            return unlocked([&] { return std::make_shared<Steered>(path, cache_folder); });
          }),
          py::arg("scene"), py::arg("cache_folder") = py::none(),
          R"(__init__(self, scene: str | os.PathLike[str], cache_folder: str | os.PathLike[str] | None = None) -> None

Reads a scene and prepares its vessel. `scene` is a path, or the text of a scene when it holds a line break; paths in a
text are relative to the working directory. Motions may be left out. Prepared vessels are kept in `cache_folder`, by
default that of the program; "" keeps none. Raises InputError with the program's message.)")
      .def(
          "reset",
          [](Steered& self, const py::object& seed) {
            const Seed number = seed_of(seed);
            unlocked([&] { self.reset(number); });
          },
          py::arg("seed") = py::none(),
          R"(reset(self, seed: int | None = None) -> None

Back to the start: the tip in the sheath. None: as the scene says. A seed picks a variant, the same for the same seed: it
draws the dimensions of a generated vessel that the scene does not give (a seed of the scene is replaced; a vessel from a
file stays), and turns the instrument at the hand by an angle between -pi and pi. Nothing else is random. A new vessel is
prepared, in the order of a second, and not kept in the cache; a place that the scene gives may lie outside of it, which
raises InputError and changes nothing. To come back to a start soon, save() it after reset() and restore() it.)")
      .def(
          "step",
          [](Steered& self, const std::optional<sim::Command>& command, double advance_mm,
             double torque_rad) { return self.step(one_of(command, advance_mm, torque_rad)); },
          py::arg("command") = py::none(), py::kw_only(), py::arg("advance_mm") = 0.0,
          py::arg("torque_rad") = 0.0, release(),
          R"(step(self, command: Command | None = None, *, advance_mm: float = 0.0, torque_rad: float = 0.0) -> StepReport

Moves the hand and finds the new equilibrium. Either a command or its numbers; nothing: the hand rests. Not converging is no
exception: read the report. So it is with a command that is not finite, which moves nothing.)")
      .def("observe", &Steered::observe, release(), R"(observe(self) -> Observation

The wire as the last step left it, or reset or restore put it.)")
      .def(
          "save", [](const Steered& self) { return bytes_of(unlocked([&] { return self.save(); })); },
          R"(save(self) -> bytes

All that the wire remembers: whoever restores it goes on with the same bits, events under way included.)")
      .def(
          "restore",
          [](Steered& self, const py::bytes& state) {
            const std::string bytes = state;
            unlocked([&] { self.restore(bytes); });
          },
          py::arg("state"), R"(restore(self, state: bytes) -> None

Puts a saved state of the same scene back, its variant included. Raises InputError when it is damaged or of another
scene; nothing is changed then.)")
      .def("copy", &Steered::copy, release(), R"(copy(self) -> Simulation

Another simulation in the same state; the two share the vessel.)")
      .def("commands", &Steered::commands, release(), R"(commands(self) -> list[Command]

The motions of the scene as the program steps them.)")
      .def_property_readonly(
          "state_hash", [](const Steered& self) { return unlocked([&] { return self.state_hash(); }); },
          "int: bits of the state, as in summary.json");
}

void define_batch(py::module_& m) {
  py::class_<Batch>(m, "Batch", R"(Copies of simulations, stepped together over all cores.

Every state has the same bits as if the simulation had been stepped alone.)")
      .def(py::init([](const Batch::Simulations& simulations, int threads) {
             return unlocked([&] { return std::make_unique<Batch>(simulations, threads); });
           }),
           py::arg("simulations"), py::arg("threads") = 0,
           R"(__init__(self, simulations: Sequence[Simulation], threads: int = 0) -> None

Copies the simulations, in their states; make them with Simulation.copy() to share a vessel. threads = 0: all cores.)")
      .def("__len__", &Batch::size, "__len__(self) -> int")
      .def(
          "step",
          [](Batch& self, const std::optional<std::vector<sim::Command>>& commands,
             const py::object& advance_mm, const py::object& torque_rad) {
            const std::vector<sim::Command> all = one_of(commands, advance_mm, torque_rad, self.size());
            return unlocked([&] { return self.step(all); });
          },
          py::arg("commands") = py::none(), py::kw_only(), py::arg("advance_mm") = 0.0,
          py::arg("torque_rad") = 0.0,
          R"(step(self, commands: Sequence[Command] | None = None, *, advance_mm: ArrayLike = 0.0, torque_rad: ArrayLike = 0.0) -> list[StepReport]

Moves every hand once: one command a simulation, or its numbers, in arrays of shape (len(batch),) or one number for all.
A simulation that fails with an error does not converge and is left out until it is restored or reset.)")
      .def(
          "reset",
          [](Batch& self, py::ssize_t index, const py::object& seed) {
            const Seed number = seed_of(seed);
            unlocked([&] { self.reset(index, number); });
          },
          py::arg("index"), py::arg("seed") = py::none(),
          "reset(self, index: int, seed: int | None = None) -> None\n\nAs Simulation.reset.")
      .def("observe", &Batch::observe, py::arg("index"), release(),
           "observe(self, index: int) -> Observation")
      .def(
          "save",
          [](const Batch& self, py::ssize_t index) {
            return bytes_of(unlocked([&] { return self.save(index); }));
          },
          py::arg("index"),
          "save(self, index: int) -> bytes\n\nA simulation of the same scene can restore it.")
      .def(
          "restore",
          [](Batch& self, py::ssize_t index, const py::bytes& state) {
            const std::string bytes = state;
            unlocked([&] { self.restore(index, bytes); });
          },
          py::arg("index"), py::arg("state"), "restore(self, index: int, state: bytes) -> None")
      .def("state_hash", &Batch::state_hash, py::arg("index"), release(),
           "state_hash(self, index: int) -> int")
      .def("error", &Batch::error, py::arg("index"), release(),
           "error(self, index: int) -> str\n\nWhy a simulation is left out; empty: it is not.");
}

}  // namespace

}  // namespace endowire::python

PYBIND11_MODULE(endowire, m) {
  namespace py = pybind11;
  using namespace endowire;
  py::options options;
  options.disable_function_signatures();
  m.doc() = "A guidewire simulator: physically true, real-time, open. Units and signs: docs/notation.md.";
  m.attr("__version__") = io::version;
  auto& input_error = py::register_exception<base::InputError>(m, "InputError", PyExc_ValueError);
  input_error.doc() = "Bad input, in one line: what it is, its value, and what is allowed.";
  python::define_numbers(m);
  python::define_report(m);
  python::define_observation(m);
  python::define_simulation(m);
  python::define_batch(m);
}
