// Three discs of radius 0.5: two on a floor 0.1 apart, one on top of both. Sides by quarters.
Mesh.CharacteristicLengthMin = 0.09; Mesh.CharacteristicLengthMax = 0.09;
r = 0.5; w = 0.55;
// two lower ones: quarters below, right, above, left
For i In {0 : 1}
  x = (2 * i - 1) * w; p = 10 * i; q = r * Sqrt(0.5);
  Point(p + 1) = {x, r, 0};
  Point(p + 2) = {x - q, r - q, 0}; Point(p + 3) = {x + q, r - q, 0}; Point(p + 4) = {x + q, r + q, 0}; Point(p + 5) = {x - q, r + q, 0};
  Circle(p + 1) = {p + 2, p + 1, p + 3}; Circle(p + 2) = {p + 3, p + 1, p + 4};
  Circle(p + 3) = {p + 4, p + 1, p + 5}; Circle(p + 4) = {p + 5, p + 1, p + 2};
  Curve Loop(i + 1) = {p + 1, p + 2, p + 3, p + 4};
  Plane Surface(i + 1) = {i + 1};
EndFor
y = r + Sqrt(1 - w * w) + 0.0001;
Point(31) = {0, y, 0};
Point(32) = {0, y - r, 0}; Point(33) = {r, y, 0}; Point(34) = {0, y + r, 0}; Point(35) = {-r, y, 0};
Circle(31) = {32, 31, 33}; Circle(32) = {33, 31, 34}; Circle(33) = {34, 31, 35}; Circle(34) = {35, 31, 32};
Curve Loop(3) = {31, 32, 33, 34};
Plane Surface(3) = {3};
Physical Surface("left") = {1};
Physical Surface("right") = {2};
Physical Surface("top") = {3};
Physical Curve("left_below") = {1};
Physical Curve("left_above") = {3};
Physical Curve("left_outside") = {4};
Physical Curve("right_below") = {11};
Physical Curve("right_outside") = {12};
Physical Curve("right_above") = {13};
Physical Curve("top_right") = {31};
Physical Curve("top_left") = {34};
