// Quarter of a thick-walled tube, 1 <= r <= b. Units: m.
DefineConstant[ h = {0.5}, b = {2} ];
Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {b, 0, 0, h}; Point(4) = {0, b, 0, h}; Point(5) = {0, 1, 0, h};
Line(1) = {2, 3}; Circle(2) = {3, 1, 4}; Line(3) = {4, 5}; Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Surface("tube") = {1};
Physical Curve("below") = {1};
Physical Curve("left") = {3};
Physical Curve("outside") = {2};
Physical Curve("inside") = {4};
