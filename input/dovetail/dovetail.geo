// A blade root in the slot of a disc: one sector, pulled along y, the radius. Lengths in mm; h: element size.
//
//              | blade |                y = 30: pull
//              |       |
//       rim ___|       |___             contact on the flanks only, with the rounded ends: root_left on slot_left, root_right on slot_right.
//          / \ |       | / \            The sides lie on two radii of the disc, centre (0, -R), half_angle degrees from y.
//         /   \         /   \           The flanks are inclined by `flank` degrees from y.
//        /   /   root    \   \          .
DefineConstant[ h = {1, Name "size"}, flank = {45}, half_angle = {7.5}, R = {200} ];
SetFactory("OpenCASCADE");
fine = h / 6;  // along the flanks
f = flank * Pi / 180; s = Sin(f); c = Cos(f); e = Tan(f / 2);  // a fillet of radius r begins r e before the corner
g = half_angle * Pi / 180;

// Corners have fillets; the flank is the line through (10, 0) along (s, -c).
rn = 3; yn = 3 * c / s;        // root: neck x = 7, corner with the flank at y = yn
rb = 2; yb = -5 * c / s;       // root: side x = 15, corner with the flank at y = yb
rl = 1.5; yl = 1.5 * c / s;    // slot: lip x = 8.5
rs = 3; ys = -7 * c / s;       // slot: side x = 17
yr = yb - 4; yf = ys - rs * e - 3;  // lower end of the root, floor of the slot
top = yl + rl * e + 2;         // rim
For k In {0:1}
  m = 2 * k - 1;  // -1: left, 1: right
  p = 100 * (k + 1);
  Point(p + 1) = {7*m, 30, 0, 2*h};                       Point(p + 2) = {7*m, yn + rn*e, 0, h/2};
  Point(p + 3) = {(7 + rn)*m, yn + rn*e, 0};              Point(p + 4) = {(7 + rn*e*s)*m, yn - rn*e*c, 0, fine};
  Point(p + 5) = {(15 - rb*e*s)*m, yb + rb*e*c, 0, fine}; Point(p + 6) = {(15 - rb)*m, yb - rb*e, 0};
  Point(p + 7) = {15*m, yb - rb*e, 0, h/2};               Point(p + 8) = {15*m, yr, 0, h};
  Line(p + 1) = {p + 1, p + 2}; Circle(p + 2) = {p + 2, p + 3, p + 4}; Line(p + 3) = {p + 4, p + 5};
  Circle(p + 4) = {p + 5, p + 6, p + 7}; Line(p + 5) = {p + 7, p + 8};

  Point(p + 21) = {8.5*m, top, 0, h};                     Point(p + 22) = {8.5*m, yl + rl*e, 0, h/2};
  Point(p + 23) = {(8.5 + rl)*m, yl + rl*e, 0};           Point(p + 24) = {(8.5 + rl*e*s)*m, yl - rl*e*c, 0, fine};
  Point(p + 25) = {(17 - rs*e*s)*m, ys + rs*e*c, 0, fine};Point(p + 26) = {(17 - rs)*m, ys - rs*e, 0};
  Point(p + 27) = {17*m, ys - rs*e, 0, h/2};              Point(p + 28) = {17*m, yf + 2, 0, h};
  Point(p + 29) = {15*m, yf + 2, 0};                      Point(p + 30) = {15*m, yf, 0, h};
  Point(p + 31) = {(R + top)*Tan(g)*m, top, 0, 2*h};      Point(p + 32) = {(R - 60)*Tan(g)*m, -60, 0, 3*h};
  Line(p + 20) = {p + 31, p + 21};
  Line(p + 21) = {p + 21, p + 22}; Circle(p + 22) = {p + 22, p + 23, p + 24}; Line(p + 23) = {p + 24, p + 25};
  Circle(p + 24) = {p + 25, p + 26, p + 27}; Line(p + 25) = {p + 27, p + 28}; Circle(p + 26) = {p + 28, p + 29, p + 30};
  Line(p + 27) = {p + 32, p + 31};
EndFor
Line(1) = {101, 201}; Line(2) = {108, 208}; Line(3) = {130, 230}; Line(4) = {132, 232};
Curve Loop(1) = {101:105, 2, -205, -204, -203, -202, -201, -1}; Plane Surface(1) = {1};
Curve Loop(2) = {120:126, 3, -226, -225, -224, -223, -222, -221, -220, -227, -4, 127}; Plane Surface(2) = {2};

Physical Surface("blade") = {1};
Physical Surface("disc") = {2};
Physical Curve("blade_top") = {1};
Physical Curve("root_left") = {103, 104};  Physical Curve("slot_left") = {122, 123};
Physical Curve("root_right") = {203, 204}; Physical Curve("slot_right") = {222, 223};
Physical Curve("sector_left") = {127};     Physical Curve("sector_right") = {227};
