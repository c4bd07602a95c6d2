"""Mesh of the ventilated disc between two pads of cases/ventilated-disc.toml.

    pip install gmsh
    python ventilated.py SIZE ORDER OUT.msh

SIZE is the element size in metres, ORDER 1 (four-node tetrahedra) or 2 (ten-node, straight edges). The file in this folder:
0.025 2 ventilated.msh. With 0.014 2 the pair that friction couples lies near 6.3 kHz.
"""

import math
import sys

import gmsh

SIZE, ORDER, OUT = float(sys.argv[1]), int(sys.argv[2]), sys.argv[3]

gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
occ = gmsh.model.occ


def ring(low, height, inner, outer):
    """A ring about the z axis."""
    solid = occ.addCylinder(0, 0, low, 0, 0, height, outer)
    bore = occ.addCylinder(0, 0, low, 0, 0, height, inner)
    return occ.cut([(3, solid)], [(3, bore)])[0]


# Two cheeks, the hat: a ring, a cylinder, a plate.
parts = ring(0, 0.010, 0.125, 0.175) + ring(0.025, 0.010, 0.125, 0.175)
parts += ring(0, 0.010, 0.1125, 0.125) + ring(0, 0.075, 0.105, 0.1125)
parts += ring(0.065, 0.010, 0.040, 0.105)

# 21 radial ribs with parallel sides between the cheeks.
WIDTH = 0.02870
for k in range(21):
    rib = occ.addBox(0.120, -WIDTH / 2, 0.010, 0.060, WIDTH, 0.015)
    occ.rotate([(3, rib)], 0, 0, 0, 0, 0, 1, math.radians(4.004 + k * 360 / 21))
    parts += occ.intersect([(3, rib)], ring(0.010, 0.015, 0.125, 0.175))[0]
disc = occ.fuse(parts[:1], parts[1:])[0]

# Five bolt holes.
holes = []
for k in range(5):
    angle = math.radians(18 + 72 * k)
    x, y = 0.075 * math.cos(angle), 0.075 * math.sin(angle)
    holes.append((3, occ.addCylinder(x, y, 0.06, 0, 0, 0.02, 0.010)))
disc = occ.cut(disc, holes)[0]

# A pad from 60 to 120 degrees on each face.
pads = []
for low in (-0.015, 0.035):
    wedge = occ.addCylinder(0, 0, low, 0, 0, 0.015, 0.2, angle=math.pi / 3)
    occ.rotate([(3, wedge)], 0, 0, 0, 0, 0, 1, math.pi / 3)
    pads.append(occ.intersect(ring(low, 0.015, 0.130, 0.1675), [(3, wedge)])[0])
occ.synchronize()

for name, volume in zip(["disc", "pad_inner", "pad_outer"], [disc] + pads):
    gmsh.model.addPhysicalGroup(3, [volume[0][1]], name=name)


def surfaces(volume):
    return [tag for _, tag in gmsh.model.getBoundary(volume, oriented=False)]


def box(surface):
    return gmsh.model.getBoundingBox(2, surface)


def lies_at(surface, z):
    return abs(box(surface)[2] - z) < 1e-5 and abs(box(surface)[5] - z) < 1e-5


# The bore and the holes of the plate are held.
bolts = []
for surface in surfaces(disc):
    low, high = box(surface)[2], box(surface)[5]
    extent = max(box(surface)[3] - box(surface)[0], box(surface)[4] - box(surface)[1])
    is_plate = 0.0649 < low < 0.0655 and high > 0.0745 and extent < 0.0811
    if is_plate and gmsh.model.getType(2, surface) == "Cylinder":
        bolts.append(surface)
assert len(bolts) == 6
gmsh.model.addPhysicalGroup(2, bolts, name="bolts")
inner = [s for s in surfaces(disc) if lies_at(s, 0) and box(s)[3] > 0.15]
gmsh.model.addPhysicalGroup(2, inner, name="disc_inner")
outer = [s for s in surfaces(disc) if lies_at(s, 0.035)]
gmsh.model.addPhysicalGroup(2, outer, name="disc_outer")
for name, pad, face, back in (("inner", pads[0], 0, -0.015), ("outer", pads[1], 0.035, 0.050)):
    lining = [s for s in surfaces(pad) if lies_at(s, face)]
    gmsh.model.addPhysicalGroup(2, lining, name="lining_" + name)
    backs = [s for s in surfaces(pad) if lies_at(s, back)]
    gmsh.model.addPhysicalGroup(2, backs, name="back_" + name)

gmsh.option.setNumber("Mesh.MeshSizeMax", SIZE)
gmsh.option.setNumber("Mesh.MeshSizeMin", 0.3 * SIZE)
gmsh.option.setNumber("Mesh.ElementOrder", ORDER)
gmsh.option.setNumber("Mesh.SecondOrderLinear", 1)
gmsh.option.setNumber("Mesh.MshFileVersion", 2.2)
gmsh.model.mesh.generate(3)
gmsh.write(OUT)
