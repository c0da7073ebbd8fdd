// A quarter of two rings, the inner one too large for the outer one by 0.02 mm: matching nodes, triangles of alternating diagonals.
DefineConstant[ along = 8, across = 4, quads = 0 ];
a = 10; b = 20; c = 30; interference = 0.02;
Point(9) = {0, 0, 0};
r() = {a, b + interference / 2, b - interference / 2, c};
For k In {0:1}
  p = 10 * (k + 1);
  Point(p) = {r(2 * k), 0, 0};
  Point(p + 1) = {r(2 * k + 1), 0, 0};
  Point(p + 2) = {0, r(2 * k + 1), 0};
  Point(p + 3) = {0, r(2 * k), 0};
  Line(p) = {p, p + 1};
  Circle(p + 1) = {p + 1, 9, p + 2};
  Line(p + 2) = {p + 2, p + 3};
  Circle(p + 3) = {p + 3, 9, p};
  Transfinite Curve {p, p + 2} = across + 1;
  Transfinite Curve {p + 1, p + 3} = along + 1;
  Curve Loop(p) = {p:p + 3};
  Plane Surface(p) = {p};
  Transfinite Surface {p} AlternateRight;
  If (quads)
    Recombine Surface {p};
  EndIf
EndFor
Physical Surface("inner") = {10};
Physical Surface("outer") = {20};
Physical Curve("outside of the inner") = {11};
Physical Curve("bore of the outer") = {23};
Physical Curve("level") = {10, 20};
Physical Curve("upright") = {12, 22};
