// Two spur gears with involute flanks, as sectors of `teeth` teeth; gear 1 about (0, 0), gear 2 about the centre distance on the x axis.
// 18 to 41 teeth: the involute begins on the base circle, above the root. `flank`: intervals of the spline through points of the involute;
// with 8 its normals are wrong by up to 0.01 rad, with 48 by 3e-4.
DefineConstant[ z1 = {30}, z2 = {30}, m = {2}, teeth = {5}, fine = {0.25}, coarse = {2}, order = {2}, flank = {48} ];
alpha = 20 * Pi / 180;
Macro Gear  // `z` teeth, centre (cx, 0), first tooth at the angle a0, numbers from b
  rp = m * z / 2; rb = rp * Cos(alpha); ra = rp + m; rf = rp - 1.25 * m; rh = 0.6 * rp;
  psi = Pi / (2 * z) + Tan(alpha) - alpha;  // angle between the middle of a tooth and the start of its involute
  tmax = Sqrt((ra / rb)^2 - 1);
  outline() = {}; driving() = {};
  c = b; Point(c) = {cx, 0, 0, coarse};
  For k In {0:teeth-1}
    a = a0 + (k - (teeth - 1) / 2) * 2 * Pi / z; q = b + 1000 * (k + 1);
    For s In {0:1}  // flanks: at the lower and the upper angle
      sg = 2 * s - 1; p = q + 400 * s;
      For i In {0:flank}
        t = tmax * i / flank; r = rb * Sqrt(1 + t * t); f = a + sg * (psi - (t - Atan(t)));
        Point(p + i) = {cx + r * Cos(f), r * Sin(f), 0, fine};
      EndFor
      Point(p + 399) = {cx + rf * Cos(a + sg * psi), rf * Sin(a + sg * psi), 0, 2 * fine};
      Spline(p) = {p : p + flank};
      Line(p + 1) = {p + 399, p};
    EndFor
    Circle(q + 50) = {q + flank, c, q + 400 + flank};  // tip
    If (k > 0)
      Circle(q + 51) = {q - 201, c, q + 399};
      outline() += {q + 51};
    EndIf
    outline() += {q + 1, q, q + 50, -(q + 400), -(q + 401)};
    driving() += {q + 400};
  EndFor
  // hub
  a1 = a0 - (teeth - 1) / 2 * 2 * Pi / z - Pi / z; a2 = a0 + (teeth - 1) / 2 * 2 * Pi / z + Pi / z;
  Point(b + 1) = {cx + rf * Cos(a1), rf * Sin(a1), 0, 4 * fine}; Point(b + 2) = {cx + rf * Cos(a2), rf * Sin(a2), 0, 4 * fine};
  Point(b + 3) = {cx + rh * Cos(a1), rh * Sin(a1), 0, coarse}; Point(b + 4) = {cx + rh * Cos(a2), rh * Sin(a2), 0, coarse};
  Circle(b + 1) = {b + 1, c, b + 1399}; Circle(b + 2) = {b + 1000 * teeth + 799, c, b + 2};
  Line(b + 3) = {b + 2, b + 4}; Circle(b + 4) = {b + 4, c, b + 3}; Line(b + 5) = {b + 3, b + 1};
  Curve Loop(b) = {b + 1, outline(), b + 2, b + 3, b + 4, b + 5};
  Plane Surface(b) = {b};
Return
z = z1; b = 100000; cx = 0; a0 = 0; Call Gear;
d1() = driving();
z = z2; b = 300000; cx = m * (z1 + z2) / 2; a0 = Pi + Pi / z; Call Gear;
d2() = driving();
Mesh.ElementOrder = order;
Physical Surface("driver") = {100000}; Physical Surface("wheel") = {300000};
Physical Curve("flanks_1") = {d1()}; Physical Curve("flanks_2") = {d2()};
Physical Curve("hub_1") = {100003, 100004, 100005}; Physical Curve("hub_2") = {300003, 300004, 300005};
