// Two half-spaces, truncated at radius and depth L = `size` * a, that face each other on the disc r < 1.25 a: the half y >= 0 of two
// cylinders of hexahedra. The scene defines the spheres by its gap; they are not in the mesh.
//
//      a: contact radius by Hertz' theory             sides: upper_side, lower_side     the disc
//      rings: elements along the radius a                    upper_top, lower_bottom    z = L and z = -L
//      around: elements along the half circle                upper_y, lower_y           symmetry plane y = 0
//      growth: growth of elements with distance from the disc
//
DefineConstant[ a = {0.0880442}, size = {20}, rings = {16}, around = {16}, growth = {1.4}, order = {1} ];
L = size * a; q = Round(around / 4);
d = 0.35 * a; radii[] = {0.7 * a, 1.25 * a, L};  // a square of half width d, circles around it, and elements between them
n[] = {Round(0.3 * rings), Round(0.55 * rings), Round(Log(1 + (growth - 1) * (size - 1.25) * rings / growth) / Log(growth))};
layers = Round(Log(1 + (growth - 1) * size * rings) / Log(growth));  // layers over the depth, the first of thickness a / rings
For i In {0:layers-1}
  one[i] = 1; depth[i] = (growth^(i+1) - 1) / (growth^layers - 1);
EndFor

For k In {0:1}  // 0: lower, 1: upper
  s = 2*k - 1; z = k * a / 1000; p = newp;  // a tiny distance between them, so that Gmsh keeps both discs; the scene prescribes the gap
  Point(p) = {0, 0, z};
  Point(p+1) = {d, 0, z}; Point(p+2) = {d, d, z}; Point(p+3) = {-d, d, z}; Point(p+4) = {-d, 0, z};
  For j In {0:2}
    r = radii[j]; t = r / Sqrt(2); m = p + 5 + 4*j;
    Point(m) = {r, 0, z}; Point(m+1) = {t, t, z}; Point(m+2) = {-t, t, z}; Point(m+3) = {-r, 0, z};
  EndFor
  l = newl;  // square
  Line(l) = {p+1, p+2}; Line(l+1) = {p+2, p+3}; Line(l+2) = {p+3, p+4}; Line(l+3) = {p+4, p+1};
  Transfinite Curve{l, l+2} = q + 1; Transfinite Curve{l+1, l+3} = 2*q + 1;
  o = newll; Curve Loop(o) = {l:l+3}; f = news; Plane Surface(f) = {o};
  flat[] = {f};
  For j In {0:2}
    m = p + 5 + 4*j; c = newl;
    Circle(c) = {m, p, m+1}; Circle(c+1) = {m+1, p, m+2}; Circle(c+2) = {m+2, p, m+3};
    Transfinite Curve{c, c+2} = q + 1; Transfinite Curve{c+1} = 2*q + 1;
    For i In {0:3}
      Line(c+3+i) = {m - 4 + i, m + i};
      If (j < 2)
        Transfinite Curve{c+3+i} = n[j] + 1;
      Else
        Transfinite Curve{c+3+i} = n[j] + 1 Using Progression growth;
      EndIf
    EndFor
    For i In {0:2}
      o = newll; Curve Loop(o) = {c+3+i, c+i, -(c+4+i), -(l+i)}; f = news; Plane Surface(f) = {o};
      flat[] += {f};
    EndFor
    l = c;
  EndFor
  Transfinite Surface{flat[]}; Recombine Surface{flat[]};
  body[] = {}; end[] = {}; side[] = {};
  For i In {0:#flat[]-1}
    e[] = Extrude {0, 0, s*L} { Surface{flat[i]}; Layers{one[], depth[]}; Recombine; };
    end[] += {e[0]}; body[] += {e[1]};
    If (i < 7)
      side[] += {flat[i]};
    EndIf
  EndFor
  cut[] = Surface In BoundingBox {-2*L, -a/1e4, k ? a/1e4 : -2*L, 2*L, a/1e4, k ? 2*L : a/1e4};
  If (k == 0)
    Physical Volume("lower") = body[]; Physical Surface("lower_side") = side[];
    Physical Surface("lower_bottom") = end[]; Physical Surface("lower_y") = cut[];
  Else
    Physical Volume("upper") = body[]; Physical Surface("upper_side") = side[];
    Physical Surface("upper_top") = end[]; Physical Surface("upper_y") = cut[];
  EndIf
EndFor
Mesh.ElementOrder = order; Mesh.SecondOrderIncomplete = 0;
