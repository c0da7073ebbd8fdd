// Two blocks of [-1, 1] x [0, 1] and [-1, 1] x [-1, 0], rotated by `angle` degrees about the origin. Lengths in units of the scene.
//
//      upper_top                 Contact sides: upper_bottom with `upper` elements, lower_top with `lower`; no node is shared.
//      +-----------+             Unstructured triangles of order `order`; with `recombine` = 1 quadrilaterals.
//      |   upper   |
//      +-----------+ upper_bottom on lower_top
//      |   lower   |
//      +-----------+ lower_bottom
DefineConstant[ angle = {0}, upper = {12}, lower = {40}, order = {1}, recombine = {0} ];
c = Cos(angle * Pi / 180); s = Sin(angle * Pi / 180);

For k In {0:1}
  y0 = k - 1; y1 = k;  // 0: lower, 1: upper
  n = k == 0 ? lower : upper;
  p = newp;
  Point(p) = {-c - s*y0, -s + c*y0, 0}; Point(p + 1) = {c - s*y0, s + c*y0, 0};
  Point(p + 2) = {c - s*y1, s + c*y1, 0}; Point(p + 3) = {-c - s*y1, -s + c*y1, 0};
  l = newl;
  Line(l) = {p, p + 1}; Line(l + 1) = {p + 1, p + 2}; Line(l + 2) = {p + 2, p + 3}; Line(l + 3) = {p + 3, p};
  ll = newll; Curve Loop(ll) = {l, l + 1, l + 2, l + 3};
  f = news; Plane Surface(f) = {ll};
  If (k == 0)
    Transfinite Curve{l + 2} = n + 1;
    Transfinite Curve{l, l + 1, l + 3} = 9;
    Physical Surface("lower") = {f};
    Physical Curve("lower_bottom") = {l};
    Physical Curve("lower_top") = {l + 2};
  Else
    Transfinite Curve{l} = n + 1;
    Transfinite Curve{l + 2} = 12;
    Transfinite Curve{l + 1, l + 3} = 7;
    Physical Surface("upper") = {f};
    Physical Curve("upper_bottom") = {l};
    Physical Curve("upper_top") = {l + 2};
  EndIf
  If (recombine == 1)
    Recombine Surface{f};
  EndIf
EndFor
Mesh.ElementOrder = order; Mesh.SecondOrderIncomplete = 0;
Mesh.MeshSizeFromPoints = 0; Mesh.Algorithm = 6;
