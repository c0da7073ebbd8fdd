// Two blocks [0, 1] x [0, 1] x [0, 1/2] (upper) and x [-1/2, 0] (lower), rotated by `angle` degrees about (ax, ay, az) through the origin,
// then moved by (dx, dy, dz), all lengths times `unit`.
//
//        upper_top                   Sides of each: <body>_left, _right (x), _front, _back (y), _bottom, _top (z) before rotation; contact:
//      +-----------+                 upper_bottom on lower_top. upper_corner: the quarter x < 1/2, y < 1/2 of upper_top. No node is shared.
//     /   upper   /|
//    +-----------+ |                 Each block is four columns with 2 n x 2 n x n elements in all, n = `upper` or `lower`; `skew` moves the
//    |           | +                 inner edges, differently in each block and at its two ends, so that hexahedra are not parallelepipeds.
//    |   lower   |/                  hexahedra = 0: tetrahedra. order = 2 with incomplete = 1: no face nodes (Hexahedron20).
//    +-----------+                   Hexahedra match where upper = lower and skew = 0.
//
// reversed = 1: the bodies are made in reverse order, each from the other corner: everything is renumbered.
DefineConstant[ angle = {0}, ax = {1}, ay = {2}, az = {3}, upper = {2}, lower = {3}, skew = {0.15}, hexahedra = {0}, order = {1}, incomplete = {0},
  dx = {0}, dy = {0}, dz = {0}, unit = {1}, reversed = {0} ];
la = Sqrt(ax*ax + ay*ay + az*az); n1 = ax/la; n2 = ay/la; n3 = az/la;
c = Cos(angle*Pi/180); s = Sin(angle*Pi/180); w = 1 - c;

For k In {0:1}  // 0: lower, 1: upper
  n = k == 0 ? lower : upper;
  p = 100 * (reversed == 1 ? 1 - k : k);  // point at position (a, b) of end j: p + 9 j + 3 b + a
  For j In {0:1}
    g = skew * (1 - 2*j) * (1 - 0.6*k);
    For b In {0:2}
      For a In {0:2}
        i = reversed == 1 ? 2 - a : a; l = reversed == 1 ? 2 - b : b;
        x = unit * (0.5*i + (i == 1 ? g * (1 - 0.5*l) : 0)); y = unit * (0.5*l - (l == 1 ? g * (1.2 - 0.8*i) : 0)); z = unit * 0.5*(k - 1 + j);
        Point(p + 9*j + 3*b + a) = {unit*dx + (c + w*n1*n1)*x + (w*n1*n2 - s*n3)*y + (w*n1*n3 + s*n2)*z,
          unit*dy + (w*n1*n2 + s*n3)*x + (c + w*n2*n2)*y + (w*n2*n3 - s*n1)*z, unit*dz + (w*n1*n3 - s*n2)*x + (w*n2*n3 + s*n1)*y + (c + w*n3*n3)*z};
      EndFor
    EndFor
  EndFor
  // Lines: along x p + 10 j + 2 b + a (a = 0, 1), along y p + 20 + 10 j + 3 b + a (b = 0, 1), upright p + 40 + 3 b + a.
  For j In {0:1}
    For b In {0:2}
      For a In {0:1}
        Line(p + 10*j + 2*b + a + 1) = {p + 9*j + 3*b + a, p + 9*j + 3*b + a + 1};
        Line(p + 20 + 10*j + 3*a + b + 1) = {p + 9*j + 3*a + b, p + 9*j + 3*(a + 1) + b};
      EndFor
    EndFor
  EndFor
  For b In {0:8}
    Line(p + 40 + b + 1) = {p + b, p + 9 + b};
  EndFor
  // Faces: of the ends p + 10 j + 2 b + a, across y p + 20 + 2 b + a (b = 0 .. 2), across x p + 30 + 3 b + a (a = 0 .. 2).
  For b In {0:1}
    For a In {0:1}
      For j In {0:1}
        Curve Loop(p + 10*j + 2*b + a + 1) = {p + 10*j + 2*b + a + 1, p + 20 + 10*j + 3*b + a + 2, -(p + 10*j + 2*(b + 1) + a + 1), -(p + 20 + 10*j + 3*b + a + 1)};
        Surface(p + 10*j + 2*b + a + 1) = {p + 10*j + 2*b + a + 1};
      EndFor
    EndFor
  EndFor
  For b In {0:2}
    For a In {0:1}
      Curve Loop(p + 20 + 2*b + a + 1) = {p + 2*b + a + 1, p + 40 + 3*b + a + 2, -(p + 10 + 2*b + a + 1), -(p + 40 + 3*b + a + 1)};
      Surface(p + 20 + 2*b + a + 1) = {p + 20 + 2*b + a + 1};
      Curve Loop(p + 30 + 3*a + b + 1) = {p + 20 + 3*a + b + 1, p + 40 + 3*(a + 1) + b + 1, -(p + 30 + 3*a + b + 1), -(p + 40 + 3*a + b + 1)};
      Surface(p + 30 + 3*a + b + 1) = {p + 30 + 3*a + b + 1};
    EndFor
  EndFor
  For b In {0:1}
    For a In {0:1}
      v = p + 2*b + a + 1;
      Surface Loop(v) = {v, v + 10, p + 20 + 2*b + a + 1, p + 20 + 2*(b + 1) + a + 1, p + 30 + 3*b + a + 1, p + 30 + 3*b + a + 2};
      Volume(v) = {v};
    EndFor
  EndFor
  Transfinite Curve{p + 1:p + 6, p + 11:p + 16, p + 21:p + 26, p + 31:p + 36, p + 41:p + 49} = n + 1;
  If (hexahedra == 1)
    Transfinite Surface{p + 1:p + 4, p + 11:p + 14, p + 21:p + 26, p + 31:p + 36};
    Recombine Surface{p + 1:p + 4, p + 11:p + 14, p + 21:p + 26, p + 31:p + 36};
    Transfinite Volume{p + 1:p + 4};
  EndIf
EndFor
Mesh.ElementOrder = order; Mesh.SecondOrderIncomplete = incomplete; Mesh.SecondOrderLinear = 1; Mesh.MeshSizeFromPoints = 0; Mesh.Algorithm = 6;

L = reversed == 1 ? 100 : 0; U = 100 - L;  // tags of the bodies
left = reversed == 1 ? 33 : 31; right = 64 - left; front = reversed == 1 ? 25 : 21; back = 46 - front;
Physical Volume("lower") = {L+1:L+4};                          Physical Volume("upper") = {U+1:U+4};
Physical Surface("lower_bottom") = {L+1:L+4};                  Physical Surface("upper_bottom") = {U+1:U+4};
Physical Surface("lower_top") = {L+11:L+14};                   Physical Surface("upper_top") = {U+11:U+14};
Physical Surface("lower_front") = {L+front, L+front+1};        Physical Surface("upper_front") = {U+front, U+front+1};
Physical Surface("lower_back") = {L+back, L+back+1};           Physical Surface("upper_back") = {U+back, U+back+1};
Physical Surface("lower_left") = {L+left, L+left+3};           Physical Surface("upper_left") = {U+left, U+left+3};
Physical Surface("lower_right") = {L+right, L+right+3};        Physical Surface("upper_right") = {U+right, U+right+3};
Physical Surface("upper_corner") = {reversed == 1 ? U+14 : U+11};
