// A bracket on a wall and a roller on its arm. Lengths in mm; h: element size.
DefineConstant[ h = {2, Name "size"} ];
SetFactory("OpenCASCADE");
fine = h / 40;  // where the roller touches the arm

// the bracket: a plate on the wall (x = 0), an arm, a fillet of 8 between them
Point(1) = {0, 0, 0, h};      Point(2) = {80, 0, 0, h};     Point(3) = {80, 12, 0, h};    Point(4) = {18, 12, 0, h/3};
Point(5) = {10, 20, 0, h/3};  Point(6) = {10, 80, 0, h};    Point(7) = {0, 80, 0, h};     Point(8) = {18, 20, 0};
Point(9) = {54, 12, 0, fine}; Point(10) = {56, 12, 0, fine};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 10}; Line(4) = {10, 9}; Line(5) = {9, 4};
Circle(6) = {4, 8, 5}; Line(7) = {5, 6}; Line(8) = {6, 7}; Line(9) = {7, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7, 8, 9};
Plane Surface(1) = {1};

// the roller: a disc of radius 15 that touches the arm at x = 55
a = 1 / 15;
Point(20) = {55, 27, 0};
Point(21) = {55 - 15*Sin(a), 27 - 15*Cos(a), 0, fine}; Point(22) = {55 + 15*Sin(a), 27 - 15*Cos(a), 0, fine};
Point(23) = {70, 27, 0, h}; Point(24) = {40, 27, 0, h}; Point(25) = {55, 42, 0, h};
Circle(21) = {21, 20, 22}; Circle(22) = {22, 20, 23}; Circle(23) = {23, 20, 25}; Circle(24) = {25, 20, 24}; Circle(25) = {24, 20, 21};
Curve Loop(2) = {21, 22, 23, 24, 25};
Plane Surface(2) = {2};

// names: surfaces are bodies, curves are sides for conditions and contact
Physical Surface("bracket") = {1};
Physical Surface("roller") = {2};
Physical Curve("wall") = {9};
Physical Curve("arm_top") = {4};
Physical Curve("roller_bottom") = {21};
Physical Curve("roller_top") = {23, 24};
