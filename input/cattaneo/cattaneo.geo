// Two half-planes, truncated at `size` on all sides, that face each other on |x| < `side`. Elements of size `h` there.
DefineConstant[ size = {2}, side = {0.15}, h = {0.00625} ];
For k In {0:1}  // 0: lower, 1: upper
  s = 2*k - 1; p = 20*k;
  Point(p + 1) = {-size, 0, 0, size/6};   Point(p + 2) = {-side, 0, 0, h};  Point(p + 3) = {side, 0, 0, h};
  Point(p + 4) = {size, 0, 0, size/6};    Point(p + 5) = {size, s*size, 0, size/6};  Point(p + 6) = {-size, s*size, 0, size/6};
  Line(p + 1) = {p + 1, p + 2};  Line(p + 2) = {p + 2, p + 3};  Line(p + 3) = {p + 3, p + 4};
  Line(p + 4) = {p + 4, p + 5};  Line(p + 5) = {p + 5, p + 6};  Line(p + 6) = {p + 6, p + 1};
  Curve Loop(p + 1) = {p + 1, p + 2, p + 3, p + 4, p + 5, p + 6};  Plane Surface(p + 1) = {p + 1};
  Transfinite Curve{p + 2} = Round(2*side/h) + 1;
EndFor
Physical Surface("lower") = {1};         Physical Surface("upper") = {21};
Physical Curve("lower_side") = {2};      Physical Curve("upper_side") = {22};
Physical Curve("lower_bottom") = {5};    Physical Curve("upper_top") = {25};
