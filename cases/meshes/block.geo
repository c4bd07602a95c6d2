// A friction block, pressed on a plane; gmsh -2 block.geo -o block.msh
w = 40; h = 60; n = 32; m = 48;   // mm: mesh.scale = 0.001
Point(1) = {0, 0, 0}; Point(2) = {w, 0, 0}; Point(3) = {w, h, 0}; Point(4) = {0, h, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 3} = n + 1; Transfinite Curve {2, 4} = m + 1;
Transfinite Surface {1}; Recombine Surface {1};
Physical Curve("face") = {1};
Physical Curve("back") = {3};
Physical Curve("side") = {2};
Physical Surface("block") = {1};
Mesh.MshFileVersion = 4.1;
