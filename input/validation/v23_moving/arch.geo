// Two voussoirs, quarters of a ring of radii 9 and 11 about (0, 0), on two abutments.
DefineConstant[ n = {12}, m = {24} ];
Point(1) = {0, 0, 0};
Macro Quarter  // from the angle a, numbers from b
  For k In {0:1}
    Point(b + 10 * k) = {9 * Cos(a + k * Pi / 2), 9 * Sin(a + k * Pi / 2), 0};
    Point(b + 10 * k + 1) = {11 * Cos(a + k * Pi / 2), 11 * Sin(a + k * Pi / 2), 0};
    Line(b + 10 * k) = {b + 10 * k, b + 10 * k + 1};
    Transfinite Curve{b + 10 * k} = n + 1;
  EndFor
  Circle(b + 20) = {b, 1, b + 10}; Circle(b + 21) = {b + 1, 1, b + 11};
  Transfinite Curve{b + 20, b + 21} = m + 1;
  Curve Loop(b) = {b, b + 21, -(b + 10), -(b + 20)};
  Plane Surface(b) = {b}; Transfinite Surface{b}; Recombine Surface{b};
Return
b = 100; a = Pi / 2; Call Quarter;
b = 200; a = 0; Call Quarter;
Macro Abutment  // below x1 .. x2
  Point(b) = {x1, -1.5, 0}; Point(b + 1) = {x2, -1.5, 0}; Point(b + 2) = {x2, 0, 0}; Point(b + 3) = {x1, 0, 0};
  Line(b) = {b, b + 1}; Line(b + 1) = {b + 1, b + 2}; Line(b + 2) = {b + 2, b + 3}; Line(b + 3) = {b + 3, b};
  Transfinite Curve{b, b + 2} = 21; Transfinite Curve{b + 1, b + 3} = 9;
  Curve Loop(b) = {b : b + 3}; Plane Surface(b) = {b}; Transfinite Surface{b}; Recombine Surface{b};
Return
b = 300; x1 = -12; x2 = -8; Call Abutment;
b = 400; x1 = 8; x2 = 12; Call Abutment;
Physical Surface("left") = {100}; Physical Surface("right") = {200}; Physical Surface("abutment_left") = {300}; Physical Surface("abutment_right") = {400};
Physical Curve("left_foot") = {110}; Physical Curve("left_crown") = {100}; Physical Curve("right_crown") = {210}; Physical Curve("right_foot") = {200};
Physical Curve("seat_left") = {302}; Physical Curve("seat_right") = {402}; Physical Curve("base_left") = {300}; Physical Curve("base_right") = {400};
