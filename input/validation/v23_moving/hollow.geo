// A roller of radius r about (0, 0) in a hollow of radius R.
DefineConstant[ r = {8}, R = {10}, hub = {2}, n = {40}, m = {10}, nh = {200}, mh = {8} ];
Point(1) = {0, 0, 0}; Point(2) = {0, R - r, 0};
For k In {0:3}
  Point(10 + k) = {r * Sin(k * Pi / 2 + Pi / 4), -r * Cos(k * Pi / 2 + Pi / 4), 0}; Point(20 + k) = {hub * Sin(k * Pi / 2 + Pi / 4), -hub * Cos(k * Pi / 2 + Pi / 4), 0};
EndFor
For k In {0:3}
  Circle(10 + k) = {10 + k, 1, 10 + (k + 1) % 4}; Circle(20 + k) = {20 + k, 1, 20 + (k + 1) % 4}; Line(30 + k) = {20 + k, 10 + k};
  Transfinite Curve{10 + k, 20 + k} = n + 1; Transfinite Curve{30 + k} = m + 1 Using Progression 0.9;
EndFor
For k In {0:3}
  Curve Loop(10 + k) = {30 + k, 10 + k, -(30 + (k + 1) % 4), -(20 + k)}; Plane Surface(10 + k) = {10 + k}; Transfinite Surface{10 + k}; Recombine Surface{10 + k};
EndFor
For k In {0:2}  // angles -90, 0, 90 degrees from below
  a = (k - 1) * Pi / 2;
  Point(40 + k) = {R * Sin(a), R - r - R * Cos(a), 0}; Point(50 + k) = {(R + 6) * Sin(a), R - r - (R + 6) * Cos(a), 0};
  Line(60 + k) = {40 + k, 50 + k}; Transfinite Curve{60 + k} = mh + 1 Using Progression 1.25;
EndFor
For k In {0:1}
  Circle(40 + k) = {40 + k, 2, 41 + k}; Circle(50 + k) = {50 + k, 2, 51 + k}; Transfinite Curve{40 + k, 50 + k} = nh / 2 + 1;
  Curve Loop(40 + k) = {60 + k, 50 + k, -(61 + k), -(40 + k)}; Plane Surface(40 + k) = {40 + k}; Transfinite Surface{40 + k}; Recombine Surface{40 + k};
EndFor
Physical Surface("roller") = {10:13}; Physical Surface("trough") = {40, 41};
Physical Curve("rim") = {10:13}; Physical Curve("hub") = {20:23}; Physical Curve("hollow") = {40, 41}; Physical Curve("outside") = {50, 51};
