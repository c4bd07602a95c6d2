// The paper's disc with its hole off centre; gmsh -2 -setnumber e 4 offcentre.geo -o offcentre-4.msh
a = 20.5; b = 90.5; DefineConstant[ e = {8, Name "Parameters/eccentricity"} ];    // mm; e: how far the hole is off centre (gmsh -2 -setnumber e 4 ...)
SetFactory("Built-in");
Point(1) = {0, 0, 0, 1};          // axis of the shaft and of the hole
Point(10) = {-e, 0, 0, 1};        // centre of the disc
Point(2) = {a, 0, 0, 1.9}; Point(3) = {0, a, 0, 1.9}; Point(4) = {-a, 0, 0, 1.9}; Point(5) = {0, -a, 0, 1.9};
Point(6) = {b-e, 0, 0, 5}; Point(7) = {-e, b, 0, 5}; Point(8) = {-b-e, 0, 0, 5}; Point(9) = {-e, -b, 0, 5};
Circle(1) = {2, 1, 3}; Circle(2) = {3, 1, 4}; Circle(3) = {4, 1, 5}; Circle(4) = {5, 1, 2};
Circle(5) = {6, 10, 7}; Circle(6) = {7, 10, 8}; Circle(7) = {8, 10, 9}; Circle(8) = {9, 10, 6};
Curve Loop(1) = {5, 6, 7, 8}; Curve Loop(2) = {1, 2, 3, 4};
Plane Surface(1) = {1, 2};
Physical Curve("inner") = {1, 2, 3, 4};
Physical Curve("outer") = {5, 6, 7, 8};
Physical Surface("disc") = {1};
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
Mesh.MshFileVersion = 4.1;
