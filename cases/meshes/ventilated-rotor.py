"""One of 21 sectors of a ventilated rotor between two full rings of lining, as in a disc brake of an aircraft or a clutch that runs in
air: writes ventilated-rotor.inp.

    python3 ventilated-rotor.py [elements around the sector, default 4] [elements along the radius, default 8] [file]

Rotor r 0.070 to 0.140 m: two cheeks of 7 mm at z 6 to 13 mm on either side, vanes of half the pitch between them; linings of 12 mm on
both faces. The cut faces bend with the vanes. Bricks of 8 nodes with incompatible modes; rotor and linings share no node. Regions
rotor, lining_bottom, lining_top; surfaces bore, bottom, top (faces of the rotor), lining_bottom_face, lining_top_face, back_bottom,
back_top, and rim_top, the outer rim of the upper lining.
"""

import math
import sys

COUNT = 21
AROUND = int(sys.argv[1]) if len(sys.argv) > 1 else 4
RADIAL = int(sys.argv[2]) if len(sys.argv) > 2 else 8
FILE = sys.argv[3] if len(sys.argv) > 3 else "ventilated-rotor.inp"

INNER, OUTER = 0.070, 0.140
# Region, lower and upper z (m), layers of elements, and whether it is vanes.
LAYERS = [
    ("lining_bottom", -0.025, -0.013, 1, False),
    ("rotor", -0.013, -0.006, 1, False),
    ("rotor", -0.006, 0.006, 2, True),
    ("rotor", 0.006, 0.013, 1, False),
    ("lining_top", 0.013, 0.025, 1, False),
]

points, number = [], {}


def node(region, i, j, z):
    """Number of the node of a region at step i around, j along the radius, and z."""
    key = (region, i, j, round(1e7 * z))
    if key not in number:
        radius = INNER + (OUTER - INNER) * j / RADIAL
        pitch = 2 * math.pi / COUNT
        angle = pitch * (i / AROUND + 0.3 * math.sin(1.5 * j / RADIAL))
        points.append((radius * math.cos(angle), radius * math.sin(angle), z))
        number[key] = len(points)
    return number[key]


elements = {"lining_bottom": [], "rotor": [], "lining_top": []}
surfaces = {}
for region, low, high, count, is_vane in LAYERS:
    for k in range(count):
        levels = [low + (high - low) * step / count for step in (k, k + 1)]
        for i in range(AROUND):
            if is_vane and not AROUND // 4 <= i < AROUND // 4 + max(1, AROUND // 2):
                continue
            for j in range(RADIAL):
                corners = [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)]
                brick = [node(region, *corner, z) for z in levels for corner in corners]
                elements[region].append(brick)
                # Faces by the place of the element: S1 below, S2 above, S6 inside, S4 outside.
                faces = {
                    "back_bottom": (levels[0] == -0.025, "S1"),
                    "lining_bottom_face": (region == "lining_bottom" and k == count - 1, "S2"),
                    "bottom": (region == "rotor" and levels[0] == -0.013, "S1"),
                    "top": (region == "rotor" and levels[1] == 0.013, "S2"),
                    "lining_top_face": (region == "lining_top" and k == 0, "S1"),
                    "back_top": (levels[1] == 0.025, "S2"),
                    "rim_top": (region == "lining_top" and j == RADIAL - 1, "S4"),
                    "bore": (region == "rotor" and j == 0, "S6"),
                }
                for name, (is_there, face) in faces.items():
                    if is_there:
                        surfaces.setdefault(name, []).append((region, len(elements[region]), face))

with open(FILE, "w") as out:
    out.write("*NODE\n")
    for label, (x, y, z) in enumerate(points, 1):
        out.write(f"{label}, {x:.15g}, {y:.15g}, {z:.15g}\n")
    first, label = {}, 1
    for region, bricks in elements.items():
        first[region] = label
        out.write(f"*ELEMENT, TYPE=C3D8I, ELSET={region}\n")
        for brick in bricks:
            out.write(", ".join(map(str, [label, *brick])) + "\n")
            label += 1
    for name, faces in surfaces.items():
        out.write(f"*SURFACE, NAME={name}\n")
        for region, place, face in faces:
            out.write(f"{first[region] + place - 1}, {face}\n")
