// A plate on a block, rotated by `angle` degrees about the origin, moved by (dx, dy), all lengths times `unit`.
//
//      left_top, right_top
//      +---+-------+  y = 0.4      upper: its left third is pressed; upper_left slides along a wall
//      |   upper   |               contact sides: upper_bottom with `division` elements, lower_top with `ratio` times as many
//      +-----------+  y = 0
//      |   lower   |               structured triangles: the mesh is the same after any motion
//      +-----------+  y = -1: lower_bottom
//     x = -1      x = 1
//
// reversed = 1: the bodies are made in reverse order, and every line from its other end: everything is renumbered.
DefineConstant[ angle = {0}, dx = {0}, dy = {0}, unit = {1}, division = {24}, ratio = {1}, reversed = {0} ];
c = Cos(angle * Pi / 180) * unit; s = Sin(angle * Pi / 180) * unit;

For j In {0:1}
  k = reversed == 1 ? 1 - j : j;
  y0 = k == 0 ? -1 : 0; y1 = k == 0 ? 0 : 0.4;
  n = k == 0 ? Round(ratio * division) : division;
  m = k == 0 ? Round(n / 2) : Round(n / 4);
  p = newp;
  If (reversed == 1)
    p0 = p + 5; p1 = p + 3; p2 = p + 4; p3 = p + 1; p4 = p; p5 = p + 2;
  Else
    p0 = p; p1 = p + 1; p2 = p + 2; p3 = p + 3; p4 = p + 4; p5 = p + 5;
  EndIf
  xm = -1 + 2 * 8 / 24;
  Point(p0) = {dx - c - s*y0, dy - s + c*y0, 0}; Point(p1) = {dx + c*xm - s*y0, dy + s*xm + c*y0, 0}; Point(p2) = {dx + c - s*y0, dy + s + c*y0, 0};
  Point(p3) = {dx + c - s*y1, dy + s + c*y1, 0}; Point(p4) = {dx + c*xm - s*y1, dy + s*xm + c*y1, 0}; Point(p5) = {dx - c - s*y1, dy - s + c*y1, 0};
  l = newl;
  If (reversed == 1)
    Line(l + 6) = {p1, p0}; Line(l + 5) = {p2, p1}; Line(l + 4) = {p3, p2}; Line(l + 3) = {p4, p3}; Line(l + 2) = {p5, p4}; Line(l + 1) = {p0, p5};
    Line(l) = {p4, p1};
    b0 = l + 6; b1 = l + 5; r = l + 4; t1 = l + 3; t0 = l + 2; w = l + 1; mid = l;
    Curve Loop(l) = {-b0, -mid, -t0, -w}; Curve Loop(l + 1) = {-b1, -r, -t1, mid};
  Else
    Line(l) = {p0, p1}; Line(l + 1) = {p1, p2}; Line(l + 2) = {p2, p3}; Line(l + 3) = {p3, p4}; Line(l + 4) = {p4, p5}; Line(l + 5) = {p5, p0};
    Line(l + 6) = {p1, p4};
    b0 = l; b1 = l + 1; r = l + 2; t1 = l + 3; t0 = l + 4; w = l + 5; mid = l + 6;
    Curve Loop(l) = {b0, mid, t0, w}; Curve Loop(l + 1) = {b1, r, t1, -mid};
  EndIf
  f = news;
  Plane Surface(f) = {l}; Plane Surface(f + 1) = {l + 1};
  Transfinite Curve{b0, t0} = Round(n / 3) + 1; Transfinite Curve{b1, t1} = n - Round(n / 3) + 1; Transfinite Curve{r, w, mid} = m + 1;
  Transfinite Surface{f} = {p0, p1, p4, p5} Left; Transfinite Surface{f + 1} = {p1, p2, p3, p4} Left;
  If (k == 0)
    Physical Surface("lower") = {f, f + 1};
    Physical Curve("lower_bottom") = {b0, b1};
    Physical Curve("lower_top") = {t0, t1};
  Else
    Physical Surface("upper") = {f, f + 1};
    Physical Curve("upper_bottom") = {b0, b1};
    Physical Curve("upper_left") = {w};
    Physical Curve("left_top") = {t0};
  EndIf
EndFor
Mesh.MeshSizeFromPoints = 0;
