// A wedge on a floor, under a block.
DefineConstant[ alpha = {10}, n = {20} ];
t = Tan(alpha * Pi / 180);
// wedge, 40 long, thick at its left end
Point(1) = {0, 0, 0}; Point(2) = {40, 0, 0}; Point(3) = {40, 4, 0}; Point(4) = {0, 4 + 40 * t, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Transfinite Curve{1, 3} = 2 * n + 1; Transfinite Curve{2, 4} = n / 2 + 1; Transfinite Surface{1}; Recombine Surface{1};
// block on its slope
Point(11) = {25, 4 + 15 * t, 0}; Point(12) = {35, 4 + 5 * t, 0}; Point(13) = {35, 25, 0}; Point(14) = {25, 25, 0};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(11) = {11:14}; Plane Surface(11) = {11};
Transfinite Curve{11, 13} = n + 1; Transfinite Curve{12, 14} = n + 1; Transfinite Surface{11}; Recombine Surface{11};
// floor
Point(21) = {-10, -10, 0}; Point(22) = {70, -10, 0}; Point(23) = {70, 0, 0}; Point(24) = {-10, 0, 0};
Line(21) = {21, 22}; Line(22) = {22, 23}; Line(23) = {23, 24}; Line(24) = {24, 21};
Curve Loop(21) = {21:24}; Plane Surface(21) = {21};
Transfinite Curve{21, 23} = 3 * n + 1; Transfinite Curve{22, 24} = n / 2 + 1; Transfinite Surface{21}; Recombine Surface{21};
Physical Surface("wedge") = {1}; Physical Surface("block") = {11}; Physical Surface("floor") = {21};
Physical Curve("sole") = {1}; Physical Curve("slope") = {3}; Physical Curve("back") = {4};
Physical Curve("block_bottom") = {11}; Physical Curve("block_top") = {13}; Physical Curve("floor_top") = {23}; Physical Curve("floor_bottom") = {21};
