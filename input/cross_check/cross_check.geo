// Tunnel in the middle of a rectangle, crossed by a vertical fault: the scene used for comparing codes. Units: m.
//
//      +--------- + ---------+      Two bodies that share no nodes. Contact sides: fault_upper_left / _right above the tunnel,
//      |          |          |      fault_lower_left / _right below it. Other sides: left_side, right_side, top, bottom,
//      |  left   ( )  right  |      tunnel_wall.
//      |          |          |
//      +--------- + ---------+      scale = 1: about 10k unknowns; 0.313: about 100k.
DefineConstant[ W = {100}, H = {60}, R = {5}, xc = {50}, yc = {30}, hf = {0.62}, ho = {1.57}, dist = {20}, scale = {1} ];

For k In {0:1}
  x0 = k * W;
  side = 2*k - 1;  // -1: left body, +1: right body
  p = newp;
  Point(p) = {xc, yc, 0};
  Point(p + 1) = {xc, yc + R, 0}; Point(p + 2) = {xc, H, 0}; Point(p + 3) = {x0, H, 0};
  Point(p + 4) = {x0, 0, 0}; Point(p + 5) = {xc, 0, 0}; Point(p + 6) = {xc, yc - R, 0}; Point(p + 7) = {xc + side*R, yc, 0};
  l = newl;  // the fault lines of both bodies start at the tunnel, so that they are divided equally
  Line(l) = {p + 1, p + 2}; Line(l + 1) = {p + 2, p + 3}; Line(l + 2) = {p + 3, p + 4}; Line(l + 3) = {p + 4, p + 5};
  Line(l + 4) = {p + 6, p + 5};
  Circle(l + 5) = {p + 6, p, p + 7}; Circle(l + 6) = {p + 7, p, p + 1};
  ll = newll; Curve Loop(ll) = {l, l + 1, l + 2, l + 3, -(l + 4), l + 5, l + 6};
  s = news; Plane Surface(s) = {ll};
  If (k == 0)
    left = s; ls = l;
  Else
    right = s; rs = l;
  EndIf
EndFor

Field[1] = MathEval;  // scale*hf on the fault and the tunnel, growing linearly to scale*ho at distance `dist`
Field[1].F = Sprintf("%g*Min(%g+(%g)*Min(1,Min(Abs(x-(%g)),Abs(Sqrt((x-(%g))^2+(y-(%g))^2)-%g))/%g),%g)",
   scale, hf, ho-hf, xc, xc, yc, R, dist, ho);
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0; Mesh.Algorithm = 6;

Physical Surface("left") = {left};
Physical Surface("right") = {right};
Physical Curve("left_side") = {ls + 2};
Physical Curve("right_side") = {rs + 2};
Physical Curve("top") = {ls + 1, rs + 1};
Physical Curve("bottom") = {ls + 3, rs + 3};
Physical Curve("tunnel_wall") = {ls + 5, ls + 6, rs + 5, rs + 6};
Physical Curve("fault_upper_left") = {ls};
Physical Curve("fault_upper_right") = {rs};
Physical Curve("fault_lower_left") = {ls + 4};
Physical Curve("fault_lower_right") = {rs + 4};
