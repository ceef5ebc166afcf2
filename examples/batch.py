"""Tries eight turns of the tip at once from one saved state and keeps the one that comes nearest to the target.

PYTHONPATH=build/check/python python3 examples/batch.py
"""
import math
import sys

import endowire

SCENE = """schema = 1
[vessel]
generate = "carotid_siphon"
[[instrument]]
model = "coronary_014_floppy"
[target]
branch = "1"
beyond_ostium_mm = 80.0
"""
TRIES = 8

wire = endowire.Simulation(SCENE)
for _ in range(40):
    wire.step(advance_mm=1.0)

# The copies share the vessel; each hand turns another way, then all push.
batch = endowire.Batch([wire.copy() for _ in range(TRIES)])
failed = 0
turns = [endowire.Command(torque_rad=2 * math.pi * i / TRIES) for i in range(TRIES)]
for commands in [turns] + [[endowire.Command(advance_mm=1.0)] * TRIES] * 40:
    failed += sum(not report.converged for report in batch.step(commands))

to_go = [batch.observe(i).target.to_go_mm for i in range(TRIES)]
for i, left in enumerate(to_go):
    print(f"turned by {math.degrees(turns[i].torque_rad):3.0f} deg: {left:5.1f} mm to go")
best = min(range(TRIES), key=to_go.__getitem__)
wire.restore(batch.save(best))
print(f"goes on from try {best}, {wire.observe().inserted_length_mm:.1f} mm inserted; {failed} steps not converged")
sys.exit(3 if failed else 0)
