"""One simulation and its C++ twin: the same bits, save and restore, seeds, errors, threads."""
import gc
import json
import os
import pathlib
import pickle
import subprocess
import sys
import tempfile
import threading
import unittest

import endowire
import numpy
from support import CACHE, SCENE, arrays, numbers, play, simulation


class SameAsTheProgram(unittest.TestCase):
    def test_state_hash(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder) / "scene.toml"
            scene.write_text(SCENE)
            subprocess.run([os.environ["ENDOWIRE_PROGRAM"], "simulate", scene, "--out", folder + "/out", "--cache",
                            CACHE, "--quiet"], check=True, stdout=subprocess.DEVNULL)
            summary = json.loads((pathlib.Path(folder) / "out/summary.json").read_text())
            wire = endowire.Simulation(scene, cache_folder=CACHE)
            reports = play(wire, wire.commands())
        self.assertIn(f"{wire.state_hash:016x}", json.dumps(summary))
        self.assertTrue(all(report.converged for report in reports))
        self.assertAlmostEqual(reports[-1].inserted_length_mm, 35.0, delta=1.0)

    def test_messages(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder) / "scene.toml"
            scene.write_text(SCENE.replace("duration_s = 1.0", "duration_s = -1"))
            said = subprocess.run([os.environ["ENDOWIRE_PROGRAM"], "simulate", scene, "--out", folder + "/out"],
                                  capture_output=True, text=True)
            self.assertEqual(said.returncode, 2)
            with self.assertRaises(endowire.InputError) as caught:
                endowire.Simulation(scene)
        self.assertIn("duration_s is -1", str(caught.exception))
        self.assertEqual(said.stderr.strip(), str(caught.exception))
        self.assertIsInstance(caught.exception, ValueError)


class SaveAndRestore(unittest.TestCase):
    def test_goes_on_with_the_same_bits(self):
        wire = simulation()
        commands = wire.commands()
        play(wire, commands[:40])
        saved = pickle.loads(pickle.dumps(wire.save()))
        seen = arrays(wire.observe())
        self.assertGreater(seen["wall_force_n_per_mm"].max(), 0.0)  # there is something to lose
        first = [numbers(r) for r in play(wire, commands[40:])]
        end = wire.state_hash
        other = simulation()
        for restored in (wire, other):
            restored.restore(saved)
            self.assertEqual(restored.save(), saved)
            for name, value in arrays(restored.observe()).items():
                self.assertEqual(value.tobytes(), seen[name].tobytes(), name)
            self.assertEqual([numbers(r) for r in play(restored, commands[40:])], first)
            self.assertEqual(restored.state_hash, end)

    def test_another_process_goes_on_with_the_same_bits(self):
        wire = simulation()
        commands = wire.commands()
        play(wire, commands[:40])
        program = ("import sys; from support import *; wire = simulation(); wire.restore(sys.stdin.buffer.read());"
                   "play(wire, wire.commands()[40:]); sys.stdout.buffer.write(wire.save())")
        other = subprocess.run([sys.executable, "-c", program], input=wire.save(), capture_output=True, check=True,
                               cwd=pathlib.Path(__file__).parent)
        play(wire, commands[40:])
        self.assertEqual(other.stdout, wire.save())

    def test_events_under_way_are_not_told_again(self):
        wire = simulation()
        told = []
        for _ in range(200):
            told = wire.step(advance_mm=1.0).events
            if told:
                break
        self.assertTrue(told, "the wire never showed an event")
        saved = wire.save()
        went_on = [numbers(wire.step(advance_mm=1.0)) for _ in range(5)]
        other = simulation()
        other.restore(saved)
        self.assertEqual([numbers(other.step(advance_mm=1.0)) for _ in range(5)], went_on)

    def test_what_is_no_state_is_refused_and_changes_nothing(self):
        wire = simulation()
        play(wire, wire.commands()[:10])
        saved = wire.save()
        stranger = endowire.Simulation(SCENE.replace("coronary_014_floppy", "coronary_014_intermediate"),
                                       cache_folder=CACHE)
        with self.assertRaisesRegex(endowire.InputError, "state: saved state is unusable: it belongs to another scene"):
            wire.restore(stranger.save())
        for end in list(range(100)) + list(range(100, len(saved), 7)):
            with self.assertRaises(endowire.InputError):
                wire.restore(saved[:end])
        for place in list(range(100)) + list(range(100, len(saved), 7)):
            damaged = bytearray(saved)
            damaged[place] ^= 1 << place % 8
            with self.assertRaises(endowire.InputError):
                wire.restore(bytes(damaged))
        with self.assertRaises(endowire.InputError):
            wire.restore(saved + b"x")
        with self.assertRaises(TypeError):
            wire.restore("text")
        self.assertEqual(wire.save(), saved)

    def test_a_variant_is_restored_with_its_vessel(self):
        wire = simulation()
        wire.reset(7)
        play(wire, wire.commands()[:20])
        other = simulation()
        other.restore(wire.save())
        for each in (wire, other):
            play(each, each.commands()[20:])
        self.assertEqual(other.state_hash, wire.state_hash)


class Reset(unittest.TestCase):
    def hash_after(self, seed, scene=SCENE):
        wire = endowire.Simulation(scene, cache_folder=CACHE)
        play(wire, wire.commands()[:5])
        wire.reset(seed)
        self.assertEqual(len(wire.observe().joints_mm), 0)
        play(wire, wire.commands())
        return wire.state_hash

    def test_a_seed_is_reproducible_and_none_is_the_scene(self):
        fresh = simulation()
        play(fresh, fresh.commands())
        self.assertEqual(self.hash_after(None), fresh.state_hash)
        self.assertEqual(self.hash_after(3), self.hash_after(3))
        self.assertEqual(len({self.hash_after(None), self.hash_after(3), self.hash_after(4)}), 3)

    def test_seeds_are_integers_from_0(self):
        wire = simulation()
        for seed in (-1, 2**64):
            with self.assertRaisesRegex(endowire.InputError, f"seed is {seed}; must be 0 … 18446744073709551615"):
                wire.reset(seed)
        with self.assertRaises(TypeError):
            wire.reset(1.5)

    def test_a_place_in_the_cache_is_left_as_it_was(self):
        with tempfile.TemporaryDirectory() as cache:
            wire = endowire.Simulation(SCENE, cache_folder=cache)
            kept = sorted(pathlib.Path(cache).rglob("*"))
            self.assertEqual(len(kept), 2)
            wire.reset(numpy.int64(11))  # NumPy's integers are seeds too
            self.assertEqual(sorted(pathlib.Path(cache).rglob("*")), kept)

    def test_a_seed_draws_the_vessel_and_the_turn(self):
        wire = simulation()
        ends = []
        for seed in (1, 2):
            wire.reset(seed)
            ends.append(wire.observe().tip_mm.tolist())  # the end of the sheath, which the vessel tells
        self.assertNotEqual(ends[0], ends[1])


class Steps(unittest.TestCase):
    def test_ways_to_say_a_command(self):
        a, b = simulation(), simulation()
        a.step(endowire.Command(1.5, 0.1))
        b.step(advance_mm=1.5, torque_rad=0.1)
        self.assertEqual(a.state_hash, b.state_hash)
        with self.assertRaisesRegex(endowire.InputError, "given alone"):
            a.step(endowire.Command(), advance_mm=1.0)
        for wrong in ("1", None, [1.0]):
            with self.assertRaises(TypeError):
                a.step(advance_mm=wrong)
        self.assertEqual(a.save(), b.save())

    def test_what_cannot_be_solved_is_told_by_the_report(self):
        wire = simulation()
        before = wire.state_hash
        report = wire.step(advance_mm=float("nan"))
        self.assertFalse(report.converged)
        self.assertEqual([event.kind for event in report.events], ["not_converged"])
        self.assertEqual(wire.state_hash, before)

    def test_observation(self):
        wire = simulation()
        start = wire.observe()
        self.assertEqual(start.joints_mm.shape, (0, 3))
        play(wire, [endowire.Command(1.0)] * 30)
        seen = wire.observe()
        n = len(seen.joints_mm)
        self.assertGreater(n, 3)
        for name, value in arrays(seen).items():
            self.assertEqual(value.shape[0], 3 if name == "tip_mm" else n, name)
        self.assertEqual(seen.joints_mm[0].tolist(), seen.tip_mm.tolist())
        self.assertEqual(seen.arc_mm[0], 0.0)
        self.assertEqual(seen.branch, "1:1")
        self.assertLess(seen.target.to_go_mm, start.target.to_go_mm)
        for array in (seen.joints_mm, seen.wall_force_n_per_mm, seen.tip_mm):
            with self.assertRaises(ValueError):
                array[0] = 1.0
            with self.assertRaises(ValueError):
                array.flags.writeable = True
            self.assertEqual(array.dtype, numpy.float64)

    def test_a_view_outlives_later_steps_its_observation_and_the_simulation(self):
        wire = simulation()
        play(wire, [endowire.Command(1.0)] * 30)
        views = [getattr(wire.observe(), name) for name in arrays(wire.observe())]
        kept = [array.copy() for array in views]
        play(wire, [endowire.Command(1.0)] * 5)
        self.assertNotEqual(wire.observe().joints_mm[0].tolist(), kept[0][0].tolist())
        del wire
        gc.collect()
        play(simulation(), [endowire.Command(1.0)] * 30)  # would use the memory again
        for array, before in zip(views, kept):
            self.assertEqual(array.tobytes(), before.tobytes())

    def test_a_copy_goes_its_own_way(self):
        wire = simulation()
        play(wire, wire.commands()[:10])
        twin = wire.copy()
        self.assertEqual(twin.save(), wire.save())
        before = wire.state_hash
        twin.step(advance_mm=1.0)
        self.assertEqual(wire.state_hash, before)
        self.assertEqual(wire.step(advance_mm=1.0).converged, True)
        self.assertEqual(twin.state_hash, wire.state_hash)


class Threads(unittest.TestCase):
    def test_two_at_once_give_the_bits_of_one(self):
        alone = simulation()
        play(alone, alone.commands())
        wires = [alone.copy(), alone.copy()]
        for wire in wires:
            wire.reset()
        threads = [threading.Thread(target=play, args=(w, w.commands())) for w in wires]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual([w.state_hash for w in wires], [alone.state_hash] * 2)

    def run_beside(self, work):
        """Whether this thread ran before `work` ended in another, when Python itself never makes threads take turns."""
        interval = sys.getswitchinterval()
        sys.setswitchinterval(3600.0)
        ended = []

        def run():
            work()
            ended.append(True)

        thread = threading.Thread(target=run)
        try:
            thread.start()
            beside = not ended
        finally:
            sys.setswitchinterval(interval)
        thread.join()
        return beside

    def test_other_threads_run_while_one_computes(self):
        wire = simulation()
        batch = endowire.Batch([wire.copy(), wire.copy()])
        pushes = [endowire.Command(1.0)] * 60
        self.assertFalse(self.run_beside(lambda: sum(range(2000000))))  # the test can tell
        self.assertTrue(self.run_beside(lambda: play(wire, pushes)))
        self.assertTrue(self.run_beside(lambda: [batch.step(advance_mm=1.0) for _ in pushes]))
        self.assertTrue(self.run_beside(lambda: wire.reset(1)))

    def test_two_threads_may_share_one(self):
        wire = simulation()
        threads = [threading.Thread(target=play, args=(wire, [endowire.Command(0.5)] * 20)) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        other = simulation()
        play(other, [endowire.Command(0.5)] * 40)
        self.assertEqual(wire.state_hash, other.state_hash)


if __name__ == "__main__":
    unittest.main()
