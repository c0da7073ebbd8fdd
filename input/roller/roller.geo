DefineConstant[ n = {60}, m = {14}, R = {10}, r = {3}, g = {0.85}, nx = {130}, ny = {14}, L = {30} ];
Point(1) = {0, R, 0}; 
For k In {0:3}
  Point(10 + k) = {R * Cos(k * Pi / 2), R + R * Sin(k * Pi / 2), 0};
  Point(20 + k) = {r * Cos(k * Pi / 2), R + r * Sin(k * Pi / 2), 0};
EndFor
For k In {0:3}
  Circle(10 + k) = {10 + k, 1, 10 + (k + 1) % 4};
  Circle(20 + k) = {20 + k, 1, 20 + (k + 1) % 4};
  Line(30 + k) = {20 + k, 10 + k};
  Transfinite Curve{10 + k, 20 + k} = n + 1;
  Transfinite Curve{30 + k} = m + 1 Using Progression g;
EndFor
For k In {0:3}
  Curve Loop(10 + k) = {30 + k, 10 + k, -(30 + (k + 1) % 4), -(20 + k)};
  Plane Surface(10 + k) = {10 + k};
  Transfinite Surface{10 + k}; Recombine Surface{10 + k};
EndFor
Point(101) = {-10, -12, 0}; Point(102) = {L, -12, 0}; Point(103) = {L, 0, 0}; Point(104) = {-10, 0, 0};
Line(101) = {101, 102}; Line(102) = {102, 103}; Line(103) = {103, 104}; Line(104) = {104, 101};
Transfinite Curve{101, 103} = nx + 1; Transfinite Curve{102} = ny + 1 Using Progression g; Transfinite Curve{104} = ny + 1 Using Progression 1 / g;
Curve Loop(101) = {101:104}; Plane Surface(101) = {101}; Transfinite Surface{101}; Recombine Surface{101};
Physical Surface("roller") = {10:13}; Physical Surface("plane") = {101};
Physical Curve("rim") = {10:13}; Physical Curve("hub") = {20:23}; Physical Curve("top") = {103}; Physical Curve("bottom") = {101};
