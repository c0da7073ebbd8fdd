// Tunnel crossed by an inclined fault: input/tunnel in 3D. Lengths in m; x across the tunnel, y along it, z upwards.
//
//      +-------- \ ------------+  z = H      The section y = const is that of input/tunnel: a tunnel of radius R around (xc, zc), a fault
//      |          \            |             inclined by `tilt` degrees that meets the tunnel axis at y = D / 2. Seen from
//      |  left     ( )  right  |             above it is at `strike` degrees to the axis of the tunnel: with 0 the scene is the 2D one,
//      |             \         |             extruded, and the fault has two pieces; otherwise it is one piece with an elliptic hole.
//      +------------- \ -------+  z = 0
//     x = 0                  x = W           0 < y < D
//
// Bodies: left, right. Sides: fault_left, fault_right; left_side, right_side; of each body top_, bottom_, front_ (y = 0), back_ (y = D),
// wall_ (of the tunnel). The bodies are never fragmented with each other; both have the same mesh on the fault. Elements of `hf` at the
// fault around the tunnel, growing to `ho`.
DefineConstant[ W = {120}, H = {80}, D = {60}, R = {6}, xc = {60}, zc = {39.5}, tilt = {-25}, strike = {30}, hf = {2.4}, ho = {14},
  growth = {0.3}, scale = {1}, order = {2} ];
SetFactory("OpenCASCADE");
t = Tan(tilt*Pi/180); u = Tan(strike*Pi/180);
e = 1e-3; far = 1e4;

For k In {0:1}  // 0: left, 1: right
  x0 = k*W;
  p = newp;
  For j In {0:1}  // the quadrilateral at y = 0, that at y = D
    y = j*D; c = xc + u*(y - D/2);
    Point(p + 4*j) = {x0, y, 0}; Point(p + 4*j + 1) = {c - zc*t, y, 0}; Point(p + 4*j + 2) = {c + (H - zc)*t, y, H}; Point(p + 4*j + 3) = {x0, y, H};
  EndFor
  l = newl;
  For j In {0:3}
    Line(l + j) = {p + j, p + (j + 1) % 4}; Line(l + 4 + j) = {p + 4 + j, p + 4 + (j + 1) % 4}; Line(l + 8 + j) = {p + j, p + 4 + j};
  EndFor
  c = newll; f = news;
  Curve Loop(c) = {l:l+3}; Plane Surface(f) = {c};
  Curve Loop(c + 1) = {l+4:l+7}; Plane Surface(f + 1) = {c + 1};
  For j In {0:3}
    Curve Loop(c + 2 + j) = {l + j, l + 8 + (j + 1) % 4, -(l + 4 + j), -(l + 8 + j)}; Plane Surface(f + 2 + j) = {c + 2 + j};
  EndFor
  Surface Loop(k + 100) = {f:f+5};
  v = newv; Volume(v) = {k + 100};
  Cylinder(v + 1) = {xc, 0, zc, 0, D, 0, R};
  body~{k}() = BooleanDifference{ Volume{v}; Delete; }{ Volume{v + 1}; Delete; };
EndFor

// Faces of a body within a box; the faces that remain at the end are the fault.
Macro Side
  found() = rest~{k}(); others() = rest~{k}();
  others() -= {Surface In BoundingBox {x0 - e, y0 - e, z0 - e, x1 + e, y1 + e, z1 + e}};
  found() -= {others()};
  rest~{k}() = {others()};
  Physical Surface(StrCat(name, "")) = {found()};
Return
name_0 = "left"; name_1 = "right";
For k In {0:1}
  Physical Volume(StrCat(name~{k}, "")) = {body~{k}()};
  rest~{k}() = Abs(Boundary{ Volume{body~{k}()}; });
  y0 = -far; y1 = far; z0 = -far; z1 = far;
  name = StrCat(name~{k}, "_side"); x0 = k*W; x1 = x0; Call Side;
  x0 = -far; x1 = far;
  name = StrCat("front_", name~{k}); y0 = 0; y1 = 0; Call Side;
  name = StrCat("back_", name~{k}); y0 = D; y1 = D; Call Side;
  y0 = -far; y1 = far;
  name = StrCat("bottom_", name~{k}); z0 = 0; z1 = 0; Call Side;
  name = StrCat("top_", name~{k}); z0 = H; z1 = H; Call Side;
  x0 = xc - R; x1 = xc + R; z0 = zc - R; z1 = zc + R;
  name = StrCat("wall_", name~{k}); Call Side;
  Physical Surface(StrCat("fault_", name~{k})) = {rest~{k}()};
EndFor

Field[1] = MathEval;
Field[1].F = Sprintf("%g*Min(%g,%g+%g*Abs(Sqrt((x-%g)^2+(z-%g)^2)-%g)+0.15*Abs(x-%g-(%g)*(z-%g)-(%g)*(y-%g)))",
  scale, ho, hf, growth, xc, zc, R, xc, t, zc, u, D/2);
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0; Mesh.Algorithm = 6; Mesh.ElementOrder = order; Mesh.SecondOrderIncomplete = 0;
