// A bolt and a nut clamp two rectangular plates: the quarter x >= 0, y >= 0. Lengths in mm; h: element size.
//
//      x = 0
//      | head  |                           hexagons of width `flats`
//      |_______|______________________     z = clamped: upper_seat below head_seat
//      |    |  |                      |
//      |    |  |    upper             | upper_rim
//      |    |  |______________________|    z = clamped / 2: lower_joint below upper_joint
//      |    |  |                      |
//      |    |  |    lower             | lower_rim
//      |____|__|______________________|    z = 0: nut_top below lower_seat
//      |    | |  nut                       the thread is one shoulder: bolt_shoulder below nut_shoulder, z = -nut / 2
//      |    |_|__
//      |      || |
//      |______||_|                         z = -nut. Radii: shank; hole in the plates; bore, thread and counterbore in the nut
//
// Each body has sides <body>_x and <body>_y on the symmetry planes. Bodies share no nodes. Apply the strain of a preload between
// z = -nut / 2 and z = clamped; both planes are element boundaries of the bolt.
DefineConstant[ h = {4, Name "size"}, shank = {5}, hole = {5.5}, bore = {5.2}, thread = {6.6}, counterbore = {6.8}, flats = {18}, head = {7},
  nut = {10}, clamped = {30}, length = {40}, width = {25}, seat = {11}, order = {2} ];
SetFactory("OpenCASCADE");
q = clamped / 2; r3 = Sqrt(3);

For k In {0:1}  // the quarters of two hexagonal prisms: head, nut
  p = newp; z = k == 0 ? clamped : -nut;
  Point(p) = {0, 0, z}; Point(p+1) = {flats/2, 0, z}; Point(p+2) = {flats/2, flats/(2*r3), z}; Point(p+3) = {0, flats/r3, z};
  l = newl; Line(l) = {p, p+1}; Line(l+1) = {p+1, p+2}; Line(l+2) = {p+2, p+3}; Line(l+3) = {p+3, p};
  c = newll; Curve Loop(c) = {l:l+3};
  f = news; Plane Surface(f) = {c};
  prism() = Extrude {0, 0, k == 0 ? head : nut} { Surface{f}; };
  hexagon[k] = prism(1);
EndFor
v = newv;
Cylinder(v) = {0, 0, -nut/2, 0, 0, clamped + nut/2, shank, Pi/2};
Cylinder(v+1) = {0, 0, -nut, 0, 0, nut/2, thread, Pi/2};
body_0() = BooleanFragments{ Volume{hexagon[0]}; Delete; }{ Volume{v, v+1}; Delete; };  // the bolt

v = newv;
Cylinder(v) = {0, 0, -nut/2, 0, 0, nut/2, bore, Pi/2};
Cylinder(v+1) = {0, 0, -nut, 0, 0, nut/2, counterbore, Pi/2};
body_1() = BooleanDifference{ Volume{hexagon[1]}; Delete; }{ Volume{v, v+1}; Delete; };

For k In {0:1}  // the plates: lower, upper; the seat of nut or head is marked
  v = newv;
  Box(v) = {0, 0, k*q, length, width, q};
  Cylinder(v+1) = {0, 0, k*q, 0, 0, q, hole, Pi/2};
  plate() = BooleanDifference{ Volume{v}; Delete; }{ Volume{v+1}; Delete; };
  s = news; Disk(s) = {0, 0, k*clamped, seat};
  parts() = BooleanFragments{ Volume{plate()}; Delete; }{ Surface{s}; Delete; };
  If (k == 0)
    body_2() = {parts(0)};
  Else
    body_3() = {parts(0)};
  EndIf
EndFor
e = 0.01; far = 10 * length;
beyond() = Surface In BoundingBox {-far, -far, -far, far, far, far};  // the discs where there is no plate
beyond() -= {Surface In BoundingBox {-e, -e, -far, far, far, far}};
Recursive Delete{ Surface{beyond()}; }

// Faces of body k within a box up to (x1, y1), from z0 to z1.
Macro Side
  found() = Abs(CombinedBoundary{ Volume{body~{k}()}; });
  others() = found();
  others() -= {Surface In BoundingBox {x0 - e, -e, z0 - e, x1 + e, y1 + e, z1 + e}};
  found() -= {others()};
  Physical Surface(StrCat(name, "")) = {found()};
Return
name_0 = "bolt"; name_1 = "nut"; name_2 = "lower"; name_3 = "upper";
For k In {0:3}
  Physical Volume(StrCat(name~{k}, "")) = {body~{k}()};
  x0 = 0; z0 = -far; z1 = far;
  name = StrCat(name~{k}, "_x"); x1 = 0; y1 = far; Call Side;
  name = StrCat(name~{k}, "_y"); x1 = far; y1 = 0; Call Side;
EndFor
x0 = 0; x1 = far; y1 = far;
k = 0; name = "bolt_shoulder"; z0 = -nut/2; z1 = z0; Call Side;
k = 0; name = "head_seat"; z0 = clamped; z1 = z0; Call Side;
k = 1; name = "nut_shoulder"; z0 = -nut/2; z1 = z0; Call Side;
k = 1; name = "nut_top"; z0 = 0; z1 = 0; Call Side;
k = 2; name = "lower_joint"; z0 = q; z1 = q; Call Side;
k = 3; name = "upper_joint"; Call Side;
x1 = seat; y1 = seat;
k = 2; name = "lower_seat"; z0 = 0; z1 = 0; Call Side;
k = 3; name = "upper_seat"; z0 = clamped; z1 = z0; Call Side;
x0 = length; x1 = length; y1 = far; z0 = -far; z1 = far;
k = 2; name = "lower_rim"; Call Side;
k = 3; name = "upper_rim"; Call Side;

// Elements of h / 2 at the seats, h / 4 about the shank, growing with distance from the axis.
Field[1] = MathEval;
Field[1].F = Sprintf("%g*Min(1.5,0.5+0.1*Max(0,Sqrt(x*x+y*y)-%g)-0.25*Max(0,1-0.5*Abs(Sqrt(x*x+y*y)-%g)))", h, seat, (shank + thread) / 2);
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0; Mesh.Algorithm = 6; Mesh.ElementOrder = order; Mesh.SecondOrderIncomplete = 0;
