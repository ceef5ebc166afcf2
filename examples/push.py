"""Pushes a wire into a carotid made in code and tells what happens on the way.

PYTHONPATH=build/check/python python3 examples/push.py [SCENE.toml]
"""
import sys

import endowire

SCENE = """schema = 1
[vessel]
generate = "carotid_siphon"
[[instrument]]
model = "coronary_014_floppy"
"""

wire = endowire.Simulation(sys.argv[1] if len(sys.argv) > 1 else SCENE)
failed = 0
print("inserted_mm  push_n  tip_force_n  branch")
for step in range(1, 91):
    report = wire.step(advance_mm=1.0)
    failed += not report.converged
    for event in report.events:
        print(f"  {event.kind} {event.value:.3g} at {event.position_mm.round(1)} mm {event.branch}")
    if step % 15 == 0:
        print(f"{report.inserted_length_mm:11.1f} {report.push_force_n:7.3f} {report.tip_force_n:12.3f}  "
              f"{wire.observe().branch}")

seen = wire.observe()
hardest = seen.wall_force_n_per_mm.argmax()
print(f"hardest on the wall {seen.arc_mm[hardest]:.1f} mm behind the tip: "
      f"{seen.wall_force_n_per_mm[hardest]:.3g} N/mm at {seen.joints_mm[hardest].round(1)} mm")
print(f"state {wire.state_hash:016x}, {failed} steps not converged")
sys.exit(3 if failed else 0)
