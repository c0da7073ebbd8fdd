// A shaft between three pairs of plates, above and below it. Second-order triangles, nodes of the sides do not match.
Mesh.ElementOrder = 2;
R = 0.1; h = 0.05;
x() = {0.05, 0.25, 0.35, 0.65, 0.75, 0.95};
clearance() = {0.001, 0.003, 0.0015};
lower = newp; Point(lower) = {0, -R, 0, h};
For i In {0:5}
  Point(lower + 1 + i) = {x(i), -R, 0, h};
EndFor
Point(lower + 7) = {1, -R, 0, h};
upper = newp; Point(upper) = {1, R, 0, h};
For i In {0:5}
  Point(upper + 1 + i) = {x(5 - i), R, 0, h};
EndFor
Point(upper + 7) = {0, R, 0, h};
edge = newl;
For i In {0:14}
  Line(edge + i) = {lower + i, lower + i + 1};
EndFor
Line(edge + 15) = {lower + 15, lower};
Curve Loop(1) = {edge:edge + 15};
Plane Surface(1) = {1};
Physical Surface("shaft") = {1};
Physical Curve("shaft right") = {edge + 7};
Physical Curve("shaft left") = {edge + 15};
For i In {0:2}
  Physical Curve(Sprintf("seat %g below", i + 1)) = {edge + 1 + 2 * i};
  Physical Curve(Sprintf("seat %g above", i + 1)) = {edge + 13 - 2 * i};
  For side In {0:1}
    s = 2 * side - 1;
    p = newp;
    Point(p) = {x(2 * i), s * (R + clearance(i)), 0, 0.06};
    Point(p + 1) = {x(2 * i + 1), s * (R + clearance(i)), 0, 0.06};
    Point(p + 2) = {x(2 * i + 1), s * (R + 0.3), 0, 0.06};
    Point(p + 3) = {x(2 * i), s * (R + 0.3), 0, 0.06};
    l = newl;
    Line(l) = {p, p + 1}; Line(l + 1) = {p + 1, p + 2}; Line(l + 2) = {p + 2, p + 3}; Line(l + 3) = {p + 3, p};
    c = newll; Curve Loop(c) = {l:l + 3};
    f = news; Plane Surface(f) = {c};
    If (side == 0)
      Physical Surface(Sprintf("plate %g below", i + 1)) = {f};
      Physical Curve(Sprintf("face %g below", i + 1)) = {l};
      Physical Curve(Sprintf("held %g below", i + 1)) = {l + 2};
    Else
      Physical Surface(Sprintf("plate %g above", i + 1)) = {f};
      Physical Curve(Sprintf("face %g above", i + 1)) = {l};
      Physical Curve(Sprintf("held %g above", i + 1)) = {l + 2};
    EndIf
  EndFor
EndFor
