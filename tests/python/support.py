"""What the tests of the module share: a vessel made in code, prepared once a run."""
import os
import pathlib
import tempfile

import endowire

CACHE = os.environ.get("ENDOWIRE_TEST_CACHE") or tempfile.mkdtemp(prefix="endowire_python_")

SCENE = """schema = 1
[vessel]
generate = "carotid_siphon"
[[instrument]]
model = "coronary_014_floppy"
[target]
branch = "1"
beyond_ostium_mm = 40.0
[[motion]]
duration_s = 4.5
hands = [{ instrument = 1, advance_mm = 45.0, torque_deg = 90.0 }]
[[motion]]
duration_s = 1.0
hands = [{ instrument = 1, advance_mm = -10.0, torque_deg = 0.0 }]
"""


def simulation():
    return endowire.Simulation(SCENE, cache_folder=CACHE)


def play(simulation, commands):
    return [simulation.step(command) for command in commands]


def arrays(observation):
    return {name: getattr(observation, name).copy() for name in (
        "joints_mm", "arc_mm", "radius_mm", "curvature_per_mm", "twist_rad", "wall_force_n_per_mm",
        "friction_n_per_mm", "wall_force_direction", "tip_mm")}


def numbers(report):
    names = [name for name in vars(type(report)) if not name.startswith("_") and name != "events"]
    return [getattr(report, name) for name in names] + [
        (e.kind, e.value, tuple(e.position_mm), e.branch) for e in report.events]
