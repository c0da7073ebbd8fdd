// A masonry arch of n voussoirs between two abutments. Lengths in m.
//
//          .-'"|"'-.                 Joint k, k = 0 .. n, has two sides: joint_<k>_right, of the part to the right (below in the
//        .'\   |   /'.               order of angles), and joint_<k>_left. It is radial with a key: a tooth with 45-degree flanks in the
//       /   \  |  /   \              middle, since a plain radial joint without friction cannot carry shear.
//  left |----'   '-----| right       Abutments are blocks behind joint 0 (right) and joint n (left), held at the base.
//
DefineConstant[ n = {21, Name "voussoirs"}, r1 = {4.5}, r2 = {5.5}, opening = {157.5}, key = {0.1}, h = {0.1, Name "size"}, loaded = {15} ];
rm = (r1 + r2) / 2; ra = rm - 2*key; rb = rm + 2*key;  // the tooth: from ra to rb, its tip offset by `key` from the radius ...
nj = Ceil((ra - r1) / h); nk = Ceil(2 * key / h) + 1;  // elements on the plain parts of a joint, on each flank of a tooth
// ... with a flat tip of 2 key: rm - key .. rm + key

Function Joint  // points and lines of the side of joint k, from r1 to r2
  t = (180 - opening) / 2 * Pi / 180 + k * opening / n * Pi / 180;
  p = newp; l = newl;
  Point(p) = {r1*Cos(t), r1*Sin(t), 0, h};
  Point(p + 1) = {ra*Cos(t), ra*Sin(t), 0, h};
  Point(p + 2) = {(rm - key)*Cos(t) - key*Sin(t), (rm - key)*Sin(t) + key*Cos(t), 0, h};
  Point(p + 3) = {(rm + key)*Cos(t) - key*Sin(t), (rm + key)*Sin(t) + key*Cos(t), 0, h};
  Point(p + 4) = {rb*Cos(t), rb*Sin(t), 0, h};
  Point(p + 5) = {r2*Cos(t), r2*Sin(t), 0, h};
  For i In {0:4}
    Line(l + i) = {p + i, p + i + 1};
  EndFor
  Transfinite Curve{l, l + 4} = nj + 1;
  Transfinite Curve{l + 1, l + 2, l + 3} = nk + 1;
Return

centre = newp; Point(centre) = {0, 0, 0};
For v In {1:n}  // voussoir v between joint v - 1, its right side, and joint v
  k = v - 1;
  Call Joint;
  pr = p; lr = l; k = v;
  Call Joint;
  pl = p; ll = l;
  c = newl; Circle(c) = {pr, centre, pl}; Circle(c + 1) = {pr + 5, centre, pl + 5};
  w = newll; Curve Loop(w) = {lr:lr+4, c + 1, -(ll+4), -(ll+3), -(ll+2), -(ll+1), -ll, -c};
  s = news; Plane Surface(s) = {w};
  Physical Surface(Sprintf("voussoir_%02g", v)) = {s};
  Physical Curve(Sprintf("joint_%02g_left", v - 1)) = {lr:lr+4};
  Physical Curve(Sprintf("joint_%02g_right", v)) = {ll:ll+4};
  If (v == loaded)
    Physical Curve("load") = {c + 1};
  EndIf
EndFor

// abutments: the arch continues to y = 0 and below, as a block
k = 0;
Call Joint;
a = newp; Point(a) = {r2 + 0.5, Sin(t)*r2, 0, 2*h}; Point(a + 1) = {r2 + 0.5, 0, 0, 3*h}; Point(a + 2) = {r1 - 0.5, 0, 0, 3*h}; Point(a + 3) = {r1 - 0.5, Sin(t)*r1, 0, 2*h};
b = newl; Line(b) = {p + 5, a}; Line(b + 1) = {a, a + 1}; Line(b + 2) = {a + 1, a + 2}; Line(b + 3) = {a + 2, a + 3}; Line(b + 4) = {a + 3, p};
w = newll; Curve Loop(w) = {l:l+4, b:b+4}; s = news; Plane Surface(s) = {w};
Physical Surface("right") = {s};
Physical Curve("joint_00_right") = {l:l+4};
Physical Curve("base_right") = {b + 2};
k = n;
Call Joint;
a = newp; Point(a) = {-r2 - 0.5, Sin(t)*r2, 0, 2*h}; Point(a + 1) = {-r2 - 0.5, 0, 0, 3*h}; Point(a + 2) = {-r1 + 0.5, 0, 0, 3*h}; Point(a + 3) = {-r1 + 0.5, Sin(t)*r1, 0, 2*h};
b = newl; Line(b) = {p + 5, a}; Line(b + 1) = {a, a + 1}; Line(b + 2) = {a + 1, a + 2}; Line(b + 3) = {a + 2, a + 3}; Line(b + 4) = {a + 3, p};
w = newll; Curve Loop(w) = {l:l+4, b:b+4}; s = news; Plane Surface(s) = {w};
Physical Surface("left") = {s};
Physical Curve(Sprintf("joint_%02g_left", n)) = {l:l+4};
Physical Curve("base_left") = {b + 2};
