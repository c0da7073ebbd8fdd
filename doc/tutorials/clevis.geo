// A quarter of a clevis joint in mm: the eye of a rod, a lug and the pin through both. gmsh clevis.geo -0 -o clevis.step
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, 6, 13};       // rod: a ring of radius 13 and a bar to the left, half of its thickness
Box(2) = {-45, -7, 0, 45, 14, 6};
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {0, 0, -1, 0, 0, 8, 6.05};    // its hole, .05 larger than the pin
BooleanDifference(5) = { Volume{3}; Delete; }{ Volume{4}; Delete; };
Cylinder(6) = {0, 0, 6.5, 0, 0, 7, 13};     // lug: a ring and a plate to the right, .5 above the rod
Box(7) = {0, -13, 6.5, 40, 26, 7};
BooleanUnion(8) = { Volume{6}; Delete; }{ Volume{7}; Delete; };
Cylinder(9) = {0, 0, 5.5, 0, 0, 9, 6.02};   // its hole, .02 larger than the pin
BooleanDifference(10) = { Volume{8}; Delete; }{ Volume{9}; Delete; };
Cylinder(11) = {0, 0, 0, 0, 0, 14.5, 6};    // pin
Box(12) = {-60, -60, -1, 120, 60, 60};      // half of everything: y = 0 is a plane of symmetry
BooleanDifference{ Volume{5, 10, 11}; Delete; }{ Volume{12}; Delete; }
