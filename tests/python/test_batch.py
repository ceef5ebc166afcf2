"""A batch gives the bits of simulations that are stepped alone."""
import unittest

import endowire
import numpy
from support import arrays, numbers, play, simulation


class Batch(unittest.TestCase):
    def setUp(self):
        self.wires = [simulation()]
        self.wires += [self.wires[0].copy() for _ in range(3)]
        self.turns = [endowire.Command(1.0, 0.02 * i) for i in range(4)]

    def test_equals_single(self):
        for threads in (1, 2):
            batch = endowire.Batch(self.wires, threads=threads)
            self.assertEqual(len(batch), 4)
            wires = [wire.copy() for wire in self.wires]
            for _ in range(40):
                reports = batch.step(self.turns)
                alone = [wire.step(turn) for wire, turn in zip(wires, self.turns)]
                self.assertEqual([numbers(r) for r in reports], [numbers(r) for r in alone])
            self.assertEqual([batch.state_hash(i) for i in range(4)], [wire.state_hash for wire in wires])
            self.assertEqual(len({batch.state_hash(i) for i in range(4)}), 4)
            for i, wire in enumerate(wires):
                self.assertEqual(batch.save(i), wire.save())
                mine = arrays(batch.observe(i))
                for name, value in arrays(wire.observe()).items():
                    self.assertEqual(mine[name].tobytes(), value.tobytes())
                self.assertEqual(batch.error(i), "")
        self.assertEqual(len(self.wires[0].observe().joints_mm), 0)  # those it was made of stay as they were

    def test_save_restore_reset(self):
        batch = endowire.Batch(self.wires)
        for _ in range(20):
            batch.step(self.turns)
        saved = batch.save(1)
        batch.reset(2, seed=5)
        alone = simulation()
        alone.reset(5)
        self.assertEqual(batch.save(2), alone.save())
        batch.restore(2, saved)
        self.assertEqual(batch.state_hash(2), batch.state_hash(1))
        batch.step([self.turns[0]] * 4)
        self.assertEqual(batch.save(2), batch.save(1))

    def test_errors(self):
        with self.assertRaisesRegex(endowire.InputError, "simulations is an empty list; must hold at least one"):
            endowire.Batch([])
        batch = endowire.Batch(self.wires)
        with self.assertRaisesRegex(endowire.InputError, "commands is a list of 1; must be of 4"):
            batch.step([endowire.Command()])
        for index in (-1, 4):
            for call in (batch.reset, batch.observe, batch.save, batch.state_hash, batch.error,
                         lambda i: batch.restore(i, self.wires[0].save())):
                with self.assertRaisesRegex(endowire.InputError, f"index is {index}; must be 0 … 3"):
                    call(index)
        with self.assertRaisesRegex(endowire.InputError, "threads is -1; must be 0 … 1024"):
            endowire.Batch(self.wires, threads=-1)
        with self.assertRaisesRegex(endowire.InputError, "simulations holds None"):
            endowire.Batch([self.wires[0], None])
        with self.assertRaisesRegex(endowire.InputError, "damaged|unusable"):
            batch.restore(0, b"")

    def test_numbers_in_arrays(self):
        by_arrays, by_commands = endowire.Batch(self.wires), endowire.Batch(self.wires)
        turns = numpy.array([turn.torque_rad for turn in self.turns])
        for _ in range(5):
            by_commands.step(self.turns)
            by_arrays.step(advance_mm=numpy.int32(1), torque_rad=numpy.repeat(turns, 2)[::2])
        for i in range(4):
            self.assertEqual(by_arrays.save(i), by_commands.save(i))
        message = r"advance_mm is an array of shape \(3,\); must be one number, or of shape \(4,\)"
        with self.assertRaisesRegex(endowire.InputError, message):
            by_arrays.step(advance_mm=[1.0, 1.0, 1.0])
        with self.assertRaisesRegex(endowire.InputError, r"of shape \(4, 1\)"):
            by_arrays.step(torque_rad=numpy.zeros((4, 1)))
        with self.assertRaisesRegex(endowire.InputError, "commands is given beside"):
            by_arrays.step(self.turns, advance_mm=1.0)
        for wrong in (["1"] * 4, numpy.ones(4, complex), None, "1"):
            with self.assertRaises(TypeError):
                by_arrays.step(advance_mm=wrong)
        self.assertEqual(by_arrays.save(0), by_commands.save(0))


if __name__ == "__main__":
    unittest.main()
