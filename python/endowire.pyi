"""A guidewire simulator: physically true, real-time, open. Units and signs: docs/notation.md."""
# Written by python/write_stub.py; a test holds it against the module.
from __future__ import annotations

import os
from collections.abc import Sequence

import numpy
from numpy.typing import ArrayLike

__version__: str

class InputError(ValueError):
    """Bad input, in one line: what it is, its value, and what is allowed."""

class Command:
    """What the hand does in one step."""
    def __init__(self, advance_mm: float = 0.0, torque_rad: float = 0.0) -> None: ...
    @property
    def advance_mm(self) -> float:
        """> 0 into the vessel"""
    @property
    def torque_rad(self) -> float:
        """> 0 right-handed about the direction of advance"""

class Event:
    """Something that began in a step."""
    @property
    def kind(self) -> str:
        """snap, perforation, kink, exit, too_narrow, hand_slip, not_converged, stall, new_branch or self_overlap"""
    @property
    def value(self) -> float:
        """snap: longest way of a joint [mm]; perforation, stall, not_converged: force [N]; kink: curvature [1/mm]; exit: number of the opening; too_narrow, self_overlap: gap [mm], < 0; hand_slip [mm]; new_branch: radius of its lumen [mm]"""
    @property
    def position_mm(self) -> numpy.ndarray:
        """(3,)"""
    @property
    def branch(self) -> str:
        """of the centreline tree; empty: of none"""

class TargetDistance:
    """How the tip stands to the target of the scene."""
    @property
    def reached(self) -> bool:
        """the tip is there, or beyond"""
    @property
    def to_go_mm(self) -> float:
        """along the vessels, back out of a wrong branch included; 0 behind the goal"""
    @property
    def offset_radii(self) -> float:
        """of the tip from the nearest centreline, in radii of the lumen there"""

class StepReport:
    """What one step did."""
    @property
    def converged(self) -> bool:
        """solved, and verified against the vessel; else the wire stays where it was"""
    @property
    def push_force_n(self) -> float:
        """force of the hand on the wire, > 0 pushes"""
    @property
    def torque_n_mm(self) -> float:
        """torque of the hand on the wire"""
    @property
    def inserted_length_mm(self) -> float:
        """of wire beyond the end of the sheath"""
    @property
    def hand_slip_mm(self) -> float:
        """commanded minus achieved advance"""
    @property
    def tip_force_n(self) -> float:
        """wall force within the last 5 mm"""
    @property
    def max_force_5mm_n(self) -> float:
        """wall force over a sliding 5 mm, largest"""
    @property
    def max_wall_deflection_mm(self) -> float: ...
    @property
    def snapped(self) -> bool:
        """the wire left one equilibrium for another"""
    @property
    def walls_at_rest(self) -> bool:
        """false where walls swung to and fro on an edge of the field"""
    @property
    def rods(self) -> int: ...
    @property
    def contact_samples(self) -> int: ...
    @property
    def newton_iterations(self) -> int: ...
    @property
    def rods_divided(self) -> int:
        """by the adaptive resolution; rods that enter not counted"""
    @property
    def rods_joined(self) -> int:
        """same"""
    @property
    def resolution_energy_mj(self) -> float:
        """sum of the sizes of the changes of energy by these"""
    @property
    def splits(self) -> int:
        """halvings of the command"""
    @property
    def detections(self) -> float:
        """collision detections, in units of the whole wire"""
    @property
    def verifications(self) -> int:
        """checks of the final state against the field"""
    @property
    def termination(self) -> str:
        """why the last minimisation ended"""
    @property
    def events(self) -> list[Event]:
        """each told once, when it begins"""

class Observation:
    """The wire between two steps, from the tip to the sheath: n joints, the last one in the sheath.

    Nothing that is done to the simulation later changes it. Arrays are read-only views of float64 into the observation, which
    they keep; they are strided: numpy.ascontiguousarray(view) packs one.
    """
    @property
    def joints_mm(self) -> numpy.ndarray:
        """(n, 3); n is 0 while the tip is in the sheath"""
    @property
    def arc_mm(self) -> numpy.ndarray:
        """(n,), along the wire from the tip"""
    @property
    def radius_mm(self) -> numpy.ndarray:
        """(n,), of the wire"""
    @property
    def curvature_per_mm(self) -> numpy.ndarray:
        """(n,)"""
    @property
    def twist_rad(self) -> numpy.ndarray:
        """(n,), turn of the material about its axis"""
    @property
    def wall_force_n_per_mm(self) -> numpy.ndarray:
        """(n,), normal force on the wall per length of wire"""
    @property
    def friction_n_per_mm(self) -> numpy.ndarray:
        """(n,)"""
    @property
    def wall_force_direction(self) -> numpy.ndarray:
        """(n, 3), of the force on the wire"""
    @property
    def tip_mm(self) -> numpy.ndarray:
        """(3,); the end of the sheath while the tip is in it"""
    @property
    def branch(self) -> str:
        """that the tip lies in, as endowire inspect lists it; empty: the vessel has none"""
    @property
    def target(self) -> TargetDistance | None:
        """none when the scene has no target"""
    @property
    def inserted_length_mm(self) -> float: ...
    @property
    def push_force_n(self) -> float:
        """as StepReport"""
    @property
    def torque_n_mm(self) -> float:
        """as StepReport"""

class Simulation:
    """One wire in one vessel, steered from outside.

    Any number of simulations run at once on any number of threads: Python's lock is released while they compute. Calls to
    one simulation wait for each other.
    """
    def __init__(self, scene: str | os.PathLike[str], cache_folder: str | os.PathLike[str] | None = None) -> None:
        """Reads a scene and prepares its vessel. `scene` is a path, or the text of a scene when it holds a line break; paths in a
        text are relative to the working directory. Motions may be left out. Prepared vessels are kept in `cache_folder`, by
        default that of the program; "" keeps none. Raises InputError with the program's message.
        """
    def reset(self, seed: int | None = None) -> None:
        """Back to the start: the tip in the sheath. None: as the scene says. A seed picks a variant, the same for the same seed: it
        draws the dimensions of a generated vessel that the scene does not give (a seed of the scene is replaced; a vessel from a
        file stays), and turns the instrument at the hand by an angle between -pi and pi. Nothing else is random. A new vessel is
        prepared, in the order of a second, and not kept in the cache; a place that the scene gives may lie outside of it, which
        raises InputError and changes nothing. To come back to a start soon, save() it after reset() and restore() it.
        """
    def step(self, command: Command | None = None, *, advance_mm: float = 0.0, torque_rad: float = 0.0) -> StepReport:
        """Moves the hand and finds the new equilibrium. Either a command or its numbers; nothing: the hand rests. Not converging is no
        exception: read the report. So it is with a command that is not finite, which moves nothing.
        """
    def observe(self) -> Observation:
        """The wire as the last step left it, or reset or restore put it."""
    def save(self) -> bytes:
        """All that the wire remembers: whoever restores it goes on with the same bits, events under way included."""
    def restore(self, state: bytes) -> None:
        """Puts a saved state of the same scene back, its variant included. Raises InputError when it is damaged or of another
        scene; nothing is changed then.
        """
    def copy(self) -> Simulation:
        """Another simulation in the same state; the two share the vessel."""
    def commands(self) -> list[Command]:
        """The motions of the scene as the program steps them."""
    @property
    def state_hash(self) -> int:
        """bits of the state, as in summary.json"""

class Batch:
    """Copies of simulations, stepped together over all cores.

    Every state has the same bits as if the simulation had been stepped alone.
    """
    def __init__(self, simulations: Sequence[Simulation], threads: int = 0) -> None:
        """Copies the simulations, in their states; make them with Simulation.copy() to share a vessel. threads = 0: all cores."""
    def __len__(self) -> int: ...
    def step(self, commands: Sequence[Command] | None = None, *, advance_mm: ArrayLike = 0.0, torque_rad: ArrayLike = 0.0) -> list[StepReport]:
        """Moves every hand once: one command a simulation, or its numbers, in arrays of shape (len(batch),) or one number for all.
        A simulation that fails with an error does not converge and is left out until it is restored or reset.
        """
    def reset(self, index: int, seed: int | None = None) -> None:
        """As Simulation.reset."""
    def observe(self, index: int) -> Observation: ...
    def save(self, index: int) -> bytes:
        """A simulation of the same scene can restore it."""
    def restore(self, index: int, state: bytes) -> None: ...
    def state_hash(self, index: int) -> int: ...
    def error(self, index: int) -> str:
        """Why a simulation is left out; empty: it is not."""
