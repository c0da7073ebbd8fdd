// A bracket with a re-entrant corner, turned by an angle in degrees.
DefineConstant[ angle = {0}, h = {0.5} ];
c = Cos(angle * Pi / 180); s = Sin(angle * Pi / 180);
Point(1) = {0, 0, 0, h};
Point(2) = {3 * c, 3 * s, 0, h};
Point(3) = {3 * c - s, 3 * s + c, 0, h};
Point(4) = {c - s, s + c, 0, h};
Point(5) = {c - 3 * s, s + 3 * c, 0, h};
Point(6) = {-3 * s, 3 * c, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1};
Curve Loop(1) = {1:6}; Plane Surface(1) = {1};
Physical Surface("bracket") = {1};
Physical Curve("wall") = {5};
Physical Curve("top") = {3};
