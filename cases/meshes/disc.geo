// The paper's disc, hole of radius a in a disc of radius b; gmsh -2 disc.geo -o disc.msh
a = 20.5; b = 90.5;            // mm: mesh.scale = 0.001
SetFactory("Built-in");
Point(1) = {0, 0, 0, 1};
Point(2) = {a, 0, 0, 1.9}; Point(3) = {0, a, 0, 1.9}; Point(4) = {-a, 0, 0, 1.9}; Point(5) = {0, -a, 0, 1.9};
Point(6) = {b, 0, 0, 5}; Point(7) = {0, b, 0, 5}; Point(8) = {-b, 0, 0, 5}; Point(9) = {0, -b, 0, 5};
Circle(1) = {2, 1, 3}; Circle(2) = {3, 1, 4}; Circle(3) = {4, 1, 5}; Circle(4) = {5, 1, 2};
Circle(5) = {6, 1, 7}; Circle(6) = {7, 1, 8}; Circle(7) = {8, 1, 9}; Circle(8) = {9, 1, 6};
Curve Loop(1) = {5, 6, 7, 8}; Curve Loop(2) = {1, 2, 3, 4};
Plane Surface(1) = {1, 2};
Physical Curve("inner") = {1, 2, 3, 4};
Physical Curve("outer") = {5, 6, 7, 8};
Physical Surface("disc") = {1};
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
Mesh.MshFileVersion = 4.1;
