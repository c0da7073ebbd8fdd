// An eccentric disc about (0, -e) that turns about (0, 0), and a flat-faced follower above it. The disc has a hub of radius r. The half of its
// rim that meets the follower, from -60 to 120 degrees, has fine elements.
DefineConstant[ R = {10}, e = {4}, r = {3}, w = {9}, H = {10}, n = {100}, nc = {24}, m = {14}, g = {0.78}, nx = {126}, ny = {14}, order = {1} ];
Point(1) = {0, -e, 0};
For k In {0:3}
  Point(10 + k) = {R * Cos(k * Pi / 2 + Pi / 6), -e + R * Sin(k * Pi / 2 + Pi / 6), 0};
  Point(20 + k) = {r * Cos(k * Pi / 2 + Pi / 6), -e + r * Sin(k * Pi / 2 + Pi / 6), 0};
EndFor
For k In {0:3}
  Circle(10 + k) = {10 + k, 1, 10 + (k + 1) % 4};
  Circle(20 + k) = {20 + k, 1, 20 + (k + 1) % 4};
  Line(30 + k) = {20 + k, 10 + k};
  Transfinite Curve{10 + k, 20 + k} = ((k == 0 || k == 3) ? n : nc) + 1;
  Transfinite Curve{30 + k} = m + 1 Using Progression g;
EndFor
For k In {0:3}
  Curve Loop(10 + k) = {30 + k, 10 + k, -(30 + (k + 1) % 4), -(20 + k)};
  Plane Surface(10 + k) = {10 + k};
  Transfinite Surface{10 + k}; Recombine Surface{10 + k};
EndFor
y = R - e;
Point(101) = {-w, y, 0}; Point(102) = {w, y, 0}; Point(103) = {w, y + H, 0}; Point(104) = {-w, y + H, 0};
Line(101) = {101, 102}; Line(102) = {102, 103}; Line(103) = {103, 104}; Line(104) = {104, 101};
Transfinite Curve{101, 103} = nx + 1; Transfinite Curve{102} = ny + 1 Using Progression 1 / g; Transfinite Curve{104} = ny + 1 Using Progression g;
Curve Loop(101) = {101:104}; Plane Surface(101) = {101}; Transfinite Surface{101}; Recombine Surface{101};
Physical Surface("disc") = {10:13}; Physical Surface("follower") = {101};
Physical Curve("rim") = {10:13}; Physical Curve("hub") = {20:23}; Physical Curve("face") = {101}; Physical Curve("top") = {103};
Mesh.ElementOrder = order;
