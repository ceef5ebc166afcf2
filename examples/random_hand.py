"""A hand that does anything, in a few vessels drawn at random: the loop of reset, step and observe that a learner has.

PYTHONPATH=build/check/python python3 examples/random_hand.py [EPISODES]
"""
import sys

import endowire
import numpy

SCENE = """schema = 1
[vessel]
generate = "carotid_siphon"
[[instrument]]
model = "coronary_014_floppy"
[target]
branch = "1"
beyond_ostium_mm = 50.0
"""

wire = endowire.Simulation(SCENE)
failed = 0
for seed in range(int(sys.argv[1]) if len(sys.argv) > 1 else 2):
    wire.reset(seed)  # another person, another turn of the wire
    hand = numpy.random.default_rng(seed)
    most_n, reached_at = 0.0, None
    for step in range(150):
        report = wire.step(advance_mm=hand.uniform(-0.5, 1.5), torque_rad=hand.uniform(-0.2, 0.2))
        failed += not report.converged
        most_n = max(most_n, report.push_force_n)
        target = wire.observe().target
        if target.reached:
            reached_at = step + 1
            break
    end = f"there after {reached_at} steps" if reached_at else f"{target.to_go_mm:.1f} mm to go"
    print(f"seed {seed}: {end}, push at most {most_n:.3f} N, state {wire.state_hash:016x}")
print(f"{failed} steps not converged")
sys.exit(3 if failed else 0)
