// Tunnel crossed by a fault: reconstruction of Danek's model problem (his Fig. 1 is lost). Units: m.
//
//      1 -------- 5 --------------- 4     corners 1, 2, 3, 4; the fault runs from 5 (top) to 6 (tunnel wall) and from
//      |           \                |     7 (tunnel wall) to 8 (bottom), straight through the tunnel's centre, leaning by
//      |  left    6 ( )  right      |     `tilt` degrees from the vertical (to the left at the top where tilt < 0).
//      |             \ 7            |
//      2 ------------- 8 ---------- 3
//
// Two bodies that never share a node: each is a shape of its own, never fragmented with the other, under one size field,
// so that the nodes of both sides of the straight fault coincide. Every surface is one of twelve subdomains; in each body:
// two contact strips (above and below the tunnel, normal width cx < R, so that a strip ends on the tunnel wall and no seam
// meets the fault) and four outer parts.
SetFactory("OpenCASCADE");
DefineConstant[ W = {120}, H = {80}, R = {6}, xc = {60}, yc = {39.5}, tilt = {-25},
                hf = {0.89}, ho = {1.92}, dist = {24}, cx = {5}, cx2 = {32}, scale = {1} ];
t = Tan(tilt*Pi/180); c = Cos(tilt*Pi/180); s = Sin(tilt*Pi/180); b = Sqrt(R*R - cx*cx);

For k In {0:1}
  side = 2*k - 1;  // -1: left body, +1: right body
  x0 = k*W;
  p = newp;
  Point(p) = {x0, 0, 0}; Point(p+1) = {xc - yc*t, 0, 0}; Point(p+2) = {xc + (H-yc)*t, H, 0}; Point(p+3) = {x0, H, 0};
  l = newl;
  Line(l) = {p, p+1}; Line(l+1) = {p+1, p+2}; Line(l+2) = {p+2, p+3}; Line(l+3) = {p+3, p};
  ll = newll; Curve Loop(ll) = {l, l+1, l+2, l+3};
  half = news; Plane Surface(half) = {ll};
  hole = news; Disk(hole) = {xc, yc, 0, R};
  cut() = BooleanDifference{ Surface{half}; Delete; }{ Surface{hole}; Delete; };
  q = newp;  // seams: the strip above and below the tunnel, the far parallel, the horizontal
  Point(q)   = {xc + side*cx/c + (H-yc)*t, H, 0};  Point(q+1) = {xc + side*cx*c + b*s, yc - side*cx*s + b*c, 0};
  Point(q+2) = {xc + side*cx*c - b*s, yc - side*cx*s - b*c, 0};  Point(q+3) = {xc + side*cx/c - yc*t, 0, 0};
  Point(q+4) = {xc + side*cx2 + (H-yc)*t, H, 0};   Point(q+5) = {xc + side*cx2 - yc*t, 0, 0};
  Point(q+6) = {xc + side*R, yc, 0};               Point(q+7) = {x0, yc, 0};
  m = newl;
  Line(m) = {q, q+1}; Line(m+1) = {q+2, q+3}; Line(m+2) = {q+4, q+5}; Line(m+3) = {q+6, q+7};
  BooleanFragments{ Surface{cut()}; Delete; }{ Line{m, m+1, m+2, m+3}; Delete; }
EndFor

Field[1] = MathEval;  // scale*hf on the fault and the tunnel, growing linearly to scale*ho at distance `dist`
Field[1].F = Sprintf("%g*Min(%g+(%g)*Min(1,Min(Abs((x-(%g))*(%g)-(y-(%g))*(%g)),Abs(Sqrt((x-(%g))^2+(y-(%g))^2)-%g))/%g),%g)",
   scale, hf, ho-hf, xc, c, yc, s, xc, yc, R, dist, ho);
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0; Mesh.Algorithm = 6;

// Names. Tags are those that OpenCASCADE gives in the order above; they hold while the topology does (cx < R, cx < cx2).
Physical Surface("left") = {1:6};
Physical Surface("right") = {7:12};
For k In {1:12}
  Physical Surface(Sprintf("subdomain_%02g", k), 100 + k) = {k};
EndFor
Physical Curve("left_side") = {12, 15};
Physical Curve("right_side") = {39, 42};
Physical Curve("top") = {9, 16, 21, 48, 43, 36};
Physical Curve("bottom") = {14, 20, 26, 53, 47, 41};
Physical Curve("tunnel_wall") = {17, 19, 23, 24, 44, 46, 50, 51};
Physical Curve("fault_upper_left") = {22};
Physical Curve("fault_upper_right") = {49};
Physical Curve("