// Test bench: the paper's disc in a steel ring that three screws hold; gmsh -2 bench.geo -o bench.msh
// Disc 20.5 to 90.5 mm; ring to 110 mm; each screw clamps 8 degrees of the ring's rim, every 120 degrees.
a = 20.5; b = 90.5; c = 110; half = 4 * Pi / 180;   // mm: mesh.scale = 0.001
Point(1) = {0, 0, 0};
For k In {0:3}
  Point(10 + k) = {a * Cos(k * Pi / 2), a * Sin(k * Pi / 2), 0, 2.0};
  Point(20 + k) = {b * Cos(k * Pi / 2), b * Sin(k * Pi / 2), 0, 6.0};
EndFor
For k In {0:2}
  t = Pi / 2 + k * 2 * Pi / 3;
  Point(30 + 2 * k) = {c * Cos(t - half), c * Sin(t - half), 0, 6.0};
  Point(31 + 2 * k) = {c * Cos(t + half), c * Sin(t + half), 0, 6.0};
EndFor
For k In {0:3}
  Circle(10 + k) = {10 + k, 1, 10 + (k + 1) % 4};
  Circle(20 + k) = {20 + k, 1, 20 + (k + 1) % 4};
EndFor
For k In {0:5}
  Circle(30 + k) = {30 + k, 1, 30 + (k + 1) % 6};
EndFor
Curve Loop(1) = {10, 11, 12, 13}; Curve Loop(2) = {20, 21, 22, 23}; Curve Loop(3) = {30:35};
Plane Surface(1) = {2, 1};
Plane Surface(2) = {3, 2};
Physical Curve("hole") = {10:13};
Physical Curve("screws") = {30, 32, 34};
Physical Surface("disc") = {1};
Physical Surface("ring") = {2};
Mesh.ElementOrder = 2;
Mesh.MshFileVersion = 4.1;
