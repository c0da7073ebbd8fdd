// A quarter of a solid stadium (lines and arcs of radius 1) inside a layer of thickness 1: x = 0 and y = 0 are symmetry planes.
DefineConstant[ ho = {0.2}, hi = {0.14}, quads = {0}, order = {1} ];
Point(1) = {0, 0, 0, hi}; Point(2) = {1, 0, 0, hi}; Point(3) = {2, 0, 0, hi}; Point(4) = {1, 1, 0, hi}; Point(5) = {0, 1, 0, hi};
Line(1) = {1, 2}; Line(2) = {2, 3}; Circle(3) = {3, 2, 4}; Line(4) = {4, 5}; Line(5) = {5, 1};
Curve Loop(1) = {1, 2, 3, 4, 5}; Plane Surface(1) = {1};
Point(11) = {1, 0, 0, ho}; Point(12) = {2, 0, 0, ho}; Point(13) = {3, 0, 0, ho}; Point(14) = {1, 2, 0, ho}; Point(15) = {0, 2, 0, ho};
Point(16) = {0, 1, 0, ho}; Point(17) = {1, 1, 0, ho};
Line(11) = {12, 13}; Circle(12) = {13, 11, 14}; Line(13) = {14, 15}; Line(14) = {15, 16}; Line(15) = {16, 17}; Circle(16) = {17, 11, 12};
Curve Loop(2) = {11, 12, 13, 14, 15, 16}; Plane Surface(2) = {2};
If (quads == 1)
  Recombine Surface {1, 2};
EndIf
Mesh.ElementOrder = order;
Physical Surface("core") = {1};
Physical Surface("layer") = {2};
Physical Curve("core_contact") = {3, 4};
Physical Curve("layer_contact") = {15, 16};
Physical Curve("outside") = {12, 13};
Physical Curve("x0") = {5, 14};
Physical Curve("y0") = {1, 2, 11};
