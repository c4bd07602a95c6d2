"""A disc brake as a finite-element program would write it: brake.inp, in millimetres, tonnes and seconds.

The disc turns about z; the lining of each pad is tied to its backplate, whose mesh is another one; the upper pad is the lower one
turned about y by half a turn. python3 brake.py writes the file beside itself, other mesh sizes: python3 brake.py 1.5 brake-fine.inp.
"""

import math
import sys
from pathlib import Path

FINENESS = float(sys.argv[1]) if len(sys.argv) > 1 else 1.0
TARGET = Path(__file__).with_name(sys.argv[2] if len(sys.argv) > 2 else "brake.inp")


def count(number):
    return max(1, round(FINENESS * number))


class Grid:
    """Bricks over r, theta and z between limits in mm and degrees."""

    def __init__(self, r, theta, z, counts, is_closed=False):
        self.counts = [count(number) for number in counts]
        nr, nt, nz = self.counts
        rows = nt if is_closed else nt + 1
        self.nodes = []
        for k in range(nz + 1):
            for j in range(rows):
                for i in range(nr + 1):
                    radius = r[0] + (r[1] - r[0]) * i / nr
                    angle = math.radians(theta[0] + (theta[1] - theta[0]) * j / nt)
                    height = z[0] + (z[1] - z[0]) * k / nz
                    self.nodes.append((radius * math.cos(angle), radius * math.sin(angle), height))
        number = lambda i, j, k: 1 + i + (nr + 1) * (j % rows + rows * k)
        self.number = number
        self.elements, self.bottom, self.top, self.inner = [], [], [], []
        for k in range(nz):
            for j in range(nt):
                for i in range(nr):
                    sheet = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                    corners = [number(a, b, k) for a, b in sheet] + [number(a, b, k + 1) for a, b in sheet]
                    self.elements.append(corners)
                    if k == 0:
                        self.bottom.append(len(self.elements))
                    if k == nz - 1:
                        self.top.append(len(self.elements))
        self.bore = [number(0, j, k) for k in range(nz + 1) for j in range(rows)]


def block(out, grid, region, first_node=0, first_element=0):
    out.append("*Node")
    out += [f"{first_node + n}, {x:.9g}, {y:.9g}, {z:.9g}" for n, (x, y, z) in enumerate(grid.nodes, 1)]
    out.append(f"*Element, type=C3D8I, elset={region}")
    for e, corners in enumerate(grid.elements, 1):
        out.append(f"{first_element + e}, " + ", ".join(str(first_node + node) for node in corners))


def listed(numbers):
    return [", ".join(map(str, numbers[i : i + 16])) for i in range(0, len(numbers), 16)]


disc = Grid((45.0, 110.0), (0.0, 360.0), (-6.0, 6.0), (6, 36, 2), is_closed=True)
lining = Grid((72.0, 106.0), (65.0, 115.0), (6.0, 16.0), (4, 7, 2))
plate = Grid((70.0, 108.0), (62.0, 118.0), (16.0, 21.0), (3, 8, 1))
nodes, elements = len(lining.nodes), len(lining.elements)

out = ["*Heading", "Disc brake with two pads, millimetres, tonnes, seconds"]
out += ["*Part, name=Disc"]
block(out, disc, "Disc_iron")
out += ["*Nset, nset=Bore", *listed(disc.bore)]
out += ["*Nset, nset=All, generate", f"1, {len(disc.nodes)}, 1"]
out += ["*Elset, elset=Lower", *listed(disc.bottom), "*Elset, elset=Upper", *listed(disc.top)]
out += ["*Surface, type=ELEMENT, name=Lower_face", "Lower, S1", "*Surface, type=ELEMENT, name=Upper_face", "Upper, S2"]
out += ["*Solid Section, elset=Disc_iron, material=Iron", ",", "*End Part"]

out += ["*Part, name=Pad"]
block(out, lining, "Lining")
block(out, plate, "Backplate", nodes, elements)
out += ["*Elset, elset=Rubbing", *listed(lining.bottom), "*Elset, elset=Glued", *listed(lining.top)]
out += ["*Elset, elset=Under", *listed([elements + e for e in plate.bottom])]
out += ["*Elset, elset=Back", *listed([elements + e for e in plate.top])]
out += ["*Surface, type=ELEMENT, name=Friction_face", "Rubbing, S1", "*Surface, type=ELEMENT, name=Lining_glue", "Glued, S2"]
out += ["*Surface, type=ELEMENT, name=Plate_glue", "Under, S1", "*Surface, type=ELEMENT, name=Piston", "Back, S2"]
out += ["*Nset, nset=Plate, generate", f"{nodes + 1}, {nodes + len(plate.nodes)}, 1"]
out += ["*Solid Section, elset=Lining, material=Friction_material", ","]
out += ["*Solid Section, elset=Backplate, material=Steel", ",", "*End Part"]

out += ["*Assembly, name=Brake"]
out += ["*Instance, name=Disc, part=Disc", "*End Instance"]
out += ["*Instance, name=Outer, part=Pad", "*End Instance"]
out += ["*Instance, name=Inner, part=Pad", "0., 0., 0.", "0., 0., 0., 0., 1., 0., 180.", "*End Instance"]
for pad in ("Outer", "Inner"):
    out += [f"*Tie, name=Glue_{pad}, adjust=no", f"{pad}.Lining_glue, {pad}.Plate_glue"]
out += ["*End Assembly"]

out += ["*Material, name=Iron", "*Density", "7.2e-9,", "*Elastic", "1.1e5, 0.26", "*Damping, alpha=30., beta=1e-8"]
out += ["*Material, name=Steel", "*Density", "7.85e-9,", "*Elastic", "2.1e5, 0.3"]
out += ["*Material, name=Friction_material", "*Density", "2.6e-9,", "*Elastic", "6000., 0.25"]
out += ["*Surface Interaction, name=Rubbing", "*Friction", "0.4,"]
out += ["*Surface Behavior, pressure-overclosure=LINEAR", "2e4,"]
for pad, face in (("Outer", "Upper_face"), ("Inner", "Lower_face")):
    out += ["*Contact Pair, interaction=Rubbing, type=SURFACE TO SURFACE", f"{pad}.Friction_face, Disc.{face}"]
out += ["*Boundary", "Disc.Bore, ENCASTRE", "Outer.Plate, 1, 2", "Inner.Plate, 1, 2"]
out += ["*Step, name=Press, nlgeom=NO", "*Static", "*Dsload", "Outer.Piston, P, 1.5", "Inner.Piston, P, 1.5", "*End Step"]
out += ["*Step, name=Turn, nlgeom=NO", "*Static", "*Motion, rotation", "Disc.All, 10.47197551, 0., 0., 0., 0., 0., 1.", "*End Step"]
out += ["*Step, name=Squeal, perturbation", "*Complex Frequency, friction damping=YES", "30,", "*Output, field, variable=PRESELECT", "*End Step"]
TARGET.write_text("\n".join(out) + "\n")
