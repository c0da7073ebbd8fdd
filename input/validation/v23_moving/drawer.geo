// A drawer 100 long and 60 wide between two rails, with a clearance of 0.1 on each side.
DefineConstant[ L = {100}, w = {60}, c = {0.1}, n = {40} ];
Macro Part
  Point(b) = {x1, y1, 0}; Point(b + 1) = {x2, y1, 0}; Point(b + 2) = {x2, y2, 0}; Point(b + 3) = {x1, y2, 0};
  Line(b) = {b, b + 1}; Line(b + 1) = {b + 1, b + 2}; Line(b + 2) = {b + 2, b + 3}; Line(b + 3) = {b + 3, b};
  Transfinite Curve{b, b + 2} = nx + 1; Transfinite Curve{b + 1, b + 3} = ny + 1;
  Curve Loop(b) = {b : b + 3}; Plane Surface(b) = {b}; Transfinite Surface{b}; Recombine Surface{b};
Return
b = 100; x1 = 0; x2 = L; y1 = -w / 2; y2 = w / 2; nx = n; ny = n / 2; Call Part;
b = 200; x1 = -20; x2 = L + 60; y1 = w / 2 + c; y2 = w / 2 + c + 15; nx = 2 * n; ny = 6; Call Part;
b = 300; y1 = -w / 2 - c - 15; y2 = -w / 2 - c; Call Part;
Physical Surface("drawer") = {100}; Physical Surface("rail_above") = {200}; Physical Surface("rail_below") = {300};
Physical Curve("top") = {102}; Physical Curve("bottom") = {100}; Physical Curve("front") = {101}; Physical Curve("rear") = {103};
Physical Curve("rail_1") = {200}; Physical Curve("rail_2") = {302}; Physical Curve("held_1") = {202}; Physical Curve("held_2") = {300};
