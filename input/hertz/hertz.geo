// Elastic cylinder on an elastic plane (Hertz), right half: x = 0 is a symmetry plane. Lengths in units of the scene.
//
//      cylinder_top                The lower right quarter of a disc of radius R around (0, R), and a block of Lx x Ly below y = 0.
//      +-----------+               The disc touches the block at the origin.
//      |          /
//      | cylinder |                Contact sides: x = 0 .. reach * a, with nodes at the same x = 0, h, 2 h, ... on both, so that
//      |         /                 every node of the arc is exactly above one of the plane; h = a / resolution, a the half
//      |       _/                  width by Hertz' theory. Away from the contact the elements grow linearly with
//      |____,-'  cylinder_contact  distance.
//      +--------------------+
//      |     block_contact  |      Sides at x = 0: cylinder_axis, block_axis.
//      |  block             |
//      |                    |
//      +--------------------+ block_bottom
//
// ratio: elements of the block's contact side per element of the cylinder's; nodes match only with 1. order = 2: elements with middle
// nodes, curved sides. block = 0: only the cylinder. quads = 1: quadrilaterals.
DefineConstant[ R = {8}, Lx = {32}, Ly = {32}, a = {0.96277}, resolution = {16}, reach = {1.25}, ratio = {1}, order = {1}, block = {1}, quads = {0},
  growth = {0.12}, hmax = {2} ];
h = a / resolution;
n = Round(reach * resolution);  // elements along the contact sides
xe = n * h;

// The cylinder: its contact side first, node by node.
axis = newp; Point(axis) = {0, R, 0};
c0 = newp;
For i In {0:n}
  Point(c0 + i) = {i*h, R - Sqrt(R*R - i*h*i*h), 0};
EndFor
crest = newp; Point(crest) = {R, R, 0};
ca = newl;
For i In {1:n}
  Circle(ca + i - 1) = {c0 + i - 1, axis, c0 + i};
EndFor
cb = newl; Circle(cb) = {c0 + n, axis, crest};
cc = newl; Line(cc) = {crest, axis};
cd = newl; Line(cd) = {axis, c0};
Curve Loop(1) = {ca:ca+n-1, cb, cc, cd};
Plane Surface(1) = {1};

Transfinite Curve{ca:ca+n-1} = 2;  // one element each

If (block == 1)
  b0 = newp;
  m = Round(n * ratio);  // elements of the block's side
  For i In {0:m}
    Point(b0 + i) = {i*n*h/m, 0, 0};
  EndFor
  b1 = newp; Point(b1) = {Lx, 0, 0}; Point(b1 + 1) = {Lx, -Ly, 0}; Point(b1 + 2) = {0, -Ly, 0};
  ba = newl;
  For i In {1:m}
    Line(ba + i - 1) = {b0 + i - 1, b0 + i};
  EndFor
  bb = newl; Line(bb) = {b0 + m, b1};
  bc = newl; Line(bc) = {b1, b1 + 1};
  bd = newl; Line(bd) = {b1 + 1, b1 + 2};
  be = newl; Line(be) = {b1 + 2, b0};
  Curve Loop(2) = {ba:ba+m-1, bb, bc, bd, be};
  Plane Surface(2) = {2};
  Transfinite Curve{ba:ba+m-1} = 2;
  Physical Surface("block") = {2};
  Physical Curve("block_contact") = {ba:ba+m-1};
  Physical Curve("block_bottom") = {bd};
  Physical Curve("block_axis") = {be};
EndIf

Field[1] = MathEval;
Field[1].F = Sprintf("Min(%g,%g+%g*Max(0,Sqrt(x*x+y*y)-%g))", hmax, h, growth, 1.2*xe);
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0; Mesh.Algorithm = 6; Mesh.ElementOrder = order; Mesh.SecondOrderIncomplete = 0;

If (quads)
  Recombine Surface{1};
  If (block)
    Recombine Surface{2};
  EndIf
EndIf

Physical Surface("cylinder") = {1};
Physical Curve("cylinder_contact") = {ca:ca+n-1};
Physical Curve("cylinder_top") = {cc};
Physical Curve("cylinder_axis") = {cd};
