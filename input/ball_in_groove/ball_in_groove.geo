// Half of a ball in a V-groove: y = 0 is the plane of symmetry, and only the part of the ball that comes near the wall is drawn, a ring about the
// y axis from the angle -m to turn + m. The ball has its centre in the origin; the wall touches it at (0, R cos b, -R sin b), where b is half of
// the angle of the groove.
DefineConstant[ R = {10}, r = {6}, half = {45}, d = {0.065}, turn = {0.2}, m = {0.12}, nt = {7}, ns = {14}, nr = {6}, g = {0.55}, w = {0.8}, depth = {4}, nw = {8}, nx = {15} ];
b = half * Pi / 180; c = -Cos(m);
e() = {b - d - 0.25, b - d, b + d, Pi / 2};      // angles from the y axis at which parts of the meridian end
n() = {2, nt, 4};
Point(1) = {0, 0, 0};
For k In {0:3}
  Point(10 + k) = {-Sin(m) * R * Sin(e(k)), R * Cos(e(k)), c * R * Sin(e(k))};
  Point(20 + k) = {-Sin(m) * r * Sin(e(k)), r * Cos(e(k)), c * r * Sin(e(k))};
  Line(30 + k) = {20 + k, 10 + k}; Transfinite Curve{30 + k} = nr + 1 Using Progression g;
EndFor
track() = {}; hub() = {}; ball() = {};
For k In {0:2}
  Circle(10 + k) = {10 + k, 1, 11 + k}; Circle(20 + k) = {20 + k, 1, 21 + k};
  Transfinite Curve{10 + k, 20 + k} = n(k) + 1;
  Curve Loop(10 + k) = {30 + k, 10 + k, -(31 + k), -(20 + k)};
  Plane Surface(10 + k) = {10 + k}; Transfinite Surface{10 + k}; Recombine Surface{10 + k};
EndFor
For k In {0:2}
  new() = Extrude{ {0, 1, 0}, {0, 0, 0}, -(turn + 2 * m) } { Surface{10 + k}; Layers{ns}; Recombine; };
  ball() += new(1); hub() += new(5);
  If (k == 1)
    track() += new(3);
  EndIf
EndFor
Physical Volume("ball") = ball(); Physical Surface("track") = track(); Physical Surface("hub") = hub();
// The wall: n is its normal into it, (0, cos b, -sin b), t = (0, sin b, cos b) is along it.
x0 = -w; x1 = R * Sin(b) * turn + w;
For k In {0:1}
  For j In {0:1}
    u = (2 * j - 1) * w; v = R + k * depth;
    Point(1001 + 2 * k + j) = {x0, v * Cos(b) + u * Sin(b), -v * Sin(b) + u * Cos(b)};
  EndFor
EndFor
Line(1001) = {1001, 1002}; Line(1002) = {1002, 1004}; Line(1003) = {1004, 1003}; Line(1004) = {1003, 1001};
Transfinite Curve{1001, 1003} = nw + 1; Transfinite Curve{1002} = nr + 1 Using Progression 1 / g; Transfinite Curve{1004} = nr + 1 Using Progression g;
Curve Loop(1001) = {1001:1004}; Plane Surface(1001) = {1001}; Transfinite Surface{1001}; Recombine Surface{1001};
new() = Extrude{x1 - x0, 0, 0} { Surface{1001}; Layers{nx}; Recombine; };
Physical Volume("wall") = {new(1)}; Physical Surface("face") = {new(2)}; Physical Surface("back") = {new(4)};
