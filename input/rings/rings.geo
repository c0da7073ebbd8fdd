// Two concentric rings in contact, a quarter: x = 0 and y = 0 are symmetry planes.
//
//   y
//   |___
//   |   `-.  outside (r = r2)         body outer: r1 < r < r2, body inner: r0 < r < r1
//   |      `.
//   |__ outer\                        contact sides, both r = r1: outer_contact, inner_contact
//   |  `-.    \                       symmetry sides: outer_y0, inner_y0 (y = 0), outer_x0, inner_x0 (x = 0)
//   |_inner\   |
//      `\   |  |
//        |__|__|___ x
//        r0 r1 r2
//
// Triangles, with quads = 1 quadrilaterals in the outer ring (and triangles in the inner one), with quads = 2 in both; order = 2: quadratic
// elements, whose sides on the arcs are curved. Structured meshes. With ratio = 1 both have the same division along the arcs, so that the nodes on
// r = r1 coincide; the bodies share no nodes.
DefineConstant[ r0 = {0.2}, r1 = {0.6}, r2 = {1.0}, division = {48}, ratio = {1}, order = {1}, quads = {0} ];
nr = Round(division / 3);  // elements across a ring

For k In {0:1}  // 0: inner, 1: outer
  If (k == 0)
    ri = r0; ro = r1; n = Round(ratio * division);
  Else
    ri = r1; ro = r2; n = division;
  EndIf
  p = newp;
  Point(p) = {0, 0, 0};
  Point(p + 1) = {ri, 0, 0}; Point(p + 2) = {0, ri, 0};
  Point(p + 3) = {ro, 0, 0}; Point(p + 4) = {0, ro, 0};
  l = newl;
  Circle(l) = {p + 1, p, p + 2};      // inside
  Circle(l + 1) = {p + 3, p, p + 4};  // outside
  Line(l + 2) = {p + 1, p + 3};       // y = 0
  Line(l + 3) = {p + 2, p + 4};       // x = 0
  ll = newll; Curve Loop(ll) = {l + 2, l + 1, -(l + 3), -l};
  s = news; Plane Surface(s) = {ll};
  Transfinite Curve{l, l + 1} = n + 1;
  Transfinite Curve{l + 2, l + 3} = nr + 1;
  Transfinite Surface{s} Alternated;
  If (quads + k > 1)
    Recombine Surface{s};
  EndIf
  If (k == 0)
    Physical Surface("inner") = {s};
    Physical Curve("inner_contact") = {l + 1};
    Physical Curve("inner_y0") = {l + 2};
    Physical Curve("inner_x0") = {l + 3};
    Physical Curve("bore") = {l};
  Else
    Physical Surface("outer") = {s};
    Physical Curve("outer_contact") = {l};
    Physical Curve("outside") = {l + 1};
    Physical Curve("outer_y0") = {l + 2};
    Physical Curve("outer_x0") = {l + 3};
  EndIf
EndFor
Mesh.ElementOrder = order; Mesh.SecondOrderIncomplete = 0;
