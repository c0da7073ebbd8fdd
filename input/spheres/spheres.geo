// Two spheres of radii R1 (above) and R2 (below) that touch at the origin: the quarter x >= 0, y >= 0 of the halves that face each other.
//
//        +-------+ upper_top        sides: upper_contact, lower_contact  caps r < reach * a around the origin
//        | upper/                          upper_flank, lower_flank      the rest of the spheres
//        |    _/                           upper_top, lower_bottom       z = R1 and z = -R2
//      0 +--'                              upper_x, lower_x, upper_y, lower_y  symmetry planes x = 0 and y = 0
//        |--._
//        | lower\                   h = a / resolution on the upper cap, times 1 / ratio on the lower one, growing by `growth` with
//        +-------+ lower_bottom     distance from the caps; a: contact radius by Hertz' theory. No node is shared.
//
DefineConstant[ R1 = {50}, R2 = {50}, a = {10}, resolution = {6}, ratio = {1.5}, reach = {1.4}, growth = {0.3}, hmax = {0.25}, order = {2} ];
e = reach * a; h = a / resolution;

For k In {0:1}  // 0: upper, 1: lower
  s = 1 - 2*k; R = k == 0 ? R1 : R2;
  d = s * (R - Sqrt(R*R - e*e));
  p = newp;
  Point(p) = {0, 0, s*R}; Point(p+1) = {0, 0, 0}; Point(p+2) = {e, 0, d}; Point(p+3) = {0, e, d};
  Point(p+4) = {R, 0, s*R}; Point(p+5) = {0, R, s*R}; Point(p+6) = {0, 0, d};
  l = newl;
  Circle(l) = {p+1, p, p+2}; Circle(l+1) = {p+2, p+6, p+3}; Circle(l+2) = {p+3, p, p+1};    // the cap
  Circle(l+3) = {p+2, p, p+4}; Circle(l+4) = {p+4, p, p+5}; Circle(l+5) = {p+5, p, p+3};    // the flank
  Line(l+6) = {p+4, p}; Line(l+7) = {p, p+5}; Line(l+8) = {p+1, p};
  f = 10*k;
  Curve Loop(f+1) = {l+1, l+2, l}; Surface(f+1) = {f+1} In Sphere {p};
  Curve Loop(f+2) = {l+3, l+4, l+5, -(l+1)}; Surface(f+2) = {f+2} In Sphere {p};
  Curve Loop(f+3) = {l+6, l+7, -(l+4)}; Plane Surface(f+3) = {f+3};
  Curve Loop(f+4) = {l+8, l+7, l+5, l+2}; Plane Surface(f+4) = {f+4};
  Curve Loop(f+5) = {l, l+3, l+6, -(l+8)}; Plane Surface(f+5) = {f+5};
  Surface Loop(k+1) = {f+1:f+5}; Volume(k+1) = {k+1};
EndFor

For k In {0:1}  // each sphere has its own half-space
  s = 1 - 2*k; R = k == 0 ? R1 : R2;
  Field[k+1] = MathEval;
  Field[k+1].F = Sprintf("1e6*Max(0,(%g)*z)+Min(%g,%g+%g*Sqrt(Max(0,Sqrt(x*x+y*y)-%g)^2+(%g-Sqrt(x*x+y*y+(z-(%g))^2))^2))",
    -s, hmax * R, k == 0 ? h : h / ratio, growth, e, R, s*R);
EndFor
Field[3] = Min; Field[3].FieldsList = {1, 2};
Background Field = 3;
Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0; Mesh.Algorithm = 6; Mesh.ElementOrder = order; Mesh.SecondOrderIncomplete = 0;

Physical Volume("upper") = {1};              Physical Volume("lower") = {2};
Physical Surface("upper_contact") = {1};     Physical Surface("lower_contact") = {11};
Physical Surface("upper_flank") = {2};       Physical Surface("lower_flank") = {12};
Physical Surface("upper_top") = {3};         Physical Surface("lower_bottom") = {13};
Physical Surface("upper_x") = {4};           Physical Surface("lower_x") = {14};
Physical Surface("upper_y") = {5};           Physical Surface("lower_y") = {15};
