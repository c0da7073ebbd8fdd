// A thread of a screw, -150 to 70 degrees about z, and above it a part of the thread of the nut, -45 to 45 degrees: rectangles r0 < r < r1 that
// move along a helix of the pitch p. Their common side is the helicoid z = p * angle / (2 pi).
DefineConstant[ p = {6}, r0 = {6}, r1 = {10}, t = {2.5}, nr = {4}, nt = {3}, ns = {22}, nn = {8}, order = {1} ];
// Rectangle at the angle a [degrees] from z1 to z2 beside the helicoid, swept by s degrees in n layers: numbers from b.
Macro Thread
  c = Cos(a * Pi / 180); q = Sin(a * Pi / 180); h = p * a / 360;
  Point(b + 1) = {r0 * c, r0 * q, h + z1}; Point(b + 2) = {r1 * c, r1 * q, h + z1};
  Point(b + 3) = {r1 * c, r1 * q, h + z2}; Point(b + 4) = {r0 * c, r0 * q, h + z2};
  Line(b + 1) = {b + 1, b + 2}; Line(b + 2) = {b + 2, b + 3}; Line(b + 3) = {b + 3, b + 4}; Line(b + 4) = {b + 4, b + 1};
  Transfinite Curve{b + 1, b + 3} = mr + 1; Transfinite Curve{b + 2, b + 4} = nt + 1;
  Curve Loop(b) = {b + 1, b + 2, b + 3, b + 4}; Plane Surface(b) = {b}; Transfinite Surface{b}; Recombine Surface{b};
  below() = {}; outside() = {}; above() = {}; inside() = {}; volumes() = {}; face = b;
  For k In {1:2}
    new() = Extrude{ {0, 0, p * s / 720}, {0, 0, 1}, {0, 0, 0}, s * Pi / 360 } { Surface{face}; Layers{n / 2}; Recombine; };
    face = new(0); volumes() += new(1); below() += new(2); outside() += new(3); above() += new(4); inside() += new(5);
  EndFor
Return
b = 100; a = -150; s = 220; z1 = -t; z2 = 0; mr = nr; n = 2 * ns; Call Thread;
Physical Volume("screw") = volumes(); Physical Surface("flank") = above(); Physical Surface("core") = inside();
b = 1000; a = -45; s = 90; z1 = 0; z2 = t; mr = nr + 1; n = 2 * nn; Call Thread;
Physical Volume("nut") = volumes(); Physical Surface("seat") = below(); Physical Surface("rim") = outside();
Mesh.ElementOrder = order;
