// Two spur gears with involute flanks, as sectors of `teeth` teeth; gear 1 about (0, 0), gear 2 about (m z, 0).
DefineConstant[ z = {30}, m = {2}, teeth = {5}, fine = {0.25}, coarse = {2}, order = {2} ];
alpha = 20 * Pi / 180;
rp = m * z / 2; rb = rp * Cos(alpha); ra = rp + m; rf = rp - 1.25 * m; rh = 0.6 * rp;
psi = Pi / (2 * z) + Tan(alpha) - alpha;  // angle between the middle of a tooth and the start of its involute
nf = 8;                                   // intervals of a flank
tmax = Sqrt((ra / rb)^2 - 1);
Macro Gear  // centre (cx, 0), first tooth at the angle a0, numbers from b
  outline() = {}; driving() = {};
  c = b; Point(c) = {cx, 0, 0, coarse};
  For k In {0:teeth-1}
    a = a0 + (k - (teeth - 1) / 2) * 2 * Pi / z; q = b + 100 * (k + 1);
    For s In {0:1}  // flanks: at the lower and the upper angle
      sg = 2 * s - 1;
      For i In {0:nf}
        t = tmax * i / nf; r = rb * Sqrt(1 + t * t); f = a + sg * (psi - (t - Atan(t)));
        Point(q + 20 * s + i) = {cx + r * Cos(f), r * Sin(f), 0, fine};
      EndFor
      Point(q + 20 * s + 15) = {cx + rf * Cos(a + sg * psi), rf * Sin(a + sg * psi), 0, 2 * fine};
      Spline(q + 20 * s) = {q + 20 * s : q + 20 * s + nf};
      Line(q + 20 * s + 1) = {q + 20 * s + 15, q + 20 * s};
    EndFor
    Circle(q + 50) = {q + nf, c, q + 20 + nf};  // tip
    If (k > 0)
      Circle(q + 51) = {q - 65, c, q + 15};
      outline() += {q + 51};
    EndIf
    outline() += {q + 1, q, q + 50, -(q + 20), -(q + 21)};
    driving() += {q + 20 * drive};
  EndFor
  // hub
  a1 = a0 - (teeth - 1) / 2 * 2 * Pi / z - Pi / z; a2 = a0 + (teeth - 1) / 2 * 2 * Pi / z + Pi / z;
  Point(b + 1) = {cx + rf * Cos(a1), rf * Sin(a1), 0, 4 * fine}; Point(b + 2) = {cx + rf * Cos(a2), rf * Sin(a2), 0, 4 * fine};
  Point(b + 3) = {cx + rh * Cos(a1), rh * Sin(a1), 0, coarse}; Point(b + 4) = {cx + rh * Cos(a2), rh * Sin(a2), 0, coarse};
  Circle(b + 1) = {b + 1, c, b + 115}; Circle(b + 2) = {b + 100 * teeth + 35, c, b + 2};
  Line(b + 3) = {b + 2, b + 4}; Circle(b + 4) = {b + 4, c, b + 3}; Line(b + 5) = {b + 3, b + 1};
  Curve Loop(b) = {b + 1, outline(), b + 2, b + 3, b + 4, b + 5};
  Plane Surface(b) = {b};
Return
b = 1000; cx = 0; a0 = 0; drive = 1; Call Gear;
d1() = driving();
b = 3000; cx = 2 * rp; a0 = Pi + Pi / z; drive = 1; Call Gear;
d2() = driving();
Mesh.ElementOrder = order;
Physical Surface("driver") = {1000}; Physical Surface("wheel") = {3000};
Physical Curve("flanks_1") = {d1()}; Physical Curve("flanks_2") = {d2()};
Physical Curve("hub_1") = {1003, 1004, 1005}; Physical Curve("hub_2") = {3003, 3004, 3005};
