// Rock with two faults, a tunnel driven in three parts (heading, bench, invert) and its lining. Every body has its own points: bodies share
// no nodes, also where they touch.
DefineConstant[ W = {40}, H = {30}, R = {3}, t = {0.3}, d = {5}, dip = {60}, h = {0.35}, hf = {1}, H0 = {4} ];
s = 1 / Tan(dip * Pi / 180);  // horizontal distance per height along a fault
// left and right block; the faults dip to the right, through (-d, 0) and (d, 0)
Point(1) = {-W, -H, 0, H0};  Point(2) = {-d - H*s, -H, 0, hf*2};  Point(3) = {-d + H*s, H, 0, hf*2};  Point(4) = {-W, H, 0, H0};
Point(9) = {-d, 0, 0, hf/2};
Line(1) = {1, 2};  Line(2) = {2, 9};  Line(12) = {9, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 12, 3, 4};  Plane Surface(1) = {1};
Point(5) = {d - H*s, -H, 0, hf*2};  Point(6) = {W, -H, 0, H0};  Point(7) = {W, H, 0, H0};  Point(8) = {d + H*s, H, 0, hf*2};
Point(10) = {d, 0, 0, hf/2};
Line(5) = {5, 6};  Line(6) = {6, 7};  Line(7) = {7, 8};  Line(8) = {8, 10};  Line(18) = {10, 5};
Curve Loop(2) = {5, 6, 7, 8, 18};  Plane Surface(2) = {2};
// the rock between the faults, with the circular opening
Point(11) = {-d - H*s, -H, 0, hf*2};  Point(12) = {d - H*s, -H, 0, hf*2};  Point(13) = {d + H*s, H, 0, hf*2};  Point(14) = {-d + H*s, H, 0, hf*2};
Point(15) = {d, 0, 0, hf/2};  Point(16) = {-d, 0, 0, hf/2};
Line(21) = {11, 12};  Line(22) = {12, 15};  Line(32) = {15, 13};  Line(23) = {13, 14};  Line(24) = {14, 16};  Line(34) = {16, 11};
y1 = 0.3*R;  y2 = -0.5*R;  x1 = Sqrt(R*R - y1*y1);  x2 = Sqrt(R*R - y2*y2);
Point(20) = {0, 0, 0, h};
Point(21) = {x1, y1, 0, h};  Point(22) = {0, R, 0, h};  Point(23) = {-x1, y1, 0, h};  Point(24) = {-x2, y2, 0, h};  Point(25) = {0, -R, 0, h};  Point(26) = {x2, y2, 0, h};
Circle(41) = {21, 20, 22};  Circle(42) = {22, 20, 23};  Circle(43) = {23, 20, 24};  Circle(44) = {24, 20, 25};  Circle(45) = {25, 20, 26};  Circle(46) = {26, 20, 21};
Curve Loop(3) = {21, 22, 32, 23, 24, 34};  Curve Loop(4) = {41, 42, 43, 44, 45, 46};
Plane Surface(3) = {3, 4};
// heading
Point(31) = {x1, y1, 0, h};  Point(32) = {0, R, 0, h};  Point(33) = {-x1, y1, 0, h};
Circle(51) = {31, 20, 32};  Circle(52) = {32, 20, 33};  Line(53) = {33, 31};
Curve Loop(5) = {51, 52, 53};  Plane Surface(4) = {5};
// bench
Point(34) = {x1, y1, 0, h};  Point(35) = {-x1, y1, 0, h};  Point(36) = {-x2, y2, 0, h};  Point(37) = {x2, y2, 0, h};
Line(54) = {34, 35};  Circle(55) = {35, 20, 36};  Line(56) = {36, 37};  Circle(57) = {37, 20, 34};
Curve Loop(6) = {54, 55, 56, 57};  Plane Surface(5) = {6};
// invert
Point(38) = {-x2, y2, 0, h};  Point(39) = {0, -R, 0, h};  Point(40) = {x2, y2, 0, h};
Circle(58) = {38, 20, 39};  Circle(59) = {39, 20, 40};  Line(60) = {40, 38};
Curve Loop(7) = {58, 59, 60};  Plane Surface(6) = {7};
// lining
hl = t / 1.5;
Point(51) = {R, 0, 0, hl};  Point(52) = {0, R, 0, hl};  Point(53) = {-R, 0, 0, hl};  Point(54) = {0, -R, 0, hl};
Point(55) = {R-t, 0, 0, hl};  Point(56) = {0, R-t, 0, hl};  Point(57) = {t-R, 0, 0, hl};  Point(58) = {0, t-R, 0, hl};
Circle(71) = {51, 20, 52};  Circle(72) = {52, 20, 53};  Circle(73) = {53, 20, 54};  Circle(74) = {54, 20, 51};
Circle(75) = {55, 20, 56};  Circle(76) = {56, 20, 57};  Circle(77) = {57, 20, 58};  Circle(78) = {58, 20, 55};
Curve Loop(8) = {71, 72, 73, 74};  Curve Loop(9) = {75, 76, 77, 78};  Plane Surface(7) = {8, 9};

Physical Surface("left") = {1};  Physical Surface("middle") = {3};  Physical Surface("right") = {2};
Physical Surface("heading") = {4};  Physical Surface("bench") = {5};  Physical Surface("invert") = {6};  Physical Surface("lining") = {7};
Physical Curve("bottom") = {1, 5, 21};  Physical Curve("top") = {3, 7, 23};  Physical Curve("west") = {4};  Physical Curve("east") = {6};
Physical Curve("fault_1_left") = {2, 12};  Physical Curve("fault_1_right") = {24, 34};
Physical Curve("fault_2_left") = {22, 32};  Physical Curve("fault_2_right") = {8, 18};
Physical Curve("wall_heading") = {41, 42};  Physical Curve("wall_bench") = {43, 46};  Physical Curve("wall_invert") = {44, 45};
Physical Curve("heading_arch") = {51, 52};  Physical Curve("heading_floor") = {53};
Physical Curve("bench_roof") = {54};  Physical Curve("bench_walls") = {55, 57};  Physical Curve("bench_floor") = {56};
Physical Curve("invert_roof") = {60};  Physical Curve("invert_arch") = {58, 59};
Physical Curve("lining_outside") = {71, 72, 73, 74};  Physical Curve("lining_inside") = {75, 76, 77, 78};
Mesh.ElementOrder = 2;
