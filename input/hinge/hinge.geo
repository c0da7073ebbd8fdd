DefineConstant[ np = {45}, nl = {50}, m = {10}, r0 = {3}, r = {10}, c = {0.1}, r1 = {22}, g = {0.87} ];
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
    Transfinite Curve{b + 20 + k} = m + 1 Using Progression gg;
  EndFor
  For k In {0:3}
    Curve Loop(b + k) = {b + 20 + k, b + 10 + k, -(b + 20 + (k + 1) % 4), -(b + k)};
    Plane Surface(b + k) = {b + k};
    Transfinite Surface{b + k}; Recombine Surface{b + k};
  EndFor
Return
b = 100; ra = r0; rb = r; n = np; gg = g; Call Ring;
b = 200; ra = r + c; rb = r1; n = nl; gg = 1 / g; Call Ring;
Physical Surface("pin") = {100:103}; Physical Surface("lug") = {200:203};
Physical Curve("shaft") = {100:103}; Physical Curve("journal") = {110:113}; Physical Curve("bore") = {200:203}; Physical Curve("housing") = {210:213};
