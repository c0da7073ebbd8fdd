// Two concentric rings, r0 < r < r1 + d and r1 < r < r2: drawn with the interference d.
DefineConstant[ r0 = {1}, r1 = {2}, r2 = {4}, d = {0.002}, n = {10}, m = {6} ];
Point(1) = {0, 0, 0};
Macro Ring
  For k In {0:3}
    Point(b + k) = {ra * Cos(k * Pi / 2), ra * Sin(k * Pi / 2), 0};
    Point(b + 10 + k) = {rb * Cos(k * Pi / 2), rb * Sin(k * Pi / 2), 0};
  EndFor
  For k In {0:3}
    Circle(b + k) = {b + k, 1, b + (k + 1) % 4};
    Circle(b + 10 + k) = {b + 10 + k, 1, b + 10 + (k + 1) % 4};
    Line(b + 20 + k) = {b + k, b + 10 + k};
    Transfinite Curve{b + k, b + 10 + k} = n + 1;
    Transfinite Curve{b + 20 + k} = m + 1;
  EndFor
  For k In {0:3}
    Curve Loop(b + k) = {b + 20 + k, b + 10 + k, -(b + 20 + (k + 1) % 4), -(b + k)};
    Plane Surface(b + k) = {b + k};
    Transfinite Surface{b + k}; Recombine Surface{b + k};
  EndFor
Return
b = 100; ra = r0; rb = r1 + d; Call Ring;
b = 200; ra = r1; rb = r2; n = n + 3; Call Ring;
Mesh.ElementOrder = 2;
Physical Surface("bush") = {100:103}; Physical Surface("plate") = {200:203};
Physical Curve("bore") = {100:103}; Physical Curve("seat") = {110:113}; Physical Curve("hole") = {200:203}; Physical Curve("edge") = {210:213};
